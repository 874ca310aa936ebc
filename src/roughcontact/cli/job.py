"""The processes of an MPI job, which work as one program: rank 0 prints and writes.

A launcher (mpiexec, srun) sets their number in the environment. With several processes, `surface make`, `press` and
`curve` divide the rows of one surface among them; other commands raise an error.
"""

from __future__ import annotations

import io
import os
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, redirect_stderr, redirect_stdout
from functools import cache
from typing import TYPE_CHECKING, Any

from roughcontact.cli.exits import MISSED
from roughcontact.errors import InputError

if TYPE_CHECKING:
    from roughcontact.slabs.communicator import Communicator
    from roughcontact.slabs.slabs import Slabs

__all__ = ["as_one", "communicator_of_job", "refusal", "require_one_process", "slabs_of_job"]

# Where launchers state the number of processes and which one this is: Open MPI; MPICH and its kin; SLURM.
_STATED = {
    "OMPI_COMM_WORLD_SIZE": "OMPI_COMM_WORLD_RANK",
    "PMI_SIZE": "PMI_RANK",
    "SLURM_STEP_NUM_TASKS": "SLURM_PROCID",
}
_TOGETHER = (["press"], ["curve"], ["surface", "make"])
_PATIENCE = 5.0  # [s] for all processes to meet an error that they have in common
_TURN = 0.02  # [s] between two checks of this


def launched() -> tuple[int, int]:
    """Return which process this is, and how many a launcher has started together."""
    for size, rank in _STATED.items():
        stated = os.environ.get(rank, ""), os.environ.get(size, "")
        if all(text.isdecimal() for text in stated):
            return int(stated[0]), int(stated[1])
    return 0, 1


def refusal(arguments: Sequence[str]) -> InputError | None:
    """Return why several processes cannot run a command together; None if they can, or if there is only one."""
    words = [word for word in arguments if not word.startswith("-")]
    known = any(words[: len(command)] == command for command in _TOGETHER)
    if launched()[1] == 1 or not words or known or "--help" in arguments:
        return None
    name = " ".join(words[: 2 if words[0] in ("adhesion", "study", "surface") else 1])
    return InputError(
        f"{launched()[1]} processes were started together, which only 'press', 'curve' and 'surface make' support",
        f"run {name!r} without a launcher such as mpiexec",
    )


@cache
def slabs_of_job() -> Slabs | None:
    """Return the processes of the job as owners of slabs; None if there is only one.

    Raises
    ------
    UsageError
        If they cannot work together.
    """
    size = launched()[1]
    if size == 1:
        return None
    from roughcontact.cli.messages import UsageError
    from roughcontact.slabs.slabs import Slabs

    try:
        from mpi4py import MPI
    except (ImportError, RuntimeError) as error:
        raise UsageError(
            f"{size} processes were started together, and mpi4py, which connects them, cannot be imported "
            f"({error})",
            "install roughcontact[mpi], or start one process",
        ) from error
    if size != MPI.COMM_WORLD.size:
        raise UsageError(
            f"{size} processes were started together, and mpi4py sees {MPI.COMM_WORLD.size}: the launcher belongs to "
            f"another MPI than that of mpi4py ({MPI.Get_library_version().split(',')[0]})",
            "use the mpiexec of that MPI",
        )
    _meeting()
    return Slabs(MPI.COMM_WORLD)


def communicator_of_job() -> Communicator:
    """Return the processes of the job, or only this one."""
    from roughcontact.slabs.one_process import OneProcess

    slabs = slabs_of_job()
    return OneProcess() if slabs is None else slabs.communicator


def require_one_process(given: Mapping[str, Any]) -> None:
    """Raise an error for options that need the whole surface, by their names.

    Raises
    ------
    UsageError
        If such an option was given, and the job has several processes.
    """
    from roughcontact.cli.messages import UsageError

    for name, value in given.items():
        if launched()[1] > 1 and value is not None and value is not False:
            raise UsageError(
                f"{name} needs the whole surface, of which each of {launched()[1]} processes holds some rows",
                "leave it out, or start one process",
                place=name,
            )


@contextmanager
def as_one() -> Iterator[None]:
    """Let only rank 0 print; an error of a single process ends all processes with its message.

    The block ends by `SystemExit`, as a program does.
    """
    rank, size = launched()
    if size == 1:
        yield
        return
    words, status = io.StringIO(), 0
    with ExitStack() as stack:
        if rank:
            stack.enter_context(redirect_stdout(io.StringIO()))
            stack.enter_context(redirect_stderr(words))
        try:
            yield
        except SystemExit as end:
            status = end.code if isinstance(end.code, int) else int(end.code is not None)
    if "mpi4py.MPI" in sys.modules:
        _end_together(
            status, f"{words.getvalue()}This was process {rank} of {size} only: the job is ended.\n"
        )
    sys.exit(status)


def _end_together(status: int, words: str) -> None:
    """Wait for the other processes; after an error only briefly, because they may wait for this one elsewhere."""
    arrival = _meeting().Ibarrier()
    until = time.monotonic() + (_PATIENCE if status not in (0, MISSED) else float("inf"))
    while not arrival.Test():
        if time.monotonic() > until:
            sys.stderr.write(words)
            sys.stderr.flush()
            _meeting().Abort(status)
        time.sleep(_TURN)
    first = _meeting().bcast(status)
    if status not in (0, MISSED) and first in (0, MISSED):  # rank 0 has not printed this error
        sys.stderr.write(words)


@cache
def _meeting() -> Any:
    """Return a separate communicator for the end: no other collective call can be mistaken for it."""
    from mpi4py import MPI

    return MPI.COMM_WORLD.Dup()
