"""A local worker: a process of its own that answers one task after the other through its standard streams.

Not a child of `multiprocessing`: such a child runs the user's script once more before it works, and a pool of them is
lost with its first member. This one imports nothing but what its tasks name, stands aside from the terminal's Ctrl-C,
and ends by itself with the process that started it, however that ends.
"""

from __future__ import annotations

import os
import pickle
import queue
import signal
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from typing import IO, Any

from roughcontact.study.executors.worker import computed, pickled
from roughcontact.study.task import RunTask, Task

__all__ = ["Attempt", "Worker", "serve"]

# Read by linear algebra and compiled loops when they are loaded.
ONE_THREAD = dict.fromkeys(
    (
        *("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "BLIS_NUM_THREADS"),
        *("VECLIB_MAXIMUM_THREADS", "NUMBA_NUM_THREADS"),
    ),
    "1",
)
BOOT = "import sys; sys.path[:] = {path!r}; from roughcontact.study.executors.process import serve; serve()"
PATIENCE = 5.0  # [s] for a process that was asked to end
QUICK = 0.5  # [s]; a worker that answers faster is given the next task in advance


@dataclass(frozen=True, slots=True)
class Attempt:
    """A task, and how many workers died of it so far."""

    task: Task
    deaths: int = 0


@dataclass(slots=True, eq=False)
class Worker:
    """The coordinator's end.

    Parameters
    ----------
    run_task : bytes
        The pickled function that the tasks are put to.
    inbox : queue of pairs
        Receives ``(worker, message)``: None once it is ready, the bytes of a result, a text where it cannot load
        what it was sent; and ``EOFError`` as the last one, when its process is gone.
    """

    run_task: bytes
    inbox: queue.SimpleQueue[tuple[Worker, Any]]
    held: deque[Attempt] = field(default_factory=deque)  # the first is being computed
    room: int = 1
    ready: bool = False
    _process: subprocess.Popen[bytes] = field(init=False)

    def __post_init__(self) -> None:
        """Start the process; it is ready some tenths of a second later."""
        self._process = subprocess.Popen(
            [sys.executable, "-u", "-c", BOOT.format(path=sys.path)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, **ONE_THREAD},
            process_group=0 if os.name == "posix" else None,
            creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),
        )
        self._send(self.run_task)
        threading.Thread(target=self._listen, name=f"worker {self.pid}", daemon=True).start()

    @property
    def pid(self) -> int:
        """Number of the process."""
        return self._process.pid

    def give(self, attempt: Attempt) -> None:
        """Have a task computed after those that the worker holds already."""
        self.held.append(attempt)
        self._send(pickled(attempt.task, f"the case {attempt.task.case.name!r}"))

    def answered(self, seconds: float) -> None:
        """Strike the first task off, which took so many seconds."""
        self.held.popleft()
        # The next one in advance bridges the time that the coordinator takes to store a result. Long tasks would
        # wait behind each other while a worker is idle.
        self.room = 2 if seconds < QUICK else 1

    def death(self) -> str:
        """Return how the process ended; it is gone, or it would not have closed its stream."""
        self._hang_up()
        status = self._ended()
        if status == -9:
            return "signal 9 (killed; out of memory?)"
        if status < 0:
            return f"signal {-status} ({signal.strsignal(-status)})"
        return f"exit status {status}"

    def stop(self) -> None:
        """End the process, in the middle of a task too, and wait until it has gone."""
        self.dismiss()
        self._ended()

    def dismiss(self) -> None:
        """Tell the process to end, without waiting for it."""
        self._hang_up()
        if self.held:
            self._process.terminate()

    def _hang_up(self) -> None:
        assert self._process.stdin is not None
        with suppress(OSError):  # what it did not read any more cannot be flushed
            self._process.stdin.close()

    def _ended(self) -> int:
        try:
            return self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            return self._process.wait()

    def _send(self, message: bytes) -> None:
        assert self._process.stdin is not None
        with suppress(OSError):  # of a process that is gone: the listener says so
            _write(self._process.stdin, message)

    def _listen(self) -> None:
        assert self._process.stdout is not None
        with self._process.stdout as stream:
            _read(stream, lambda message: self.inbox.put((self, message)))
        self.inbox.put((self, EOFError))


def serve() -> None:
    """Compute what comes in on the standard input until its other end is closed: the worker's own main program."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # Whatever a case reads or prints must not meet the messages.
    incoming, outgoing = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    with open(os.devnull, "rb") as nothing:
        os.dup2(nothing.fileno(), 0)
    os.dup2(2, 1)
    inbox: queue.SimpleQueue[bytes] = queue.SimpleQueue()

    def listen() -> None:
        _read(incoming, inbox.put)
        os._exit(0)  # the coordinator needs no more, or is no more: at once, whatever is being computed

    threading.Thread(target=listen, daemon=True).start()
    with suppress(OSError):
        _write(outgoing, None)
        run_task: RunTask | None = None
        while True:
            message = inbox.get()
            try:
                loaded = pickle.loads(message)
            except Exception as error:
                _write(outgoing, f"{type(error).__name__}: {error}")
                continue
            if run_task is None:
                run_task = loaded
            else:
                _write(outgoing, computed(run_task, loaded))


def _write(stream: IO[bytes], message: object) -> None:
    pickle.dump(message, stream, pickle.HIGHEST_PROTOCOL)
    stream.flush()


def _read(stream: IO[bytes], use: Callable[[Any], None]) -> None:
    """Hand messages on until there are no more, or only a part of one."""
    with suppress(EOFError, OSError, pickle.UnpicklingError):
        while True:
            use(pickle.load(stream))
