"""One tab of a browser: its files, and two queues, so that a curve does not keep the slider waiting."""

from __future__ import annotations

import asyncio
import shutil
from collections.abc import AsyncIterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic
from typing import Any

from roughcontact.page.jobs.session_cache import UploadedFile
from roughcontact.page.server.request_queue import RequestQueue
from roughcontact.page.server.worker_pool import WorkerPool

__all__ = ["Session"]


@dataclass(slots=True, eq=False)
class Session:
    """What the server knows of a tab. All else is stated by the page with every request.

    Parameters
    ----------
    front, back : RequestQueue
        For what is under the hand, and for what takes its time.
    folder : Path
        Where its files lie; it goes with the session.
    files : dict of str to UploadedFile
        By the names that the page was given.
    heard : float
        When its tab last said something [s], on the clock of `time.monotonic`.
    """

    front: RequestQueue
    back: RequestQueue
    folder: Path
    files: dict[str, UploadedFile] = field(default_factory=dict)
    heard: float = field(default_factory=monotonic)

    @classmethod
    def of(cls, pool: WorkerPool, folder: Path, files: dict[str, UploadedFile]) -> Session:
        """Return a new session, whose workers come from a pool."""
        return cls(RequestQueue(pool), RequestQueue(pool), folder, files)

    @property
    def busy(self) -> bool:
        """Whether something is computed for it."""
        return self.front.busy or self.back.busy

    def perform(self, asked: Mapping[str, Any]) -> AsyncIterator[bytes]:
        """Return the messages that answer a request of the page."""
        files = {key: {"path": str(each.path), "name": each.name} for key, each in self.files.items()}
        request = {**{name: asked.get(name) for name in ("job", "recipe", "more")}, "files": files}
        return self._queue(asked.get("queue")).perform(str(asked.get("key", "")), request)

    async def stop(self, queue: str, key: str) -> None:
        """Stop a request, by the key that the page gave it."""
        await self._queue(queue).stop(key)

    async def end(self) -> None:
        """End its workers, and remove its files."""
        await asyncio.gather(self.front.end(), self.back.end())
        shutil.rmtree(self.folder, ignore_errors=True)

    def _queue(self, name: object) -> RequestQueue:
        return self.back if name == "back" else self.front
