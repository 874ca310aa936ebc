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


def spread(work: Callable[[T], None], items: Sequence[T], least: int = 2) -> None:
    """Do some work on all items, on several threads if there are any, and at least so many items.

    What is done to one item must not hang on what is done to another: so it does not hang on the number of threads.
    If this is interrupted, others may still be at work: `work` must hold what they look at.
    """
    count = min(threads(), len(items))
    if count < 2 or len(items) < least:
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
    wanted = [work]
    try:
        if count > 1:
            _crew().call(wanted, range(1, count))
        work(0)
    finally:
        wanted.clear()  # who has not come holds nothing any more


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
    return max(1, min(MOST, cores, int(asked) if asked.isdecimal() and int(asked) else cores))


class _Crew:
    """Threads that wait for calls, of which nobody asks what became of them.

    A pool, which could tell, takes more than ten times as long to call one (tried by hand).
    """

    def __init__(self) -> None:
        self._calls: SimpleQueue[tuple[list[Callable[[int], None]], int]] = SimpleQueue()
        self._size = 0
        self._lock = Lock()

    def call(self, wanted: list[Callable[[int], None]], numbers: Sequence[int]) -> None:
        """Have others do the work that is wanted when they come to it, for each number."""
        if self._size < len(numbers):
            with self._lock, suppress(RuntimeError):  # there may be no more threads
                while self._size < len(numbers):
                    Thread(target=self._answer, name=f"roughcontact-{self._size}", daemon=True).start()
                    self._size += 1
        for k in numbers:
            self._calls.put((wanted, k))

    def _answer(self) -> None:
        while True:
            wanted, k = self._calls.get()
            for work in wanted[:1]:
                with suppress(BaseException):  # whoever called could do all alone
                    work(k)
                del work  # what it holds is not held while waiting
            del wanted


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
