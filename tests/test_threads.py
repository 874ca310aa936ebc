"""How many threads there are, and that answers do not hang on them."""

import ctypes
import gc
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
import weakref
from contextlib import contextmanager, suppress

import numpy as np
import pytest

import roughcontact as rc
from roughcontact import threads as threads_module, transforms
from roughcontact.contact.problem import ContactProblem
from roughcontact.contact.solution import Solution
from roughcontact.solver.control import Force, Status
from roughcontact.threads import controller, join_in, limit_threads, once, one_blas_thread, spread, threads

PATIENCE = 120  # [s], of a busy machine
forks = pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")


def test_within_a_limit():
    outside = threads()
    with limit_threads(3):
        assert threads() == 3
        with limit_threads(1):
            assert threads() == 1
        assert threads() == 3
    assert threads() == outside


@pytest.mark.parametrize(
    ("asked", "given"), [("1", 1), ("0", None), ("many", None), ("1000", None), ("", None), ("²", None)]
)
def test_the_environment_may_ask_for_fewer(asked, given):
    code = "from roughcontact.threads import threads; print(threads())"
    environment = os.environ | {"OMP_NUM_THREADS": asked}
    found = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    assert int(found.stdout) == (given or min(cores, 8))


def test_each_bound_of_the_threads_has_its_words(monkeypatch):
    monkeypatch.setattr(os, "cpu_count", lambda: 16)
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: range(12), raising=False)
    monkeypatch.setenv("MPI_LOCALNRANKS", "4")
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    words = ["the cores that it may use", "OMP_NUM_THREADS", "the most that help"]
    assert threads_module.limits() == dict(zip(words, (12, 3, 8), strict=True))
    monkeypatch.delenv("OMP_NUM_THREADS")
    assert threads_module.limits()["its share of the cores by MPI"] == 4


@pytest.mark.parametrize("launcher", ["MPI_LOCALNRANKS", "OMPI_COMM_WORLD_LOCAL_SIZE"])
def test_processes_on_one_machine_share_its_cores(launcher, monkeypatch):
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    monkeypatch.setattr(os, "cpu_count", lambda: 16)
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: range(16), raising=False)
    found, available = [], threads_module._available.__wrapped__
    for beside in ("", "1", "4", "64"):
        monkeypatch.setenv(launcher, beside)
        found.append(available())
    assert found == [8, 8, 4, 1]
    monkeypatch.setenv("OMP_NUM_THREADS", "2")
    assert available() == 2
    monkeypatch.delenv("OMP_NUM_THREADS")
    monkeypatch.setenv(launcher, "4")
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: range(3), raising=False)  # bound to these
    assert available() == 3


@pytest.mark.parametrize("count", [1, 2, 5])
def test_all_is_done_once(count):
    done = []
    with limit_threads(count):
        spread(done.append, range(17))
    assert sorted(done) == list(range(17))


@pytest.mark.parametrize("items", [0, 1, 5])
def test_few_items_wake_nobody(items):
    done = []
    with limit_threads(3):
        spread(lambda item: done.append((item, threading.current_thread())), range(items), 6)
    assert done == [(item, threading.current_thread()) for item in range(items)]


def test_so_many_items_are_shared():
    """Each waits for one that another has taken."""
    there = threading.Barrier(3, timeout=60)
    with limit_threads(3):
        spread(lambda item: there.wait(), range(6), 6)


def test_who_comes_late_is_not_waited_for(monkeypatch):
    """It finds nothing left, and does nothing."""
    done, late = [], []
    monkeypatch.setattr(threads_module._helpers, "call", lambda wanted, numbers: late.extend(wanted))
    with limit_threads(3):
        spread(done.append, range(6))
    for work in late:
        work(1)
    assert done == list(range(6))


def test_where_nobody_can_come_all_is_done_and_nothing_is_held(monkeypatch):
    """What nobody has begun is forgotten as soon as the first has done all."""

    class Refused(threading.Thread):
        def start(self):
            raise RuntimeError("can't start new thread")

    monkeypatch.setattr(threads_module, "Thread", Refused)
    helpers = threads_module._HelperThreads()
    monkeypatch.setattr(threads_module, "_helpers", helpers)
    field = np.zeros(3)
    held = weakref.ref(field)

    def work(k, given=field):
        given[:] = k + 1

    join_in(work, 4)
    np.testing.assert_array_equal(field, 1)
    del work, field
    assert held() is None


@pytest.mark.parametrize("count", [1, 4])
def test_what_fails_is_told(count):
    def work(item):
        if item == 7:
            raise ArithmeticError("seven")

    with limit_threads(count), pytest.raises(ArithmeticError, match="seven"):
        spread(work, range(9))


def test_an_interrupt_comes_before_what_another_thread_fails_by():
    both = threading.Barrier(2, timeout=60)

    def work(item):
        both.wait()
        first = threading.current_thread() is threading.main_thread()
        raise KeyboardInterrupt if first else ArithmeticError

    for _ in range(20):
        with limit_threads(2), pytest.raises(KeyboardInterrupt):
            spread(work, range(2))


def test_after_an_error_nothing_is_held():
    class Held:
        pass

    def fail():
        held = Held()
        kept.append(weakref.ref(held))

        def work(item, held=held):
            raise ArithmeticError

        with limit_threads(2), suppress(ArithmeticError):
            spread(work, range(4))

    kept = []
    gc.disable()
    try:
        fail()
        assert kept[0]() is None
    finally:
        gc.enable()


@pytest.mark.parametrize("count", [1, 2, 5])
def test_who_joins_in_is_not_waited_for(count):
    """The first takes all that is left; one that came before it finished may still be at it when it returns."""
    left, done, gone = list(range(40)), [], threading.Event()

    def work(k):
        if k:
            gone.wait(10)  # as late as can be
        while left:
            done.append((k, left.pop()))

    join_in(work, count)
    assert {k for k, _ in done} == {0}
    assert sorted(item for _, item in done) == list(range(40))
    gone.set()


def test_who_joins_in_may_fail_or_interrupt():
    def work(k):
        raise KeyboardInterrupt if k == 0 else ArithmeticError

    for _ in range(5):
        with pytest.raises(KeyboardInterrupt):
            join_in(work, 3)
    assert spread(list, [()]) is None  # the pool works on


@pytest.mark.parametrize("periodic", [False, True])
def test_answers_do_not_hang_on_their_number(monkeypatch, periodic):
    monkeypatch.setattr(transforms, "LARGE", 1)
    grid = rc.Grid((140, 260), 1e-3, periodic)
    rough = rc.self_affine(grid, 0.8, 1e-4, np.random.default_rng(0))
    answers = []
    for count in (1, 3):
        with limit_threads(count):
            answers.append(rc.press(rough, 1e9, force=2e3, solver=rc.ActiveSet(dense_limit=0)))
    np.testing.assert_array_equal(answers[0].pressure, answers[1].pressure)
    assert answers[0].depth == answers[1].depth


class Library:
    """A BLAS with one number of threads for the whole process."""

    def __init__(self, count):
        self.num_threads = count

    def set_num_threads(self, count):
        self.num_threads = count


@pytest.fixture
def library(monkeypatch):
    library = Library(4)
    monkeypatch.setattr(threads_module, "_shared", lambda: (library,))
    return library


def within(ready, go_on):
    """Come in, say so, and go out when told to."""
    with one_blas_thread():
        ready.set()
        assert go_on.wait(60)


def started(*arguments):
    thread = threading.Thread(target=within, args=arguments)
    thread.start()
    return thread


def test_blas_has_one_thread_until_the_last_is_out(library):
    events = [(threading.Event(), threading.Event()) for _ in range(2)]
    both = [started(*pair) for pair in events]
    for thread, (ready, go_on) in zip(both, events, strict=True):
        assert ready.wait(60)
        assert library.num_threads == 1
        go_on.set()
        thread.join(60)
    assert library.num_threads == 4


def test_blas_has_its_threads_again_after_a_failure(library):
    with pytest.raises(ArithmeticError), one_blas_thread(), one_blas_thread():
        raise ArithmeticError
    assert library.num_threads == 4


def test_what_somebody_else_sets_meanwhile_stays(library):
    with one_blas_thread():
        library.set_num_threads(3)
    assert library.num_threads == 3


def test_blas_that_counts_for_each_thread_is_limited_in_each(monkeypatch):
    """Each thread sets its own number, and sets it back itself: no other could."""

    class Counts(threading.local):
        num_threads = 4

        @contextmanager
        def limit(self, limits, user_api):
            before, self.num_threads = self.num_threads, limits
            yield
            self.num_threads = before

    counts, seen = Counts(), []
    monkeypatch.setattr(threads_module, "_own", lambda: counts)
    monkeypatch.setattr(
        threads_module, "_shared", lambda: ()
    )  # of BLAS that counts for the process there is none

    def work():
        with one_blas_thread():
            seen.append(counts.num_threads)
        seen.append(counts.num_threads)

    with one_blas_thread():
        other = threading.Thread(target=work)
        other.start()
        other.join(60)
        work()
        assert counts.num_threads == 1
    assert seen == [1, 4, 1, 1]
    assert counts.num_threads == 4


@pytest.fixture
def two_blas_threads():
    """Give BLAS two threads, and return a function that tells how many it has."""
    libraries = threads_module._shared()
    before = [library.num_threads for library in libraries]
    for library in libraries:
        threads_module._set(library, 2)
    yield lambda: [library.num_threads for library in libraries]
    for library, count in zip(libraries, before, strict=True):
        threads_module._set(library, count)


def surfaces(shape):
    """Return eight rough surfaces, on which two BLAS threads would change the last bits."""
    samples = ((rc.Grid(shape, 1 / 12, k % 2 == 1), np.random.default_rng(k)) for k in range(8))
    return [rc.self_affine(grid, 0.8, 0.01, rng) for grid, rng in samples]


def answers(rough):
    solution = rc.press(rough, 1.0, force=0.08)
    return solution.pressure.tobytes(), solution.depth


@pytest.mark.slow
def test_eight_threads_press_as_one_does(two_blas_threads):
    """Each presses 100 times: all bits are equal, and BLAS has its threads afterwards."""
    before, samples = two_blas_threads(), surfaces((10, 16))
    expected, wrong = [answers(rough) for rough in samples], []

    def work(first):
        pressed = (k % 8 for k in range(first, first + 100))
        wrong.extend(k for k in pressed if answers(samples[k]) != expected[k])

    together = [threading.Thread(target=work, args=(k,)) for k in range(8)]
    for thread in together:
        thread.start()
    for thread in together:
        thread.join()
    assert wrong == []
    assert two_blas_threads() == before


@pytest.mark.parametrize("shape", [(128, 160), (20, 20)])
def test_what_a_solution_tells_does_not_hang_on_the_threads_of_blas(two_blas_threads, shape):
    """Another thread that presses would change them: sums of more than 10 000 products are divided among them."""
    rng, grid = np.random.default_rng(0), rc.Grid(shape, 1.0)
    separation, pressure = rng.permutation(grid.size).reshape(shape) / grid.size, rng.random(shape)
    operator = rc.half_space(grid, 1.0, method="fft" if grid.size > 400 else "dense")
    told = []
    for _ in range(2):
        problem = ContactProblem(separation, operator, Force(1.0))
        solution = Solution(problem, pressure, 10.0, Status.CONVERGED, 0.0, 1)
        field = solution.displacement.tobytes()
        told.append((solution.force, solution.elastic_energy, solution.mean_gap, field))
        for library in threads_module._shared():
            threads_module._set(library, 1)
    assert told[0] == told[1]


@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
def test_ctrl_c_is_not_lost_where_libraries_are_sought(monkeypatch):
    """As older threadpoolctl does, in a function that C calls."""

    def interrupted():
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(0.2)

    def seek():
        ctypes.CFUNCTYPE(None)(interrupted)()

    # A shell that starts a job in the background makes it deaf to Ctrl-C; a person's does not.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    monkeypatch.setattr("threadpoolctl.ThreadpoolController", seek)
    try:
        with pytest.raises(KeyboardInterrupt):
            controller()
    finally:
        signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("fails", [False, True])
def test_once_is_once_for_all_threads(fails):
    calls, gate = [], threading.Barrier(4)

    @once
    def slow(number):
        calls.append(number)
        if fails and len(calls) == 1:
            raise ArithmeticError
        time.sleep(0.05)
        return [number]

    found = []

    def ask():
        gate.wait(60)
        with suppress(ArithmeticError):
            found.append(slow(3))

    asking = [threading.Thread(target=ask) for _ in range(4)]
    for thread in asking:
        thread.start()
    for thread in asking:
        thread.join(60)
    assert calls == [3] * (1 + fails)
    assert len(found) == 4 - fails
    assert all(one is slow(3) for one in found)
    slow.cache_clear()
    assert slow(3) is not found[0]


FORKED = """
import os, signal, sys, threading, time, warnings
# Python 3.12 warns of all forks beside threads: that these go well is what is shown here.
warnings.filterwarnings("ignore", "This process .* is multi-threaded", DeprecationWarning)

def fork(work):
    child = os.fork()
    if not child:
        signal.alarm({patience})  # who hangs is killed
        os._exit(0 if work() else 1)
    return child

def ended(child):
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
"""


def run_forking(script):
    script = FORKED.format(patience=PATIENCE) + textwrap.dedent(script)
    command = [sys.executable, "-W", "error", "-c", script]
    done = subprocess.run(command, capture_output=True, text=True, timeout=2 * PATIENCE, check=False)
    assert (done.returncode, done.stderr) == (0, "")


@forks
def test_a_forked_process_has_threads_of_its_own():
    run_forking(
        """
        from roughcontact.threads import controller, join_in, limit_threads, spread
        def work():
            done, joined = [], []
            spread(done.append, range(4))
            join_in(joined.append, 2)
            return len(done) == 4 and 0 in joined
        with limit_threads(2):
            assert work()
            sys.exit(ended(fork(work)))
        """
    )


@forks
def test_a_forked_process_has_the_blas_threads_of_whoever_forked():
    """Where another thread was inside it has all of them, for that thread is not there to set them back."""
    run_forking(
        """
        from types import SimpleNamespace
        from roughcontact import threads
        library = SimpleNamespace(num_threads=4)
        library.set_num_threads = lambda count: setattr(library, "num_threads", count)
        threads._shared = lambda: (library,)
        ready, go_on = threading.Event(), threading.Event()
        def inside():
            with threads.one_blas_thread():
                ready.set()
                go_on.wait()
        thread = threading.Thread(target=inside)
        thread.start()
        ready.wait()
        counts = [ended(fork(lambda: library.num_threads == 4)), library.num_threads]
        with threads.one_blas_thread():
            counts.append(ended(fork(lambda: library.num_threads == 1)))
        go_on.set()
        thread.join()
        sys.exit((*counts, library.num_threads) != (0, 1, 0, 4))
        """
    )


@forks
def test_a_fork_waits_for_what_is_computed_once():
    run_forking(
        """
        from roughcontact.threads import once
        begun, calls = threading.Event(), []
        @once
        def slow():
            calls.append(0)
            begun.set()
            time.sleep(0.2)
            return 7
        thread = threading.Thread(target=slow)
        thread.start()
        begun.wait()
        sys.exit(ended(fork(lambda: slow() == 7 and len(calls) == 1)))
        """
    )


@forks
def test_a_fork_waits_for_another_thread_that_computes_but_not_for_ever():
    """SciPy's transforms and BLAS take locks, which are never free in a process that is forked meanwhile."""
    run_forking(
        """
        from roughcontact import threads
        lock, begun, go_on, found = threading.Lock(), threading.Event(), threading.Event(), []
        def compute(wait):
            with threads.one_blas_thread(), lock:
                begun.set()
                wait(0.2)
        threads.LONGEST = {patience}
        thread = threading.Thread(target=compute, args=(time.sleep,))
        thread.start()
        begun.wait()
        codes = [ended(fork(lambda: lock.acquire(timeout=1)))]
        thread.join()
        threads.LONGEST = 0.05
        with threads.one_blas_thread():  # the thread that forks is inside itself
            codes.append(ended(fork(lambda: lock.acquire(timeout=1))))
        begun.clear()
        thread = threading.Thread(target=compute, args=(lambda _: go_on.wait(),))
        thread.start()
        begun.wait()
        codes.append(ended(fork(lambda: not lock.acquire(timeout=0.1))))
        go_on.set()
        thread.join()
        with threads.one_blas_thread():
            sys.exit(codes != [0, 0, 0])
        """.replace("{patience}", str(PATIENCE))
    )


@forks
def test_processes_forked_while_others_press_all_finish():
    """Fifty of fifty, the first while machine code is being loaded; the bits are those of the parent."""
    run_forking(
        """
        import numpy as np
        import roughcontact as rc
        def press():
            found = rc.press(rough, 1.0, force=0.08)
            return found.pressure.tobytes(), found.stiffness, found.mean_gap
        def go_on():
            while not done:
                press()
        rough = rc.self_affine(rc.Grid((12, 14), 1 / 12), 0.8, 0.01, np.random.default_rng(0))
        done, children, codes, known = [], [], [], None
        beside = [threading.Thread(target=go_on, daemon=True) for _ in range(2)]
        for thread in beside:
            thread.start()
        for k in range(50):
            time.sleep(0.002 * (k % 5))
            children.append(fork(lambda: press() == known if known else bool(press())))
            if len(children) == 5:
                codes += map(ended, children)
                children, known = [], press()
        done.append(True)
        for thread in beside:
            thread.join()
        assert codes == [0] * 50, codes
        """
    )


@pytest.mark.slow
@forks
def test_a_forked_process_shares_kernels_with_threads_of_its_own():
    """Whoever forks while another leads: nobody is there to be waited for, and the bits are those of the parent."""
    run_forking(
        """
        import numpy as np
        import roughcontact as rc
        from roughcontact.threads import limit_threads
        def press():
            with limit_threads(3):
                return rc.press(rough, 1.0, force=0.05).pressure.tobytes()
        def go_on():
            while not done:
                press()
        rough = rc.self_affine(rc.Grid((192, 192), 1 / 192, True), 0.8, 0.01, np.random.default_rng(0))
        done, known = [], press()
        beside = threading.Thread(target=go_on, daemon=True)
        beside.start()
        codes = [ended(fork(lambda: press() == known)) for _ in range(10)]
        done.append(True)
        beside.join()
        assert codes == [0] * 10, codes
        """
    )
