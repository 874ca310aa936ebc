"""The processes that compute for the open tabs: started, given requests, cancelled, killed, replaced and ended.

Each tab has a session with two queues, so that the slider need not wait for a curve. Each queue has a worker, which
answers one request after the other. One more worker is kept warm in reserve, for a new tab or in place of a killed one.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import secrets
import shutil
import sys
from collections.abc import AsyncGenerator, AsyncIterator, Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic
from typing import Any

from roughcontact.page import page_worker
from roughcontact.page.frames import LENGTHS, header_of, lengths_of, packed
from roughcontact.page.jobs.session_cache import UploadedFile
from roughcontact.page.server.server_folder import SCRATCH

__all__ = ["GIVEN", "MOST_SESSIONS", "Session", "Sessions"]

MOST_SESSIONS = 8  # each has up to two processes
GIVEN = "given"  # name of the command line's file on the page
_DELAY = 3.0  # seconds before the next reserve is started: the first answer comes first
_GRACE = 0.15  # seconds for a cancelled request to end, before its process is killed
_DIED = (
    "The computing process was killed, or it ran out of memory. A new one takes over: press Compute again, or Start "
    "for a curve."
)
_NOT_STARTED = "The computing process did not start: read its messages in the terminal of roughcontact serve."


@dataclass(slots=True, eq=False)
class _Worker:
    """A process that answers one request at a time, and a task that listens to it."""

    process: asyncio.subprocess.Process
    idle: asyncio.Event = field(default_factory=asyncio.Event)  # set while no request is computed
    messages: asyncio.Queue[bytes] = field(default_factory=asyncio.Queue)
    number: int = 0  # of the latest request, to which `messages` belong
    cancelled: bool = False  # whether the latest request was cancelled
    listener: asyncio.Task[None] = field(init=False)

    def __post_init__(self) -> None:
        self.listener = asyncio.create_task(self._listen())

    @classmethod
    async def start(cls, folder: Path) -> _Worker:
        """Return a warm worker, whose temporary files lie in a folder; an OSError if it cannot be started."""
        process = await asyncio.create_subprocess_exec(
            *(sys.executable, "-m", page_worker.__name__),
            stdin=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.PIPE,
            limit=2**22,  # bytes, so that maps come in few parts
            env=os.environ | dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder)),
            start_new_session=sys.platform != "win32",  # only the server gets Ctrl-C; it ends its workers
        )
        worker = cls(process)
        try:
            await worker.idle.wait()
        except asyncio.CancelledError:
            await worker.end()
            raise
        if not worker.alive:
            raise ChildProcessError(_NOT_STARTED)
        return worker

    @property
    def alive(self) -> bool:
        out = self.process.stdout  # it ends before the process is reaped, which needs a thread
        return out is not None and not out.at_eof() and not self.listener.done()

    def begin(self, request: Mapping[str, Any]) -> None:
        """Send it a request."""
        self.number, self.cancelled, self.messages = self.number + 1, False, asyncio.Queue()
        self.idle.clear()
        self._send({**request, "number": self.number})

    async def cancel(self) -> None:
        """Cancel the request, if one is computed; when this returns, the request or the process has ended."""
        if self.idle.is_set():
            return
        number, self.cancelled = self.number, True
        self._send({"stop": number})
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(_GRACE):
                await self.idle.wait()
        if self.number == number and not self.idle.is_set():
            await self.end()

    async def end(self) -> None:
        """Kill the process at once."""
        with contextlib.suppress(ProcessLookupError):
            self.process.kill()
        await asyncio.wait({self.listener})

    def _send(self, header: Mapping[str, Any]) -> None:
        assert self.process.stdin is not None  # it is a pipe
        self.process.stdin.write(packed(header))  # without an error where the process has ended

    async def _listen(self) -> None:
        out = self.process.stdout
        assert out is not None  # it is a pipe
        with contextlib.suppress(asyncio.IncompleteReadError, ConnectionResetError):
            while True:
                start = await out.readexactly(LENGTHS)
                words, data = lengths_of(start)
                body = await out.readexactly(words + data)
                self.messages.put_nowait(start + body)
                if header_of(body[:words])["type"] in ("ready", "end"):
                    self.idle.set()
        await self.process.wait()
        if not self.idle.is_set():
            self.messages.put_nowait(_end("stopped") if self.cancelled else _end("died", message=_DIED))
            self.idle.set()


def _end(how: str, **more: str) -> bytes:
    return packed({"type": "end", "how": how, **more})


@dataclass(slots=True, eq=False)
class _RequestQueue:
    """The requests of a session to one worker, answered one after the other."""

    take: Callable[[], Awaitable[_Worker]]  # provides a worker
    worker: _Worker | None = None
    running: str | None = None  # key of the request that is computed
    unwanted: set[str] = field(default_factory=set)  # keys of requests that were stopped before their turn
    turn: asyncio.Lock = field(default_factory=asyncio.Lock)  # held while a request is answered

    async def perform(self, key: str, request: Mapping[str, Any]) -> AsyncGenerator[bytes]:
        """Yield the messages that answer a request; it is cancelled when the iterator is closed early."""
        async with self.turn:
            try:
                if self.worker is None or not self.worker.alive:
                    self.worker = await self.take()
            except OSError as error:
                yield _end("died", message=str(error))
                return
            if key in self.unwanted:
                self.unwanted.discard(key)
                yield _end("stopped")
                return
            worker, self.running = self.worker, key
            worker.begin(request)
            try:
                while not (worker.idle.is_set() and worker.messages.empty()):
                    yield await worker.messages.get()
            finally:
                self.running = None
                await worker.cancel()

    async def stop(self, key: str) -> None:
        """Stop a request, now or when its turn comes."""
        if self.worker is not None and self.running == key:
            await self.worker.cancel()
        else:
            self.unwanted.add(key)


@dataclass(slots=True, eq=False)
class Session:
    """The server's state of a tab; every request of the page contains everything else.

    Parameters
    ----------
    front, back : _RequestQueue
        For requests that must not wait, and for long ones.
    folder : Path
        The folder of its files; it is removed with the session.
    files : dict of str to UploadedFile
        The files by their names on the page.
    heard : float
        When its tab last sent a request [s], on the clock of `time.monotonic`.
    leaving : asyncio.Task or None
        Of a tab that was closed or is being reloaded: ends the session after a short time.
    """

    front: _RequestQueue
    back: _RequestQueue
    folder: Path
    files: dict[str, UploadedFile]
    heard: float = field(default_factory=monotonic)
    leaving: asyncio.Task[None] | None = None

    @property
    def busy(self) -> bool:
        """Whether a request is being computed or waiting."""
        return self.front.turn.locked() or self.back.turn.locked()

    def queue(self, name: object) -> _RequestQueue:
        """Return the queue that a request of the page names."""
        return self.back if name == "back" else self.front

    def perform(self, asked: Mapping[str, Any]) -> AsyncGenerator[bytes]:
        """Return the messages that answer a request; the last one states the outcome."""
        files = {key: {"path": str(each.path), "name": each.name} for key, each in self.files.items()}
        request = {**{name: asked.get(name) for name in ("job", "recipe", "more")}, "files": files}
        return self.queue(asked.get("queue")).perform(str(asked.get("key", "")), request)

    async def end(self) -> None:
        """End its workers, and remove its files."""
        workers = (self.front.worker, self.back.worker)
        await asyncio.gather(*(worker.end() for worker in workers if worker is not None))
        shutil.rmtree(self.folder, ignore_errors=True)


@dataclass(slots=True, eq=False)
class Sessions:
    """The sessions of the open tabs, and all workers.

    Parameters
    ----------
    folder : Path
        The folder of the server: each session has a folder in it, and the workers have one for temporary files.
    given : UploadedFile or None
        The file of the command line, which all sessions may read.
    silent : float
        A session is ended when its tab sends nothing for this time [s].
    room : float
        The same time if a new session would exceed the maximum number.
    grace : float
        The session of a closed tab is kept for this time [s], because the tab may be reloading.
    """

    folder: Path
    given: UploadedFile | None = None
    silent: float = 3600.0  # tabs report twice a minute, hidden tabs once, frozen tabs never
    room: float = 180.0
    grace: float = 5.0
    known: dict[str, Session] = field(default_factory=dict)
    workers: set[_Worker] = field(default_factory=set)
    reserve: asyncio.Task[_Worker] | None = None

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """Keep a worker in reserve and end silent sessions while the block runs; no process outlives it."""
        self._prepare()
        watching = asyncio.create_task(self._watch())
        try:
            yield
        finally:
            tasks = watching, self._prepare()  # a delayed call then finds a reserve
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)
            await asyncio.gather(*(worker.end() for worker in self.workers))

    async def begin(self) -> str | None:
        """Open a session and return its key; None if there are too many."""
        if len(self.known) >= MOST_SESSIONS:
            await self._end_silent(self.room)
        leaving = [each.leaving for each in self.known.values() if each.leaving is not None]
        if len(self.known) >= MOST_SESSIONS and leaving:
            await asyncio.wait(leaving, return_when=asyncio.FIRST_COMPLETED)
        if len(self.known) >= MOST_SESSIONS:
            return None
        key = secrets.token_hex(16)
        place = self.folder / key
        place.mkdir(mode=0o700)
        files = {} if self.given is None else {GIVEN: self.given}
        self.known[key] = Session(_RequestQueue(self._take), _RequestQueue(self._take), place, files)
        return key

    def find(self, key: str) -> Session | None:
        """Return a session, and note that its tab has sent something."""
        if (session := self.known.get(key)) is not None:
            session.heard = monotonic()
        return session

    def leave(self, key: str) -> None:
        """End a session, if it is open, unless its tab is back within a short time."""
        if (session := self.known.get(key)) is not None and session.leaving is None:
            session.leaving = asyncio.create_task(self._end_left(key))

    def back(self, key: str) -> bool:
        """Return whether a session is open whose tab was closed; keep it, because the tab is back."""
        if (session := self.find(key)) is None or session.leaving is None:
            return False
        session.leaving.cancel()
        session.leaving = None
        return True

    async def _end_left(self, key: str) -> None:
        await asyncio.sleep(self.grace)
        await self.end(key)

    async def end(self, key: str) -> None:
        """End a session, if it is open."""
        if (session := self.known.pop(key, None)) is not None:
            await session.end()

    async def _watch(self) -> None:
        while True:
            await asyncio.sleep(self.silent / 10)
            await self._end_silent(self.silent)

    async def _end_silent(self, limit: float) -> None:
        before = monotonic() - limit
        for key in [key for key, each in self.known.items() if each.heard < before and not each.busy]:
            await self.end(key)

    def _prepare(self) -> asyncio.Task[_Worker]:
        if self.reserve is None:
            self.reserve = asyncio.create_task(self._start())
        return self.reserve

    async def _take(self) -> _Worker:
        """Return the worker in reserve, or a new worker if the former has ended."""
        reserve, self.reserve = self._prepare(), None
        asyncio.get_running_loop().call_later(_DELAY, self._prepare)
        with contextlib.suppress(OSError):
            if (worker := await reserve).alive:
                return worker
        return await self._start()

    async def _start(self) -> _Worker:
        worker = await _Worker.start(self.folder / SCRATCH)
        self.workers = {each for each in self.workers if each.alive} | {worker}
        return worker
