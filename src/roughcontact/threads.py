"""How many threads work is done by."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from functools import cache
from queue import SimpleQueue
from threading import Lock, Thread
from typing import TypeVar

from threadpoolctl import ThreadpoolController

__all__ = ["join_in", "limit_threads", "one_blas_thread", "spread", "threads"]

T = TypeVar("T")

MOST = 8  # transforms wait for memory: more threads than this find none

_limit: ContextVar[int | None] = ContextVar("threads", default=None)


def threads() -> int:
    """Return how many threads there are for large transforms.

    As many as the process may use cores, 8 at most, or fewer if ``OMP_NUM_THREADS`` says so; one within a case of a
    study, of which others run beside it.
    """
    limit = _limit.get()
    return _available() if limit is None else limit


@contextmanager
def limit_threads(count: int) -> Iterator[None]:
    """Use so many threads meanwhile."""
    token = _limit.set(count)
    try:
        yield
    finally:
        _limit.reset(token)


def spread(work: Callable[[T], None], items: Sequence[T]) -> None:
    """Do some work on all items, on several threads if there are any.

    What is done to one item must not hang on what is done to another: so it does not hang on the number of threads.
    """
    count = min(threads(), len(items))
    if count < 2:
        for item in items:
            work(item)
        return

    def share(first: int) -> None:
        for item in items[first::count]:
            work(item)

    others = [_pool().submit(share, first) for first in range(1, count)]
    try:
        share(0)
    finally:
        for other in others:
            other.result()


def join_in(work: Callable[[int], None], count: int) -> None:
    """Have several threads, numbered from 0, join in some work, of which each takes what is left.

    The first is this one: it could do all alone, and when it returns all is done. It waits for no other to come, or to
    find that nothing is left: `work` must hold what they look at. If it is interrupted, others may still be at work.
    """
    wanted = [True]
    try:
        if count > 1:
            _crew().call(work, range(1, count), wanted)
        work(0)
    finally:
        wanted.clear()


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Keep BLAS and LAPACK to one thread meanwhile.

    The factorisations here are small. A second thread makes them at best twice as fast on an idle machine, and
    much slower where another process wants a core, since BLAS threads spin while they wait for each other.
    """
    with _controller().limit(limits=1, user_api="blas"):
        yield


@cache
def _available() -> int:
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    asked = os.environ.get("OMP_NUM_THREADS", "")
    return max(1, min(MOST, cores, int(asked) if asked.isdigit() and int(asked) else cores))


class _Crew:
    """Threads that wait for calls, of which nobody asks what became of them: a pool takes ten times as long to ask."""

    def __init__(self) -> None:
        self._calls: SimpleQueue[tuple[Callable[[int], None], int, list[bool]]] = SimpleQueue()
        self._size = 0
        self._lock = Lock()

    def call(self, work: Callable[[int], None], numbers: Sequence[int], wanted: list[bool]) -> None:
        """Have others do some work for each number, as long as it is wanted when they come to it."""
        if self._size < len(numbers):
            with self._lock:
                while self._size < len(numbers):
                    Thread(target=self._answer, name=f"roughcontact-{self._size}", daemon=True).start()
                    self._size += 1
        for k in numbers:
            self._calls.put((work, k, wanted))

    def _answer(self) -> None:
        while True:
            work, k, wanted = self._calls.get()
            if wanted:
                with suppress(BaseException):  # whoever called could do all alone
                    work(k)
            del work, wanted  # what they hold is not held while waiting


@cache
def _crew() -> _Crew:
    return _Crew()


@cache
def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(MOST, thread_name_prefix="roughcontact")


@cache
def _controller() -> ThreadpoolController:
    return ThreadpoolController()


if hasattr(os, "register_at_fork"):
    for _threads in (_pool, _crew):
        os.register_at_fork(after_in_child=_threads.cache_clear)  # a forked process has none of these threads
