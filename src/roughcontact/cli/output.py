"""Files of a run: all of them whole and together, or none."""

from __future__ import annotations

import os
import shlex
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

from roughcontact.cli.job import slabs_of_job
from roughcontact.cli.messages import UsageError, plain

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from roughcontact.slabs.communicator import Communicator

__all__ = ["all_or_none", "command_line", "output"]


def output(folder: Path | None) -> AbstractContextManager[Path | None]:
    """Return a context that checks before the work that results can be written to a folder.

    It undoes the creation of the folder if the work fails.

    Of the processes of a job all enter it, and the first alone gets the folder.
    """
    if folder is None:
        return nullcontext()
    from roughcontact.files.aside import output_folder
    from roughcontact.files.write import require_netcdf

    require_netcdf()
    slabs = slabs_of_job()
    return output_folder(folder) if slabs is None else _of_first(slabs.communicator, folder)


@contextmanager
def _of_first(communicator: Communicator, folder: Path) -> Iterator[Path | None]:
    """Yield the folder on the first process of a job, which alone writes, and None on the others."""
    from roughcontact.files.aside import output_folder
    from roughcontact.slabs.agreement import entered_by_first

    with entered_by_first(communicator, lambda: output_folder(folder)) as path:
        yield path if communicator.rank == 0 else None


@contextmanager
def all_or_none(folder: Path) -> Iterator[Path]:
    """Yield a folder to write into; its files move to `folder` when the block ends well.

    So an interrupt, or a failure of the last picture, does not leave new files beside old ones.

    Raises
    ------
    UsageError
        If a file in the way is protected or a folder.
    """
    with tempfile.TemporaryDirectory(prefix=".", suffix=".part", dir=folder) as name:
        aside = Path(name)
        yield aside
        files = sorted(aside.iterdir())
        for file in files:
            _check_free(folder / file.name)
        for file in files:
            os.replace(file, folder / file.name)


def command_line() -> str:
    """Return the command as the user typed it, for the record."""
    return plain(shlex.join(["roughcontact", *sys.argv[1:]]))


def _check_free(target: Path) -> None:
    if target.is_dir() or (target.exists() and not os.access(target, os.W_OK)):
        what = "it is a folder" if target.is_dir() else "the file is write-protected"
        raise UsageError(f"cannot write {target}: {what}; choose another --out")
