"""Local processes: nothing is lost with a worker, and nothing is left behind."""

import itertools
import os
import random
import sys
import time

import pytest

from roughcontact.study.case import Case
from roughcontact.study.executors import process
from roughcontact.study.executors.processes import Processes, usable_cores
from roughcontact.study.executors.worker import WorkersError
from study.executors.workload import (
    FATE,
    NUMBERS,
    Numbers,
    bits,
    environment,
    run_task,
    tasks,
    truth,
    workers,
)


@pytest.fixture(autouse=True)
def nothing_is_left():
    assert workers() == []
    yield
    assert workers() == []


def test_results_are_those_of_serial_execution_though_workers_are_killed_at_random():
    rng = random.Random(1)
    given = tasks(NUMBERS, [{"value": i, "seconds": 0.002} for i in range(200)])
    kills, results = set(rng.sample(range(190), 5)), []
    for result in Processes(2).results(run_task, given):
        results.append(result)
        if len(results) in kills:
            time.sleep(rng.uniform(0, 0.004))
            rng.choice(workers()).kill()
    assert bits(results) == truth(given)


def test_a_case_that_takes_its_worker_down_fails_alone():
    ways = ["live", "kill", "live", "crash", "leave", "raise", "exit", "lock", *["live"] * 8]
    given = tasks(FATE, [{"value": i, "how": how} for i, how in enumerate(ways)])
    results = list(Processes(2).results(run_task, given))
    messages = {result.key: result.message for result in results}
    said = {how: messages[task.key] for task, how in zip(given, ways, strict=True)}
    assert "its worker died in each of 3 tries, the last of signal 9" in said["kill"]
    assert "signal 11" in said["crash"]
    assert "exit status 3" in said["leave"]
    assert "no such surface" in said["raise"]
    assert "exit with status 3" in said["exit"]
    assert "a lock is in here" in said["lock"]
    living = [task for task, how in zip(given, ways, strict=True) if how == "live"]
    failed = {task.key: None for task in given if task not in living}
    assert bits(results) == truth(living) | failed


def test_takes_no_more_tasks_than_it_can_compute_soon():
    taken = []

    def endless():
        for i in itertools.count():
            taken.append(i)
            yield from tasks(NUMBERS, [{"value": i}])

    results = Processes(2).results(run_task, endless())
    assert taken == []
    assert len(list(itertools.islice(results, 20))) == 20
    assert len(taken) <= 20 + 2 * 2
    results.close()


def test_closing_ends_a_worker_in_the_middle_of_a_task():
    given = tasks(NUMBERS, [{"seconds": 0}, {"seconds": 60}, {"seconds": 60}])
    results = Processes(2).results(run_task, given)
    next(results)
    start = time.monotonic()
    results.close()
    assert time.monotonic() - start < process.PATIENCE


def test_starts_no_worker_for_nothing(monkeypatch):
    monkeypatch.setattr(process, "BOOT", "{path}: no Python at all")
    assert list(Processes(2).results(run_task, [])) == []


def test_each_worker_computes_on_one_thread(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    (result,) = Processes(1).results(run_task, tasks(Case("seen", 1, Numbers, environment), [{}]))
    assert result.record["threads"] == "1"


def test_what_a_case_prints_or_reads_does_not_meet_the_messages(capfd):
    given = tasks(FATE, [{"how": "print"}, {}])
    assert bits(Processes(1).results(run_task, given)).keys() == {"key0", "key1"}
    seen = capfd.readouterr()
    assert seen.out == ""
    assert seen.err.split() == ["printed", "by", "a", "case", "''"]


def test_an_error_while_tasks_are_made_is_not_swallowed():
    def broken():
        yield from tasks(NUMBERS, [{}])
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        list(Processes(1).results(run_task, broken()))


def test_workers_that_do_not_start_are_given_up(monkeypatch):
    monkeypatch.setattr(process, "BOOT", "raise SystemExit(7)  # {path}")
    with pytest.raises(WorkersError, match="died one after the other as they started: exit status 7"):
        list(Processes(2).results(run_task, tasks(NUMBERS, [{}] * 5)))


def test_a_case_that_cannot_be_sent_is_refused():
    case = Case("local", 1, Numbers, lambda parameters, rng: None)
    with pytest.raises(WorkersError, match="'local' cannot be sent to another process"):
        list(Processes(1).results(run_task, tasks(case, [{}])))


def test_a_case_that_workers_cannot_import_is_refused(tmp_path, monkeypatch):
    (tmp_path / "fleeting.py").write_text("def run(parameters, rng): ...\n")
    with monkeypatch.context() as patch:
        patch.syspath_prepend(tmp_path)
        import fleeting
    with pytest.raises(WorkersError, match="No module named 'fleeting'"):
        list(Processes(1).results(run_task, tasks(Case("f", 1, Numbers, fleeting.run), [{}])))


def test_takes_the_cores_that_it_may_use():
    assert Processes(3).workers == 3
    assert Processes().workers == usable_cores() <= (os.cpu_count() or 1)
    with pytest.raises(ValueError, match="workers is 0"):
        Processes(0)


@pytest.mark.skipif(sys.platform != "linux", reason="affinity is known on Linux")
def test_cores_are_those_of_the_affinity():
    mine = os.sched_getaffinity(0)
    os.sched_setaffinity(0, [min(mine)])
    try:
        assert usable_cores() == 1
    finally:
        os.sched_setaffinity(0, mine)
