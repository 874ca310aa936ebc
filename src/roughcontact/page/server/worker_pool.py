"""The workers of a server: one for every session that computes, and one in reserve that is warm."""

from __future__ import annotations

import asyncio
import contextlib
from dataclasses import dataclass, field
from pathlib import Path

from roughcontact.page.server.worker_process import WorkerEndedError, WorkerProcess

__all__ = ["WorkerPool"]

_BREATH = 3.0  # seconds before the next reserve is started: the first answer comes first


@dataclass(slots=True, eq=False)
class WorkerPool:
    """Workers that are ready to be taken, one of them in reserve.

    Parameters
    ----------
    folder : Path
        For their temporary files, which go with the server even where they were killed.
    """

    folder: Path
    reserve: asyncio.Task[WorkerProcess] | None = None
    at_work: set[WorkerProcess] = field(default_factory=set)
    soon: asyncio.TimerHandle | None = None

    def prepare(self) -> None:
        """Start the worker in reserve."""
        self.soon = None
        if self.reserve is None:
            self.reserve = asyncio.create_task(self._started())

    async def take(self) -> WorkerProcess:
        """Return a warm worker, and see to the next.

        Raises
        ------
        WorkerEndedError
            If none can be started.
        """
        self.prepare()
        reserve, self.reserve = self.reserve, None
        if self.soon is None:
            self.soon = asyncio.get_running_loop().call_later(_BREATH, self.prepare)
        # It may have been killed while it started, or while it waited.
        with contextlib.suppress(WorkerEndedError):
            if reserve is not None and (taken := await reserve).alive:
                return taken
        return await self._started()

    async def dismiss(self, worker: WorkerProcess) -> None:
        """End a worker."""
        self.at_work.discard(worker)
        worker.kill()
        await worker.gone()

    async def end(self) -> None:
        """End all of them."""
        if self.soon is not None:
            self.soon.cancel()
        if self.reserve is not None:
            self.reserve.cancel()
            await asyncio.gather(self.reserve, return_exceptions=True)
        for worker in tuple(self.at_work):
            await self.dismiss(worker)

    async def _started(self) -> WorkerProcess:
        worker = await WorkerProcess.start(self.folder)
        self.at_work.add(worker)
        try:
            return await worker.ready()
        except BaseException:
            worker.kill()
            raise
