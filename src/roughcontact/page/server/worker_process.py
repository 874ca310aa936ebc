"""A worker as the server sees it: started, given a request, stopped, ended."""

from __future__ import annotations

import asyncio
import contextlib
import os
import sys
from collections.abc import AsyncIterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from roughcontact.page import page_worker
from roughcontact.page.frames import LENGTHS, header_of, lengths_of, packed

__all__ = ["Message", "WorkerEndedError", "WorkerProcess"]

_BUFFER = 2**22


@dataclass(frozen=True, slots=True)
class Message:
    """What a worker said: its header, and all of it as it goes to the page."""

    header: Mapping[str, Any]
    raw: bytes


class WorkerEndedError(RuntimeError):
    """The process is gone: it was killed, or ran out of memory."""


@dataclass(slots=True, eq=False)
class WorkerProcess:
    """One process that computes, and the messages that have come from it."""

    process: asyncio.subprocess.Process
    messages: asyncio.Queue[Message | None] = field(default_factory=asyncio.Queue)
    listener: asyncio.Task[None] | None = None

    @classmethod
    async def start(cls, folder: Path) -> WorkerProcess:
        """Start one, whose temporary files lie in a folder; it is of use when it is `ready`."""
        process = await asyncio.create_subprocess_exec(
            *(sys.executable, "-m", page_worker.__name__),
            stdin=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.PIPE,
            limit=_BUFFER,
            env=os.environ | dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder)),
            start_new_session=sys.platform != "win32",  # Ctrl-C is for the server, which ends its workers
        )
        started = cls(process)
        started.listener = asyncio.create_task(started._listen())
        return started

    async def ready(self) -> WorkerProcess:
        """Wait until it can take a request."""
        if await self.messages.get() is None:
            raise WorkerEndedError(
                "the process that computes did not start: see what it wrote where the server runs"
            )
        return self

    @property
    def alive(self) -> bool:
        """Whether it has not ended."""
        return self.process.returncode is None and not (self.listener is not None and self.listener.done())

    async def answers(self, request: Mapping[str, Any]) -> AsyncIterator[Message]:
        """Yield the messages that answer a request, the last of which says how it ended.

        Raises
        ------
        WorkerEndedError
            If the process ended before.
        """
        await self._tell(request)
        while True:
            message = await self.messages.get()
            if message is None:
                raise WorkerEndedError
            yield message
            if message.header["type"] == "end":
                return

    async def stop(self, number: int) -> None:
        """Ask it to leave a request."""
        await self._tell({"stop": number})

    async def finish(self) -> None:
        """Let the rest of an answer go by, whose reader is gone."""
        while (message := await self.messages.get()) is not None and message.header["type"] != "end":
            pass

    def kill(self) -> None:
        """End it, whatever it is doing."""
        with contextlib.suppress(ProcessLookupError):
            self.process.kill()

    async def gone(self) -> None:
        """Wait for its end."""
        await self.process.wait()
        if self.listener is not None:
            await self.listener

    async def _tell(self, words: Mapping[str, Any]) -> None:
        stdin = self.process.stdin
        if stdin is None or not self.alive:
            raise WorkerEndedError
        try:
            stdin.write(packed(words))
            await stdin.drain()
        except (BrokenPipeError, ConnectionResetError) as error:
            raise WorkerEndedError from error

    async def _listen(self) -> None:
        out = self.process.stdout
        if out is None:
            return
        with contextlib.suppress(asyncio.IncompleteReadError, ConnectionResetError):
            while True:
                start = await out.readexactly(LENGTHS)
                words, data = lengths_of(start)
                body = await out.readexactly(words + data)
                self.messages.put_nowait(Message(header_of(body[:words]), start + body))
        self.messages.put_nowait(None)
