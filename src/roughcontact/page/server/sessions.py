"""The open tabs: begun, found by their keys, and ended when they are closed or have long been silent."""

from __future__ import annotations

import asyncio
import secrets
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic

from roughcontact.page.jobs.session_cache import UploadedFile
from roughcontact.page.server.session import Session
from roughcontact.page.server.worker_pool import WorkerPool

__all__ = ["GIVEN", "MOST_SESSIONS", "Sessions"]

MOST_SESSIONS = 8  # each is up to two processes that compute
GIVEN = "given"  # what the page calls the file of the command line
_SILENT = (
    3600.0  # seconds: tabs say that they are there twice a minute, hidden ones once, frozen ones not at all
)
_ROOM = 180.0  # seconds of silence after which a tab gives way to a new one


@dataclass(slots=True, eq=False)
class Sessions:
    """All that are open.

    Parameters
    ----------
    pool : WorkerPool
        Where their workers come from.
    folder : Path
        Where their files lie, each in a folder of its own.
    given : UploadedFile or None
        The file of the command line, which all may read.
    silent : float
        After so long without a word from its tab [s] a session ends: the browser was killed, or went without a word.
    room : float
        Where no more may be opened, one that has been silent for so long [s] ends.
    """

    pool: WorkerPool
    folder: Path
    given: UploadedFile | None = None
    silent: float = _SILENT
    room: float = _ROOM
    known: dict[str, Session] = field(default_factory=dict)

    async def begin(self) -> str | None:
        """Open one and return its key; None where there are too many."""
        if len(self.known) >= MOST_SESSIONS:
            await self._end_silent(self.room)
        if len(self.known) >= MOST_SESSIONS:
            return None
        key = secrets.token_hex(16)
        files = {} if self.given is None else {GIVEN: self.given}
        place = self.folder / key
        place.mkdir(mode=0o700)
        self.known[key] = Session.of(self.pool, place, files)
        return key

    def find(self, key: str) -> Session | None:
        """Return a session whose tab has just been heard of."""
        session = self.known.get(key)
        if session is not None:
            session.heard = monotonic()
        return session

    async def end(self, key: str) -> None:
        """End one, if it is open."""
        session = self.known.pop(key, None)
        if session is not None:
            await session.end()

    async def watch(self) -> None:
        """End those that have been silent for too long, for as long as the server runs."""
        while True:
            await asyncio.sleep(self.silent / 10)
            await self._end_silent(self.silent)

    async def _end_silent(self, limit: float) -> None:
        before = monotonic() - limit
        for key in [key for key, each in self.known.items() if each.heard < before and not each.busy]:
            await self.end(key)
