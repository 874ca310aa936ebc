"""The command ``run``: what a recipe says, or once more what a result came from."""

from __future__ import annotations

import json as json_text
import tempfile
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.cli.commands import do
from roughcontact.cli.exits import MISSED
from roughcontact.cli.messages import note, reported
from roughcontact.cli.option_groups import argument
from roughcontact.cli.options import FORMAT, JSON, OUT, Answer, PictureFormat
from roughcontact.cli.report import emit
from roughcontact.version import __version__

if TYPE_CHECKING:
    from roughcontact.recipe.jobs import Job

__all__ = ["EXAMPLES", "run"]

EXAMPLES = {
    "run": """
roughcontact run job.toml
roughcontact run job.toml --out result
roughcontact run result/curve.json
"""
}
_SOURCE = argument("A job (.toml), or a result that carries its recipe (.json, .nc).", "JOB.toml|RESULT")
_RESULTS = (".json", ".nc")
# How the files of the jobs are called.
_STEMS = {
    "press": "press",
    "curve": "curve",
    "adhesion press": "adhesive_state",
    "adhesion curve": "adhesive_curve",
    "adhesion loop": "adhesive_loop",
    "adhesion detach": "detachment",
}


def run(
    source: Path = _SOURCE,
    *,
    out: Path | None = OUT,
    format: PictureFormat | None = FORMAT,
    json: bool = JSON,
) -> None:
    """Do what a recipe says; of a result, do it once more and compare the numbers to the last digit.

    The answer of a job goes to a folder named like its file, and loads that are stored there are not computed again.
    """
    with reported(source, out, as_json=json):
        _run(source, out, format, json=json)


def _run(source: Path, out: Path | None, format: PictureFormat | None, *, json: bool) -> None:
    from roughcontact.recipe.written import read_job, require_same_files

    job = read_job(source)
    require_same_files(job)
    if source.suffix.casefold() not in _RESULTS:
        folder = out or Path(source.stem)
        if _is_stored(job, folder):
            note(f"{folder} holds the answer of this job already, by this version: nothing is computed")
            if json:
                emit(_numbers(_file(job, folder)))
            return
        do(job, Answer(folder, format, json))
        return
    with ExitStack() as stack:
        folder = out or Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="roughcontact-")))
        end: typer.Exit | None = None
        try:
            do(job, Answer(folder, format, json, is_kept=out is not None))
        except typer.Exit as missed:
            end = missed
        before = _numbers(source)
        _compare(before, _again(job, folder, source.suffix, before))
        if end is not None:
            raise end


def _file(job: Job, folder: Path, ending: str = ".json") -> Path:
    """Return the file in which the numbers of a job are written."""
    if job.NAME == "press" and ending == ".nc":
        return folder / "pressure.nc"
    return folder / f"{_STEMS[job.NAME]}{ending}"


def _again(job: Job, folder: Path, ending: str, before: dict[str, Any]) -> dict[str, Any]:
    """Return what a folder holds now of what a result held before: of a loop, two files end alike."""
    paths = (_file(job, folder, ending), folder / f"loop{ending}")
    found = [_numbers(path) for path in paths if path.exists()]
    return max(found, key=lambda each: len(each.keys() & before.keys()))


def _numbers(path: Path) -> dict[str, Any]:
    """Return what a result holds, by names."""
    if path.suffix.casefold() == ".json":
        found: dict[str, Any] = json_text.loads(path.read_text(encoding="utf-8"))
        return found
    import xarray

    with xarray.open_dataset(path, engine="h5netcdf") as dataset:
        values = {str(name): column.to_numpy() for name, column in dataset.load().variables.items()}
    return {name: value if value.dtype.kind in "iuf" else value.tolist() for name, value in values.items()}


def _is_stored(job: Job, folder: Path) -> bool:
    """Return whether a folder holds the whole answer of a job; that of a curve is completed where it is computed."""
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


def _compare(before: dict[str, Any], after: dict[str, Any]) -> None:
    """Print whether the numbers are the same; end with an error where they are not."""
    from roughcontact.recipe.repeated import differences

    if not (found := differences(before, after)):
        note("same numbers")
        return
    note("1 quantity differs:" if len(found) == 1 else f"{len(found)} quantities differ:")
    for each in found:
        note(str(each))
    raise typer.Exit(MISSED)
