"""The requests of a session to one worker, answered one after the other."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from roughcontact.page.frames import packed
from roughcontact.page.server.worker_pool import WorkerPool
from roughcontact.page.server.worker_process import WorkerEndedError, WorkerProcess

__all__ = ["RequestQueue"]

_GRACE = 0.15  # seconds in which a request may leave by itself; then its process is ended
_DIED = (
    "The process that computes was ended from outside, or ran out of memory. A new one takes over: ask again."
)


@dataclass(slots=True, eq=False)
class RequestQueue:
    """A worker, and the requests that wait for it.

    Parameters
    ----------
    pool : WorkerPool
        Where workers come from.
    """

    pool: WorkerPool
    worker: WorkerProcess | None = None
    number: int = 0
    running: tuple[int, str] | None = None
    unwanted: set[str] = field(default_factory=set)
    turn: asyncio.Lock = field(default_factory=asyncio.Lock)

    @property
    def busy(self) -> bool:
        """Whether a request is worked on, or waits."""
        return self.turn.locked()

    async def perform(self, key: str, request: Mapping[str, Any]) -> AsyncIterator[bytes]:
        """Yield the messages that answer a request, the last of which says how it ended.

        An iterator that is closed early, since its reader has gone, stops the request.
        """
        async with self.turn:
            if key in self.unwanted:
                self.unwanted.discard(key)
                yield packed({"type": "end", "how": "stopped"})
                return
            worker = await self._ready()
            self.number += 1
            self.running = (self.number, key)
            ended = False
            try:
                async for message in worker.answers({**request, "number": self.number}):
                    ended = message.header["type"] == "end"
                    if ended:
                        self.running = None
                    yield message.raw
            except WorkerEndedError:
                self.worker, ended = None, True
                how = {"how": "stopped"} if key in self.unwanted else {"how": "died", "message": _DIED}
                yield packed({"type": "end", **how})
            finally:
                self.unwanted.discard(key)
                self.running = None
                if not ended:
                    await self._leave(worker, self.number)

    async def stop(self, key: str) -> None:
        """Stop a request, now or when its turn comes; when this returns, it is over."""
        if self.running is None or self.running[1] != key or self.worker is None:
            self.unwanted.add(key)
            return
        self.unwanted.add(key)
        running, worker = self.running, self.worker
        try:
            await worker.stop(running[0])
        except WorkerEndedError:
            return
        await asyncio.sleep(_GRACE)
        if self.running == running:
            await self.pool.dismiss(worker)

    async def end(self) -> None:
        """End its worker."""
        worker, self.worker = self.worker, None
        if worker is not None:
            await self.pool.dismiss(worker)

    async def _ready(self) -> WorkerProcess:
        if self.worker is not None and not self.worker.alive:
            await self.pool.dismiss(self.worker)
            self.worker = None
        if self.worker is None:
            self.worker = await self.pool.take()
        return self.worker

    async def _leave(self, worker: WorkerProcess, number: int) -> None:
        """Have the worker leave a request whose reader is gone, or end it."""
        try:
            await worker.stop(number)
            await asyncio.wait_for(worker.finish(), _GRACE)
        except (TimeoutError, WorkerEndedError):
            await self.pool.dismiss(worker)
            self.worker = None
