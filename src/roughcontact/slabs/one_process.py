"""A communicator of one process, for what is written for many."""

from __future__ import annotations

from typing import Any

__all__ = ["OneProcess"]


class OneProcess:
    """A single process."""

    rank, size = 0, 1

    def allgather(self, sendobj: Any) -> list[Any]:
        """Return what it gave."""
        return [sendobj]

    def sendrecv(self, sendobj: Any, dest: int, *, source: int) -> Any:
        """Return what it gave."""
        return sendobj

    def Allgatherv(self, sendbuf: Any, recvbuf: Any) -> None:
        """Copy the numbers."""
        recvbuf[0][...] = sendbuf

    def Alltoallv(self, sendbuf: Any, recvbuf: Any) -> None:
        """Copy the numbers."""
        recvbuf[0].reshape(-1)[...] = sendbuf[0].reshape(-1)
