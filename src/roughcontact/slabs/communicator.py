"""What slabs ask of a communicator, as mpi4py has it."""

from __future__ import annotations

from typing import Any, Protocol

__all__ = ["Communicator"]


class Communicator(Protocol):
    """Processes that compute together; all of them make the same calls in the same order."""

    @property
    def rank(self) -> int:
        """Number of this process, from 0 up."""
        ...

    @property
    def size(self) -> int:
        """Number of processes."""
        ...

    def allgather(self, sendobj: Any) -> list[Any]:
        """Return what each process gave, in their order, on all of them."""
        ...

    def sendrecv(self, sendobj: Any, dest: int, *, source: int) -> Any:
        """Give something to one process, and return what another gives to this one."""
        ...

    def Allgatherv(self, sendbuf: Any, recvbuf: Any) -> None:
        """Put the numbers of all processes one behind the other, on all of them."""
        ...

    def Alltoallv(self, sendbuf: Any, recvbuf: Any) -> None:
        """Give numbers to every process, and take some from each."""
        ...
