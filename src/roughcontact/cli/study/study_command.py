"""The commands ``study ...``: ensembles that can be stopped, continued and enlarged."""

from __future__ import annotations

import os
import shlex
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.cli.exits import MISSED
from roughcontact.cli.messages import UsageError, note, remark, reported
from roughcontact.cli.option_groups import argument, option
from roughcontact.cli.options import JSON
from roughcontact.cli.output import command_line
from roughcontact.cli.progress_view import duration
from roughcontact.cli.report import emit, print_facts
from roughcontact.cli.resumable import resumable
from roughcontact.cli.study.study_engine import Workplace
from roughcontact.recipe.texts import whole

if TYPE_CHECKING:
    import xarray

    from roughcontact.study.record import Row
    from roughcontact.study.study import Study
    from roughcontact.study.task import Executor, Result, RunTask, Summary, Task

__all__ = [
    "EXAMPLES",
    "FOLDER",
    "add",
    "dataset_writer",
    "export",
    "own_cases",
    "require_results",
    "run",
    "status",
]

EXAMPLES = {
    "run": """
roughcontact study run hurst.toml
roughcontact study run hurst.toml --out results --workers 4
roughcontact study run results --retry
""",
    "status": """
roughcontact study status results --failed
""",
    "export": """
roughcontact study export results --out hurst.nc
roughcontact study export results --out hurst.csv
""",
    "add": """
roughcontact study add results --samples 100
""",
}

SOURCE = argument("A study, or the folder of its results.", "STUDY.toml|DIR")
OUT = option("Folder for the results (default: named like the study).", "DIR")
RETRY = option("Try failed cases again.", default=False)
FOLDER = argument("Folder of the results of a study.", "DIR")
FILE = option("File to write: .nc or .csv.", "FILE", default=...)
FAILED = option("List all failed cases and their errors.", default=False)
SAMPLES = option(
    "Total number of samples of every combination.", "N", default=..., read=whole(1, "the number of samples")
)


def run(
    source: Path = SOURCE,
    *,
    out: Path | None = OUT,
    workplace: Workplace,
    retry: bool = RETRY,
    json: bool = JSON,
) -> None:
    """Compute the cases of a study that are left. Ctrl-C stops it; the same command resumes it."""
    remark(f"starting {source}; the first cases take some seconds")
    with reported(source, out, as_json=json), own_cases():
        from roughcontact.study.run import run as run_study

        study, folder = _found(source, out)
        engine = workplace.open()
        again = [*workplace.typed(), *(["--retry"] if retry else [])]
        with resumable(_command("run", folder, *again), as_json=json):
            summary = run_study(study, folder, _Announced(engine, study), retry=retry)
        _tell(study, folder, summary, as_json=json)
        if _is_unresolved(folder):
            remark("no load is resolved: compute more points or larger loads")
        if summary.failed:
            note(
                f"{summary.failed} cases failed; list their errors by: {_command('status', folder, '--failed')}"
            )
            raise typer.Exit(MISSED)


def status(folder: Path = FOLDER, *, failed: bool = FAILED, json: bool = JSON) -> None:
    """Print the progress of a study; also while it runs."""
    with reported(folder, as_json=json), own_cases():
        from roughcontact.study.store import Store

        with Store.open(folder) as store:
            study, summary, outdated = store.study, store.summary(), store.outdated()
            failures = store.failed() if failed else ()
        if outdated:
            note(f"{outdated} more stored cases are of another version of the case or of earlier parameters")
        _tell(study, folder, summary, as_json=json, failures=failures if failed else None)


def export(folder: Path = FOLDER, *, out: Path = FILE, json: bool = JSON) -> None:
    """Write all results of a study side by side into one file; also while it runs."""
    with reported(folder, out, as_json=json), own_cases():
        from roughcontact.study.export import export as exported
        from roughcontact.study.store import Store

        write = dataset_writer(out)
        with Store.open(folder) as store:
            study, summary = store.study, store.summary()
            require_results(folder, summary)
            dataset = exported(store)
        write(dataset)
        if summary.failed or summary.left:
            note(f"{summary.failed} cases failed and {summary.left} are left: they are missing in {out}")
        _tell(study, folder, summary, as_json=json, file=out)


def add(folder: Path = FOLDER, *, samples: int = SAMPLES, json: bool = JSON) -> None:
    """Give a study more samples; 'study run' computes them."""
    with reported(folder, as_json=json), own_cases():
        from roughcontact.study.store import Store

        study, _ = _found(folder, None)
        if samples <= study.samples:
            raise UsageError(
                f"the study already has {study.samples} samples",
                f"give more, not {samples}",
                place="--samples",
            )
        with Store.open(folder, study.with_samples(samples)) as store:
            study, summary = store.study, store.summary()
        _tell(study, folder, summary, as_json=json)
        remark(f"to compute them: {_command('run', folder)}")


def dataset_writer(out: Path) -> Callable[[xarray.Dataset], None]:
    """Return a function that writes a dataset as NetCDF or as a table, by the ending of the file's name."""
    from roughcontact.files.aside import require_target
    from roughcontact.files.provenance import provenance
    from roughcontact.files.write import write_netcdf
    from roughcontact.study.long_table import write_long_csv

    kind = out.suffix.casefold()
    if kind not in (".nc", ".csv"):
        raise UsageError(f"cannot write {out}", "give a file .nc (NetCDF) or .csv (a table)", place="--out")
    require_target(out)
    if kind == ".csv":

        def write(dataset: xarray.Dataset) -> None:
            if left_out := write_long_csv(dataset, out):
                note(f"a table has no place for {', '.join(left_out)}: write a file .nc to keep them")

        return write
    return lambda dataset: write_netcdf(dataset, out, provenance(command=command_line()))


def require_results(folder: Path, summary: Summary) -> None:
    """Raise an error for a folder without finished cases."""
    if not summary.done:
        raise UsageError(f"{folder} holds no results yet", _command("run", folder))


@dataclass(frozen=True, slots=True)
class _Announced:
    """An executor that prints how many cases it computes."""

    engine: Executor
    study: Study

    @property
    def workers(self) -> int:
        return self.engine.workers

    def results(self, run_task: RunTask, tasks: Iterable[Task]) -> Iterator[Result]:
        left = list(tasks)
        if left:
            combinations = len(self.study.combinations())
            remark(
                f"computing {_counted(len(left), 'case')}: {_counted(combinations, 'combination')}, "
                f"{_counted(self.study.samples, 'sample')} of each; {_counted(self.workers, 'worker')}"
            )
        return self.engine.results(run_task, left)


def _counted(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


def _is_unresolved(folder: Path) -> bool:
    """Return whether the records list resolved loads, and no load is resolved."""
    from roughcontact.study.store import Store

    found = False
    with Store.open(folder) as store:
        for row in store.rows():
            record = row.record
            if record is None:
                continue
            if "resolved" not in record or bool(record["resolved"].any()):  # as in all records of a case
                return False
            found = True
    return found


def _found(source: Path, out: Path | None) -> tuple[Study, Path]:
    """Return the study that was given, and the folder of its results."""
    from roughcontact.study.schema import DATABASE
    from roughcontact.study.store import STUDY
    from roughcontact.study.study import Study

    if source.is_dir():
        if out is not None:
            raise UsageError(
                f"{source} is the folder of the results itself", "leave out --out", place="--out"
            )
        if not (source / STUDY).is_file():
            raise UsageError(f"there is no {STUDY} in {source}", "name the folder of the results of a study")
        return Study.read(source / STUDY), source
    study = Study.read(source)
    if out is None and source.name == STUDY and (source.parent / DATABASE).exists():
        return study, source.parent
    return study, out or Path(study.name)


def _command(name: str, folder: Path, *options: str) -> str:
    return shlex.join(["roughcontact", "study", name, str(folder), *options])


@contextmanager
def own_cases() -> Iterator[None]:
    """Make modules of the current folder importable, after all other modules."""
    here = os.getcwd()
    sys.path.append(here)
    try:
        yield
    finally:
        sys.path.remove(here)


def _tell(
    study: Study,
    folder: Path,
    summary: Summary,
    *,
    as_json: bool,
    failures: Sequence[Row] | None = None,
    file: Path | None = None,
) -> None:
    """Print the progress of a study, its `failures` if given, and the `file` that was written."""
    if as_json:
        record: dict[str, Any] = {"study": study.name, "folder": str(folder), "samples": study.samples}
        record |= {"done": summary.done, "failed": summary.failed, "left": summary.left}
        if summary.seconds:
            record["seconds"] = summary.seconds
        if file is not None:
            record["file"] = str(file)
        if failures is not None:
            record["failures"] = [
                {"key": row.key, "sample": row.sample, "parameters": row.parameters, "message": row.message}
                for row in failures
            ]
        emit(record)
        return
    each = len(study.combinations())
    facts = [
        ("study", f"{study.name} (case {study.case}, seed {study.seed})"),
        ("folder", str(folder)),
        ("cases", f"{summary.total} ({each} combinations, {study.samples} samples of each)"),
        ("done", str(summary.done)),
        ("failed", str(summary.failed)),
        ("left", str(summary.left)),
    ]
    facts += [("time", duration(summary.seconds))] if summary.seconds else []
    print_facts([("file", str(file)), *facts] if file else facts)
    for row in failures or ():
        parameters = ", ".join(f"{name} = {value}" for name, value in row.parameters.items())
        typer.echo(f"\nsample {row.sample}, {parameters}\n  {row.message}")
