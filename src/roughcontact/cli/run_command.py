"""The command ``run``: a job from its recipe, or once more the job of a result."""

from __future__ import annotations

import json as json_text
import tempfile
from collections.abc import Sequence
from contextlib import ExitStack, nullcontext, redirect_stdout
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.cli.cited import cited
from roughcontact.cli.commands import do
from roughcontact.cli.exits import MISSED
from roughcontact.cli.messages import UsageError, note, remark, reported
from roughcontact.cli.option_groups import PRINT, argument
from roughcontact.cli.options import CITE, FORMAT, JSON, OUT, Answer
from roughcontact.cli.parsing.printed import print_job
from roughcontact.cli.report import emit
from roughcontact.errors import within
from roughcontact.version import __version__

if TYPE_CHECKING:
    from roughcontact.recipe.jobs import Job
    from roughcontact.recipe.repeated import Difference

__all__ = ["EXAMPLES", "run"]

EXAMPLES = {
    "run": """
roughcontact run job.toml
roughcontact run job.toml --out result
roughcontact run result/curve.json
roughcontact run job.toml --print python
"""
}
_SOURCE = argument(
    "A job (.toml), or a result that carries its recipe (.json, .nc, or its folder).", "JOB.toml|RESULT"
)
_RESULTS = (".json", ".nc")
# The names of the files of the jobs.
_STEMS = {
    "press": "press",
    "leak": "leak",
    "shear": "shear",
    "curve": "curve",
    "creep": "creep",
    "sliding": "sliding",
    "joint": "joint",
    "theory": "theory",
    "infer": "inference",
    "adhesion press": "adhesive_state",
    "adhesion curve": "adhesive_curve",
    "adhesion loop": "adhesive_loop",
    "adhesion detach": "detachment",
}


def run(
    source: Path = _SOURCE,
    *,
    out: Path | None = OUT,
    format: str | None = FORMAT,
    printed: str | None = PRINT,
    json: bool = JSON,
    cite: bool = CITE,
) -> None:
    """Do the job of a recipe; or repeat that of a result, and compare the numbers to the last digit.

    The answer goes to a folder named like the recipe. Loads that are stored there are not computed again.
    """
    with reported(source, out, as_json=json):
        from roughcontact.recipe.written import read_job

        if printed is None:
            _run(source, out, format, json=json, cite=cite)
        else:
            with within("recipe"):
                job = read_job(source := _result_in(source))
            print_job(job, printed, recipe=str(source), as_json=json)


def _run(source: Path, out: Path | None, format: str | None, *, json: bool, cite: bool) -> None:
    from roughcontact.recipe.repeated import differences
    from roughcontact.recipe.written import read_job, require_same_files

    source = _result_in(source)
    with within("recipe"):
        job = read_job(source)
        require_same_files(job)
    if source.suffix.casefold() not in _RESULTS:
        folder = out or Path(source.stem)
        if _is_stored(job, folder):
            remark(f"{folder} already holds the answer of this job and version: nothing is computed")
            if json:
                emit(_numbers(_file(job, folder)))
            if cite:
                cited(folder, job, as_json=json)
            return
        _note_replaced(job, folder)
        do(job, Answer(folder, format, json, cite))
        return
    with ExitStack() as stack:
        folder = out or Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="roughcontact-")))
        end: typer.Exit | None = None
        try:
            with redirect_stdout(StringIO()) if json else nullcontext():
                do(job, Answer(folder, format, json, cite, is_kept=out is not None))
        except typer.Exit as missed:
            end = missed
        before = _numbers(source)
        found = differences(before, _again(job, folder, source.suffix, before))
        if json:
            emit({"command": "run", "file": str(source), "different": [str(each) for each in found]})
        else:
            _tell(found)
        if found or end is not None:
            raise end or typer.Exit(MISSED)


def _result_in(source: Path) -> Path:
    """Return the result that a folder holds; any other source unchanged.

    Raises
    ------
    UsageError
        If the folder does not hold exactly one result.
    """
    if not source.is_dir():
        return source
    found = [path for stem in _STEMS.values() if (path := source / f"{stem}.json").exists()]
    if len(found) != 1:
        held = ", ".join(path.name for path in found) or "no result of a job"
        raise UsageError(f"{source} holds {held}", "name a file: a job (.toml) or a result (.json, .nc)")
    return found[0]


def _note_replaced(job: Job, folder: Path) -> None:
    """Print a remark if the folder holds the answer of another recipe, which is replaced."""
    from roughcontact.recipe.written import carried, contact_in

    try:
        kept = _numbers(_file(job, folder)).get("recipe")
    except (OSError, ValueError, KeyError):
        return
    if kept is not None and contact_in(kept) != contact_in(carried(job, folder)):
        remark(f"{folder} holds the answer of another recipe, which is replaced")


def _file(job: Job, folder: Path, ending: str = ".json") -> Path:
    """Return the file that holds the numbers of a job."""
    if job.NAME == "press" and ending == ".nc":
        return folder / "pressure.nc"
    return folder / f"{_STEMS[job.NAME]}{ending}"


def _again(job: Job, folder: Path, ending: str, before: dict[str, Any]) -> dict[str, Any]:
    """Return the new result in a folder, by the name of the old one: two files of a loop have the same ending."""
    paths = (_file(job, folder, ending), folder / f"loop{ending}")
    found = [_numbers(path) for path in paths if path.exists()]
    return max(found, key=lambda each: len(each.keys() & before.keys()))


def _numbers(path: Path) -> dict[str, Any]:
    """Return the contents of a result, by names."""
    if path.suffix.casefold() == ".json":
        found: dict[str, Any] = json_text.loads(path.read_text(encoding="utf-8"))
        return found
    import xarray

    with xarray.open_dataset(path, engine="h5netcdf") as dataset:
        values = {str(name): column.to_numpy() for name, column in dataset.load().variables.items()}
    return {name: value if value.dtype.kind in "iuf" else value.tolist() for name, value in values.items()}


def _is_stored(job: Job, folder: Path) -> bool:
    """Return whether a folder holds the complete answer of a job; a curve is completed where it is computed."""
    from roughcontact.recipe.written import carried

    if job.NAME in ("surface", "curve"):
        return False
    try:
        record = _numbers(_file(job, folder))
    except (OSError, ValueError):
        return False
    version = record.get("provenance", {}).get("source")
    whole = record.get("converged") and record.get("whole", True)
    return bool(
        whole and record.get("recipe") == carried(job, folder) and version == f"roughcontact {__version__}"
    )


def _tell(found: Sequence[Difference]) -> None:
    """Print whether the numbers are the same."""
    if not found:
        remark("same numbers")
        return
    note("1 quantity differs:" if len(found) == 1 else f"{len(found)} quantities differ:")
    for each in found:
        note(str(each))
