"""The command ``surface prepare``: from a measured surface to one that can be analysed or pressed."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from roughcontact.cli.contact_of_job import name_of, prepared
from roughcontact.cli.messages import plain, remark
from roughcontact.cli.options import JSON, OUTPUT
from roughcontact.cli.output import output
from roughcontact.cli.report import surface_facts, surface_record, tell
from roughcontact.cli.run_memory import require_memory
from roughcontact.cli.saving import answer_beside, require_output, save_surface
from roughcontact.recipe.elastic_jobs import SurfaceJob
from roughcontact.recipe.preparation import Preparation
from roughcontact.recipe.source import File

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["EXAMPLES", "prepare"]

EXAMPLES = {
    "prepare": """
roughcontact surface prepare part.x3p flat.npz --level plane --long-cutoff 0.8mm
roughcontact surface prepare part.x3p small.x3p --crop 100:612,0:512 --fill --downsample 2
roughcontact surface prepare part.x3p clean.npz --despike filled --mask above=20um
roughcontact surface prepare rough.npz seen.npz --tip 2um --average 4
""",
}
_BYTES_PER_POINT = 120  # heights before and after a step, masks, weights and the workspace of a filter


@dataclass(frozen=True, slots=True)
class Saved:
    """The file of a surface; an `Answer` has a folder, or none."""

    out: Path = OUTPUT
    json: bool = JSON

    @property
    def file(self) -> Path:
        """The file of the surface."""
        return self.out


def prepare(job: SurfaceJob, *, answer: Saved) -> None:
    """Crop, despike, mask, level, remove form, fill, scan, filter, average, subsample and taper a surface; save it.

    The steps that you name are done in this order, for maps and profiles, and recorded in the history of the file.
    """
    source = job.source
    if isinstance(answer, Saved):
        original = Path(source.file) if isinstance(source, File) else None
        require_output(answer.file, original, as_json=answer.json)
    if job.preparation == Preparation():
        remark("no step is given: the surface is written as it was read")
    with nullcontext() if isinstance(answer, Saved) else output(answer.out):
        surface = prepared(job, _require_memory)["surface"]
        if answer.file is not None:
            save_surface(surface, answer.file)
    file = name_of(source) if answer.file is None else plain(str(answer.file))
    record = {"command": "surface prepare", "file": file} | surface_record(surface)
    with answer_beside(answer.file):
        tell(record, surface_facts(surface, record), as_json=answer.json)


def _require_memory(surface: Surface) -> None:
    require_memory(_BYTES_PER_POINT * surface.grid.size, surface.grid.shape)
