"""The verbs ``study ...``: ensembles that can be stopped, continued and enlarged."""

from __future__ import annotations

import os
import shlex
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from roughcontact.cli.exits import MISSED
from roughcontact.cli.messages import UsageError, note, reported
from roughcontact.cli.output import command_line
from roughcontact.cli.resumable import resumable
from roughcontact.cli.study_engine import Engine, engine_of, options_of, working
from roughcontact.cli.study_report import tell

if TYPE_CHECKING:
    from roughcontact.study.study import Study

__all__ = [
    "ADD_EXAMPLES",
    "EXPORT_EXAMPLES",
    "RUN_EXAMPLES",
    "STATUS_EXAMPLES",
    "add",
    "export",
    "run",
    "status",
]

RUN_EXAMPLES = """Examples:

roughcontact study run hurst.toml

roughcontact study run hurst.toml --out results --workers 4

roughcontact study run results --retry
"""
STATUS_EXAMPLES = """Example:

roughcontact study status results --failed
"""
EXPORT_EXAMPLES = """Examples:

roughcontact study export results --out hurst.nc

roughcontact study export results --out hurst.csv
"""
ADD_EXAMPLES = """Example:

roughcontact study add results --samples 100
"""

StudyArgument = Annotated[
    Path, typer.Argument(metavar="STUDY.toml|DIR", help="A study, or the folder that one was run in.")
]
FolderArgument = Annotated[Path, typer.Argument(metavar="DIR", help="The folder that a study was run in.")]
OutOption = Annotated[
    Path | None, typer.Option(metavar="DIR", help="Folder for the results (default: named like the study).")
]
EngineOption = Annotated[Engine, typer.Option("--executor", help="Where cases are computed.")]
WorkersOption = Annotated[
    int | None, typer.Option(min=1, metavar="N", help="Cases computed at once (default: one a core).")
]
SchedulerOption = Annotated[
    str | None, typer.Option(metavar="ADDRESS", help="Of a running Dask scheduler, such as tcp://node7:8786.")
]
RetryOption = Annotated[bool, typer.Option("--retry", help="Try failed cases again.")]
FailedOption = Annotated[bool, typer.Option("--failed", help="List all failed cases, and why they failed.")]
JsonOption = Annotated[bool, typer.Option("--json", help="One JSON object on standard output.")]
FileOption = Annotated[Path, typer.Option("--out", metavar="FILE", help="File to write: .nc or .csv.")]
SamplesOption = Annotated[
    int, typer.Option(min=1, metavar="N", help="Samples that every combination shall have.")
]


def run(
    source: StudyArgument,
    *,
    out: OutOption = None,
    executor: EngineOption = Engine.PROCESSES,
    workers: WorkersOption = None,
    scheduler: SchedulerOption = None,
    retry: RetryOption = False,
    as_json: JsonOption = False,
) -> None:
    """Compute what is left of a study. Ctrl-C stops it; run again, it goes on."""
    with reported(source, out), _own_cases():
        from roughcontact.cli.study_progress import progress
        from roughcontact.study.run import run as run_study

        study, folder = _found(source, out)
        with working():
            engine = engine_of(executor, workers, scheduler)
        again = [*options_of(executor, workers, scheduler), *(["--retry"] if retry else [])]
        with working(), resumable(_command("run", folder, *again)), progress(study.name) as show:
            summary = run_study(study, folder, engine, retry=retry, on_progress=show)
        tell(study, folder, summary, as_json=as_json)
        if summary.failed:
            note(f"{summary.failed} cases failed; why says: {_command('status', folder, '--failed')}")
            raise typer.Exit(MISSED)


def status(folder: FolderArgument, *, failed: FailedOption = False, as_json: JsonOption = False) -> None:
    """Say how far a study is; also while it runs."""
    with reported(folder), _own_cases():
        from roughcontact.study.store import Store

        with Store.open(folder) as store:
            study, summary, outdated = store.study, store.summary(), store.outdated()
            failures = store.failed() if failed else ()
        if outdated:
            note(f"{outdated} more cases are kept, of another version of the case or of earlier parameters")
        tell(study, folder, summary, as_json=as_json, failures=failures if failed else None)


def export(folder: FolderArgument, *, out: FileOption, as_json: JsonOption = False) -> None:
    """Write all results of a study side by side into one file; also while it runs."""
    with reported(folder, out), _own_cases():
        from roughcontact.files.aside import require_target
        from roughcontact.files.provenance import provenance
        from roughcontact.files.write import write_netcdf
        from roughcontact.study.export import export as exported
        from roughcontact.study.long_table import write_long_csv
        from roughcontact.study.store import Store

        kind = out.suffix.casefold()
        if kind not in (".nc", ".csv"):
            raise UsageError(f"--out: cannot write {out}: give a file .nc (NetCDF) or .csv (a table)")
        require_target(out)
        with Store.open(folder) as store:
            study, summary = store.study, store.summary()
            if not summary.done:
                raise UsageError(f"{folder} holds no results yet: {_command('run', folder)}")
            dataset = exported(store)
        if kind == ".nc":
            write_netcdf(dataset, out, provenance(command=command_line()))
        else:
            write_long_csv(dataset, out)
        if summary.failed or summary.left:
            note(f"{summary.failed} cases failed and {summary.left} are left: they are missing in {out}")
        tell(study, folder, summary, as_json=as_json, file=out)


def add(folder: FolderArgument, *, samples: SamplesOption, as_json: JsonOption = False) -> None:
    """Give a study more samples; they are computed when it is run again."""
    with reported(folder), _own_cases():
        from roughcontact.study.store import Store

        study, _ = _found(folder, None)
        if samples <= study.samples:
            raise UsageError(f"--samples: the study has {study.samples} already: give more, not {samples}")
        with Store.open(folder, study.with_samples(samples)) as store:
            study, summary = store.study, store.summary()
        tell(study, folder, summary, as_json=as_json)
        note(f"to compute them: {_command('run', folder)}")


def _found(source: Path, out: Path | None) -> tuple[Study, Path]:
    """Return the study that was named, and the folder of its results."""
    from roughcontact.study.schema import DATABASE
    from roughcontact.study.store import STUDY
    from roughcontact.study.study import Study

    if source.is_dir():
        if out is not None:
            raise UsageError(f"{source} is the folder of the results itself: leave out --out")
        if not (source / STUDY).is_file():
            raise UsageError(f"there is no {STUDY} in {source}: name the folder that a study was run in")
        return Study.read(source / STUDY), source
    study = Study.read(source)
    if out is None and source.name == STUDY and (source.parent / DATABASE).exists():
        return study, source.parent
    return study, out or Path(study.name)


def _command(verb: str, folder: Path, *options: str) -> str:
    return shlex.join(["roughcontact", "study", verb, str(folder), *options])


@contextmanager
def _own_cases() -> Iterator[None]:
    """Let modules of the current folder be imported, after all others."""
    here = os.getcwd()
    sys.path.append(here)
    try:
        yield
    finally:
        sys.path.remove(here)
