"""How many threads work is done by, and what forks wait for."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager, suppress
from contextvars import ContextVar
from functools import cache, wraps
from queue import SimpleQueue
from threading import Lock, RLock, Thread, get_ident
from time import monotonic, sleep
from typing import TYPE_CHECKING, Any, TypeVar, TypeVarTuple, cast

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController

__all__ = [
    "controller",
    "join_in",
    "limit_threads",
    "limits",
    "no_fork",
    "once",
    "one_blas_thread",
    "spread",
    "threads",
    "wake",
    "wakes_pending",
]

T = TypeVar("T")
Ts = TypeVarTuple("Ts")

MOST = 8  # transforms wait for memory: more threads than this find none
# Where launchers of MPI say how many processes they have started on this machine: MPICH and its kin; Open MPI.
BESIDE = "MPI_LOCALNRANKS", "OMPI_COMM_WORLD_LOCAL_SIZE"
LONGEST = 1.0  # [s] that a fork waits for other threads that compute

_limit: ContextVar[int | None] = ContextVar("threads", default=None)

# Held for what a forked process must not find half done: a fork waits until it is free. One lock for all such things,
# so that no two can wait for each other.
no_fork = RLock()


def once(function: Callable[[*Ts], T]) -> Callable[[*Ts], T]:
    """Keep what a function returns, as `functools.cache` does; one thread computes it, and others and forks wait.

    For what takes long, or takes locks that a fork must not catch, as an import does. It must not enter
    `one_blas_thread`, where it would wait for a fork that waits for it.
    """
    computed = cache(function)

    def waiting(*arguments: *Ts) -> T:
        with no_fork:
            return computed(*arguments)

    # What is kept is found without a lock, and without a frame of Python's.
    kept: Any = wraps(function)(cache(waiting))
    clear = kept.cache_clear

    def cache_clear() -> None:
        clear()
        computed.cache_clear()

    kept.cache_clear = cache_clear
    return cast(Callable[[*Ts], T], kept)


def threads() -> int:
    """Return how many threads there are for large transforms.

    As many as the process may use cores, 8 at most, or fewer by ``OMP_NUM_THREADS``; without it the processes
    that MPI has started on a machine share its cores. One within a case of a study, of which others run beside it.
    """
    limit = _limit.get()
    return _available() if limit is None else limit


@contextmanager
def limit_threads(count: int) -> Iterator[None]:
    """Use `count` threads meanwhile."""
    token = _limit.set(count)
    try:
        yield
    finally:
        _limit.reset(token)


def spread(work: Callable[[T], None], items: Sequence[T], least: int = 2) -> None:
    """Do some work on all items, on several threads if there are several threads and at least `least` items.

    What is done to one item must not depend on what is done to another; then nothing depends on the number of threads.
    Each takes the next that is left, so that no thread waits for one that starts late. If this is interrupted,
    others may still be at work: `work` must hold what they look at.
    """
    count = min(threads(), len(items))
    if count < 2 or len(items) < least:
        for item in items:
            work(item)
        return
    left, begun = iter(items), list[int]()
    ended: SimpleQueue[BaseException | None] = SimpleQueue()

    def take(k: int) -> None:
        begun.append(k)
        try:
            for item in left:
                work(item)
        except BaseException as error:  # the caller raises it
            deque(left, 0)  # the others stop, too
            ended.put(error)
        else:
            ended.put(None)

    join_in(take, count)
    # Nothing is left: who comes now does nothing, and only those who took something are waited for.
    errors = [*filter(None, (ended.get() for _ in begun.copy()))]
    if errors:
        try:
            raise min(errors, key=lambda each: isinstance(each, Exception))  # Ctrl-C first
        finally:
            errors.clear()  # they hold this frame


def join_in(work: Callable[[int], None], count: int) -> None:
    """Have several threads, numbered from 0, join in some work, of which each takes what is left.

    The first is this one: it could do all by itself, and when it returns all is done. It waits for no other to come,
    or to find that nothing is left: `work` must hold what they look at. If it is interrupted, others may still be at
    work.
    """
    wanted = [work]
    try:
        if count > 1:
            _helpers.call(wanted, range(1, count))
        work(0)
    finally:
        wanted.clear()  # who has not come holds nothing any more


def wake(work: Callable[[int], None], count: int) -> None:
    """Wake n other threads, numbered from 0, for some work; the caller does not wait for them."""
    _helpers.call([work], range(count))


def wakes_pending() -> int:
    """Return how many threads were woken and have not begun yet."""
    return _helpers.waiting


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Keep BLAS and LAPACK to one thread meanwhile.

    The factorisations here are small. A second thread makes them at best twice as fast on an idle machine, and
    much slower where another process needs a core, since BLAS threads spin while they wait for each other.

    Most BLAS has one number of threads for the whole process: it is 1 from the first thread of Python that comes in
    until the last one is out, and others that call BLAS meanwhile have one thread, too.

    A fork waits until all other threads are out, 1 s at most: SciPy's transforms and BLAS take locks, and in a process
    that is forked while another thread holds one it is never free.
    """
    me = get_ident()
    if me in _inside:
        yield
        return
    limits = ExitStack()
    try:
        with _entry, no_fork:  # threadpoolctl takes a lock itself, on the way in and out
            _come_in(me)
            limits.enter_context(_own().limit(limits=1, user_api="blas"))
        yield
    finally:
        with no_fork:
            limits.close()
            _go_out(me)


_entry = Lock()  # held by a fork that waits for those inside, so that no other thread comes in
_inside: set[int] = set()  # the threads of Python that want one BLAS thread
_before: list[tuple[Any, int]] = []  # the libraries that were limited for them, and the threads that each had


def _come_in(thread: int) -> None:
    with no_fork:
        _inside.add(thread)
        if len(_inside) == 1:
            _before[:] = [(library, n) for library in _shared() if (n := library.num_threads) > 1]
            for library, _ in _before:
                _set(library, 1)


def _go_out(thread: int) -> None:
    with no_fork:
        _inside.discard(thread)
        while not _inside and _before:
            library, count = _before.pop()
            if library.num_threads == 1:  # otherwise another number was set meanwhile, which stays
                _set(library, count)


def _set(library: Any, count: int) -> None:
    # Newer versions let one thread set the number and ignore all others, as long as that lives or until it is cleared.
    clear = getattr(library, "clear_controlling_thread", lambda force: None)
    clear(force=True)
    library.set_num_threads(count)
    clear(force=True)


@cache
def _own() -> ThreadpoolController:
    """Return the BLAS for which each thread of Python sets a number of threads."""
    return _controller().select(threading_layer="openmp", internal_api="mkl")


@cache
def _shared() -> tuple[Any, ...]:
    """Return the other BLAS."""
    own = _own().lib_controllers
    return tuple(library for library in _controller().lib_controllers if library not in own)


@once
def _controller() -> ThreadpoolController:
    return controller().select(user_api="blas")


def controller() -> ThreadpoolController:
    """Return what controls the threads of the libraries that are loaded now.

    Older threadpoolctl looks for them in a function that C calls, from which no exception comes back: Ctrl-C would be
    lost there. To other threads than the first it does not come.
    """
    from threadpoolctl import ThreadpoolController

    with no_fork, suppress(RuntimeError), ThreadPoolExecutor(1) as other:  # there may be no more threads
        return other.submit(ThreadpoolController).result()
    return ThreadpoolController()


@cache
def _available() -> int:
    return max(1, min(limits().values()))


def limits() -> dict[str, int]:
    """Return what bounds the number of threads of this process, in words, each with its number."""
    there = os.cpu_count() or 1
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else there
    stated, beside = _stated("OMP_NUM_THREADS"), max(1, *map(_stated, BESIDE))
    chosen = {"OMP_NUM_THREADS": stated} if stated else {"its share of the cores by MPI": there // beside}
    return {"the cores that it may use": cores, **chosen, "the most that help": MOST}


def _stated(variable: str) -> int:
    """Return the number in a variable of the environment; 0 without one."""
    text = os.environ.get(variable, "")
    return int(text) if text.isdecimal() else 0


class _HelperThreads:
    """Threads that wait for calls, whose outcome is not asked for.

    A pool, which would return the outcome, takes longer to call one.
    """

    def __init__(self) -> None:
        self._calls: SimpleQueue[tuple[list[Callable[[int], None]], int]] = SimpleQueue()
        self._size = 0
        self._lock = Lock()

    @property
    def waiting(self) -> int:
        """Calls that no thread has taken yet."""
        return self._calls.qsize()

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
                with suppress(BaseException):  # the caller could do all by itself
                    work(k)
                del work  # what it holds is not held while waiting
            del wanted


_helpers = _HelperThreads()


def _before_fork() -> None:
    """Wait until no other thread is at what a forked process must not find half done, and let none begin."""
    _entry.acquire()
    latest, me = monotonic() + LONGEST, get_ident()
    try:
        while _inside - {me} and monotonic() < latest:
            sleep(1e-4)
    finally:  # also after Ctrl-C
        no_fork.acquire()


def _after_fork() -> None:
    no_fork.release()
    _entry.release()


def _in_child() -> None:
    """Go on in a forked process, which has one thread: the one that forked."""
    global _helpers
    _helpers = _HelperThreads()
    for thread in _inside - {get_ident()}:
        _go_out(thread)
    _after_fork()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(before=_before_fork, after_in_parent=_after_fork, after_in_child=_in_child)
