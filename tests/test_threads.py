"""How many threads there are, and that answers do not hang on them."""

import os
import subprocess
import sys
import threading
import weakref

import numpy as np
import pytest

import roughcontact as rc
from roughcontact import arrays
from roughcontact import threads as threads_module
from roughcontact.threads import join_in, limit_threads, spread, threads


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


@pytest.mark.parametrize("count", [1, 2, 5])
def test_all_is_done_once(count):
    done = []
    with limit_threads(count):
        spread(done.append, range(17))
    assert sorted(done) == list(range(17))


@pytest.mark.parametrize("items", [0, 1, 5, 6])
def test_few_items_wake_nobody(items):
    done = []
    with limit_threads(3):
        spread(lambda item: done.append((item, threading.current_thread())), range(items), 6)
    assert sorted(item for item, _ in done) == list(range(items))
    assert (len({thread for _, thread in done}) > 1) == (items == 6)


def test_where_nobody_can_come_all_is_done_and_nothing_is_held(monkeypatch):
    """What nobody has begun is forgotten as soon as the first has done all."""

    class Refused(threading.Thread):
        def start(self):
            raise RuntimeError("can't start new thread")

    monkeypatch.setattr(threads_module, "Thread", Refused)
    crew = threads_module._Crew()
    monkeypatch.setattr(threads_module, "_crew", lambda: crew)
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
    monkeypatch.setattr(arrays, "LARGE", 1)
    grid = rc.Grid((140, 260), 1e-3, periodic)
    rough = rc.self_affine(grid, 0.8, 1e-4, np.random.default_rng(0))
    answers = []
    for count in (1, 3):
        with limit_threads(count):
            answers.append(rc.press(rough, 1e9, force=2e3, solver=rc.ActiveSet(dense_limit=0)))
    np.testing.assert_array_equal(answers[0].pressure, answers[1].pressure)
    assert answers[0].depth == answers[1].depth


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_a_forked_process_has_threads_of_its_own():
    code = (
        "import os, sys\n"
        "from roughcontact.threads import limit_threads, spread\n"
        "with limit_threads(2):\n"
        "    spread(lambda item: None, range(4))\n"
        "    child = os.fork()\n"
        "    if not child:\n"
        "        done = []\n"
        "        spread(done.append, range(4))\n"
        "        os._exit(len(done))\n"
        "    sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) != 4)\n"
    )
    subprocess.run([sys.executable, "-W", "ignore", "-c", code], check=True, timeout=60)
