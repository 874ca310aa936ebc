"""Files of a run: all of them whole and together, or none."""

from __future__ import annotations

import os
import shlex
import signal
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughcontact.cli.job import communicator_of_job
from roughcontact.cli.messages import UsageError, note, plain

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["all_or_none", "command_line", "output", "source_of", "write_state", "writing"]


@contextmanager
def output(folder: Path | None) -> Iterator[Path | None]:
    """Yield a folder, after a check that it is writable; remove a new folder if the work fails.

    All processes of a job enter it; only the first gets the folder.
    """
    if folder is None:
        yield None
        return
    from roughcontact.files.aside import output_folder
    from roughcontact.files.write import require_netcdf
    from roughcontact.slabs.agreement import entered_by_first

    require_netcdf()
    communicator = communicator_of_job()
    with entered_by_first(communicator, lambda: output_folder(folder)) as path:
        yield path if communicator.rank == 0 else None


@contextmanager
def all_or_none(folder: Path) -> Iterator[Path]:
    """Yield a folder to write into; its files move to `folder` when the block ends well.

    Thus an interrupt, or a failure of the last picture, leaves no new files beside old ones.

    Raises
    ------
    UsageError
        If an existing file of that name is write-protected or a folder.
    """
    with tempfile.TemporaryDirectory(prefix=".", suffix=".part", dir=folder) as name:
        aside = Path(name)
        yield aside
        files = sorted(aside.iterdir())
        for file in files:
            _check_free(folder / file.name)
        for file in files:
            os.replace(file, folder / file.name)


@contextmanager
def writing() -> Iterator[None]:
    """Write results that took long to compute: the first Ctrl-C meanwhile only prints a note."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.getsignal(signal.SIGINT) or signal.default_int_handler

    def pass_over(*_: object) -> None:
        signal.signal(signal.SIGINT, before)
        note("the files are being written; press Ctrl-C again to stop this")

    signal.signal(signal.SIGINT, pass_over)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def command_line() -> str:
    """Return the command as the user typed it, for the record."""
    return plain(shlex.join(["roughcontact", *sys.argv[1:]]))


def source_of(problem: Any, recipe: dict[str, Any], control: str | None = None) -> dict[str, Any]:
    """Return the provenance that files of a loaded state contain."""
    from roughcontact.files.provenance import provenance

    return provenance(
        problem.surface,
        modulus=problem.modulus,
        control=control,
        tolerance=problem.tolerance,
        command=command_line(),
        recipe=recipe,
    )


def write_state(
    path: Path, answer: Any, record: dict[str, Any], figure: Figure, ending: str, source: dict[str, Any]
) -> None:
    """Write NetCDF, picture and summary of an answer, `path` without ending: all of them or none."""
    from roughcontact.files.write import write_json, write_netcdf
    from roughcontact.plot.canvas import save

    with all_or_none(path.parent) as aside:
        write_netcdf(answer.to_dataset(), aside / f"{path.name}.nc", source)
        save(figure, aside / f"{path.name}.{ending}")
        write_json(record, aside / f"{path.name}.json", source)


def _check_free(target: Path) -> None:
    if target.is_dir() or (target.exists() and not os.access(target, os.W_OK)):
        what = "it is a folder" if target.is_dir() else "the file is write-protected"
        raise UsageError(f"cannot write {target}: {what}", "choose another --out")
