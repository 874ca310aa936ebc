"""The command ``surface prepare``: from what was measured to what is analysed or pressed."""

from __future__ import annotations

from pathlib import Path

from roughcontact.cli import options
from roughcontact.cli.messages import note, plain, reported
from roughcontact.cli.report import surface_facts, surface_record, tell
from roughcontact.cli.run_memory import require_memory
from roughcontact.cli.saving import require_output, save_surface
from roughcontact.cli.surface.steps import PreparationOptions, steps
from roughcontact.progress.events import task

__all__ = ["EXAMPLES", "prepare"]

EXAMPLES = {
    "prepare": """
roughcontact surface prepare part.x3p flat.npz --level plane --long-cutoff 0.8mm
roughcontact surface prepare part.x3p small.x3p --crop 100:612,0:512 --fill --downsample 2
roughcontact surface prepare part.x3p clean.npz --despike filled --mask above=20um
roughcontact surface prepare rough.npz seen.npz --tip 2um --average 4
""",
}
_BYTES_PER_POINT = 120  # heights before and after a step, masks, weights and the work of a filter


def prepare(
    source: options.Source,
    out: Path = options.OUTPUT,
    *,
    preparation: PreparationOptions,
    periodic: bool | None = options.PERIODIC,
    json: bool = options.JSON,
) -> None:
    """Crop, despike, mask, level, remove form, fill, scan, filter, average, subsample and taper a surface; save it.

    In this order, and nothing unasked. What is done stands in the file's history. Profiles are prepared alike.
    """
    with reported(source.file, out, as_json=json):
        require_output(out, source.file)
        wanted = steps(preparation)
        surface = source.map_or_line(periodic)
        require_memory(_BYTES_PER_POINT * surface.grid.size, surface.grid.shape)
        if not wanted:
            note("no step is asked for: the surface is written as it was read")
        for step in wanted:
            with task(step.doing):
                surface = step.apply(surface)
        save_surface(surface, out)
        record = {"command": "surface prepare", "file": plain(str(out))} | surface_record(surface)
        tell(record, surface_facts(surface, record), as_json=json)
