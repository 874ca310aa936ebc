"""One tab of a browser: its files, its worker, and its orders one after the other."""

from __future__ import annotations

import asyncio
import shutil
from collections.abc import AsyncIterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from roughcontact.page.crew import Crew
from roughcontact.page.frames import packed
from roughcontact.page.workbench import UploadedFile
from roughcontact.page.worker_process import WorkerEnded, WorkerProcess

__all__ = ["Session"]

_GRACE = 0.15  # seconds in which an order may leave by itself; then its process is ended
_DIED = "The process that computes was ended from outside, or ran out of memory. A new one is there: ask again."


@dataclass(slots=True, eq=False)
class Session:
    """What the server knows of a tab. All else is stated by the page with every order.

    Parameters
    ----------
    crew : Crew
    folder : Path
        Where its files lie; it goes with the session.
    files : dict of str to UploadedFile
        By the names that the page was told.
    """

    crew: Crew
    folder: Path
    files: dict[str, UploadedFile] = field(default_factory=dict)
    worker: WorkerProcess | None = None
    number: int = 0
    running: tuple[int, str] | None = None
    stopped: set[str] = field(default_factory=set)
    turn: asyncio.Lock = field(default_factory=asyncio.Lock)

    async def perform(self, asked: Mapping[str, Any]) -> AsyncIterator[bytes]:
        """Yield the messages that answer an order, the last of which says how it ended.

        An iterator that is closed early, since its reader has gone, stops the order.
        """
        key = str(asked.get("key", ""))
        async with self.turn:
            if key in self.stopped:
                self.stopped.discard(key)
                yield packed({"type": "end", "how": "stopped"})
                return
            worker = await self._worker()
            self.number += 1
            self.running = (self.number, key)
            ended = False
            try:
                async for message in worker.answers(self._order(asked)):
                    ended = message.header["type"] == "end"
                    yield message.raw
            except WorkerEnded:
                self.worker, ended = None, True
                wanted = key in self.stopped
                how = {"how": "stopped"} if wanted else {"how": "died", "message": _DIED}
                yield packed({"type": "end", **how})
            finally:
                self.stopped.discard(key)
                if not ended:
                    await self._leave(worker, self.number)
                self.running = None

    async def stop(self, key: str) -> None:
        """Stop the order that the page calls `key`, now or when its turn comes; in `_GRACE` it is over."""
        self.stopped.add(key)
        if self.running is None or self.running[1] != key or self.worker is None:
            return
        running, worker = self.running, self.worker
        try:
            await worker.stop(running[0])
        except WorkerEnded:
            return
        await asyncio.sleep(_GRACE)
        if self.running == running:
            await self.crew.dismiss(worker)

    async def end(self) -> None:
        """End its worker, and remove its files."""
        worker, self.worker = self.worker, None
        if worker is not None:
            await self.crew.dismiss(worker)
        shutil.rmtree(self.folder, ignore_errors=True)

    async def _worker(self) -> WorkerProcess:
        if self.worker is not None and not self.worker.alive:
            await self.crew.dismiss(self.worker)
            self.worker = None
        if self.worker is None:
            self.worker = await self.crew.take()
        return self.worker

    async def _leave(self, worker: WorkerProcess, number: int) -> None:
        """Have the worker leave an order whose reader is gone, or end it."""
        try:
            await worker.stop(number)
            await asyncio.wait_for(worker.finish(), _GRACE)
        except (TimeoutError, WorkerEnded):
            await self.crew.dismiss(worker)
            self.worker = None

    def _order(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Return the order with what the page cannot state: its number, and where the files lie."""
        files = {key: {"path": str(each.path), "name": each.name} for key, each in self.files.items()}
        stated = {name: asked.get(name) for name in ("job", "recipe", "more")}
        return {**stated, "number": self.number, "files": files}
