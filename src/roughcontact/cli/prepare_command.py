"""The command ``surface prepare``: from what was measured to what is analysed or pressed."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughcontact.cli import options
from roughcontact.cli.messages import note, plain, reported
from roughcontact.cli.report import emit, print_facts, quantity, screen, size_of
from roughcontact.cli.run_memory import require_memory
from roughcontact.cli.saving import require_output, save_surface
from roughcontact.cli.steps import Wishes, steps

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["EXAMPLES", "prepare"]

EXAMPLES = """Examples:

roughcontact surface prepare part.x3p flat.npz --level plane --long-cutoff 0.8mm

roughcontact surface prepare part.x3p small.x3p --crop 100:612,0:512 --fill --downsample 2

roughcontact surface prepare rough.npz seen.npz --tip 2um --average 4
"""
_BYTES_PER_POINT = 120  # heights before and after a step, masks, weights and the work of a filter


def prepare(
    source: options.Source,
    out: options.OutputArgument,
    *,
    wishes: Wishes,
    periodic: options.PeriodicOption = None,
    json: options.JsonOption = False,
) -> None:
    """Crop, level, remove form, fill, scan, filter, average, subsample and taper a surface, in this order; save it.

    Nothing is done unasked. What is done stands in the file's history. A profile is prepared in the same way.
    """
    with reported(source.file, out):
        require_output(out, source.file)
        wanted = steps(wishes)
        surface = source.map_or_line(periodic)
        require_memory(_BYTES_PER_POINT * surface.grid.size, surface.grid.shape)
        if not wanted:
            note("no step is asked for: the surface is written as it was read")
        for step in wanted:
            with screen().status(f"{step.doing} ..."):
                surface = step.apply(surface)
        save_surface(surface, out)
        record = _record(surface, out)
        if json:
            emit(record)
        else:
            print_facts(_facts(surface, record))


def _record(surface: Surface, out: Path) -> dict[str, Any]:
    grid = surface.grid
    return {
        "command": "surface prepare",
        "file": plain(str(out)),
        "shape": list(grid.shape),
        "spacing": list(grid.spacing),
        "lengths": list(grid.lengths),
        "periodic": list(grid.periodic),
        "missing": surface.missing,
        "rms": surface.rms,
        "provenance": list(surface.provenance),
        "units": dict.fromkeys(("spacing", "lengths", "rms"), "m"),
    }


def _facts(surface: Surface, record: dict[str, Any]) -> list[tuple[str, str]]:
    return [
        ("file", record["file"]),
        ("size", size_of(surface.grid)),
        ("missing points", str(surface.missing) if surface.missing else "none"),
        ("rms height", quantity("rms", surface.rms)),
        *(("history", line) for line in record["provenance"]),
    ]
