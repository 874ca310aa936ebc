"""A local worker: a separate process that computes one task after the other and communicates by its standard streams.

It is not a child of `multiprocessing`: such a child runs the user's script again before it works, and a pool breaks
when its first member dies. This one only imports the modules of its tasks, does not receive Ctrl-C of the terminal,
and always ends with the process that started it.
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

# Libraries of linear algebra and compiled loops read these when they are loaded.
ONE_THREAD = dict.fromkeys(
    (
        *("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "BLIS_NUM_THREADS"),
        *("VECLIB_MAXIMUM_THREADS", "NUMBA_NUM_THREADS"),
    ),
    "1",
)
BOOT = "import sys; sys.path[:] = {path!r}; from roughcontact.study.executors.process import serve; serve()"
PATIENCE = 5.0  # [s] for a process to end after a request
QUICK = 0.5  # [s]; a worker that answers faster is given the next task in advance


@dataclass(frozen=True, slots=True)
class Attempt:
    """A task, and the number of workers that have died while computing it."""

    task: Task
    deaths: int = 0


@dataclass(slots=True, eq=False)
class Worker:
    """The coordinator's side of a worker.

    Parameters
    ----------
    run_task : bytes
        The pickled function that computes a task.
    inbox : queue of pairs
        Receives ``(worker, message)``: None once it is ready, the bytes of a result, or a text if it cannot load a
        message; ``EOFError`` is the last one, when its process has ended.
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
        """Process number."""
        return self._process.pid

    def give(self, attempt: Attempt) -> None:
        """Send a task, which is computed after the earlier ones."""
        self.held.append(attempt)
        self._send(pickled(attempt.task, f"the case {attempt.task.case.name!r}"))

    def answered(self, seconds: float) -> None:
        """Remove the first task, whose computation took this number of seconds."""
        self.held.popleft()
        # Sending the next task in advance hides the time to store a result. Long tasks are not sent in advance: they
        # could wait while another worker is idle.
        self.room = 2 if seconds < QUICK else 1

    def death(self) -> str:
        """Return how the process ended; it has ended, because its stream is closed."""
        self._hang_up()
        status = self._ended()
        if status == -9:
            return "signal 9 (killed; out of memory?)"
        if status < 0:
            return f"signal {-status} ({signal.strsignal(-status)})"
        return f"exit status {status}"

    def stop(self) -> None:
        """End the process, also during a task, and wait until it has ended."""
        self.dismiss()
        self._ended()

    def dismiss(self) -> None:
        """Make the process end, without waiting for it."""
        self._hang_up()
        if self.held:
            self._process.terminate()

    def _hang_up(self) -> None:
        assert self._process.stdin is not None
        with suppress(OSError):  # data that the process has not read cannot be flushed
            self._process.stdin.close()

    def _ended(self) -> int:
        try:
            return self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            return self._process.wait()

    def _send(self, message: bytes) -> None:
        assert self._process.stdin is not None
        with suppress(OSError):  # if the process has ended, the listener reports it
            _write(self._process.stdin, message)

    def _listen(self) -> None:
        assert self._process.stdout is not None
        with self._process.stdout as stream:
            _read(stream, lambda message: self.inbox.put((self, message)))
        self.inbox.put((self, EOFError))


def serve() -> None:
    """Compute the tasks on standard input until it is closed: the main program of a worker."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # The input and output of a case must be separate from the messages.
    incoming, outgoing = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    with open(os.devnull, "rb") as nothing:
        os.dup2(nothing.fileno(), 0)
    os.dup2(2, 1)
    inbox: queue.SimpleQueue[bytes] = queue.SimpleQueue()

    def listen() -> None:
        _read(incoming, inbox.put)
        os._exit(0)  # the coordinator has finished or ended: exit at once, also during a computation

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
    """Pass messages on until the stream ends, possibly within a message."""
    with suppress(EOFError, OSError, pickle.UnpicklingError):
        while True:
            use(pickle.load(stream))
