from unittest.mock import ANY

import pytest
import xarray

from roughcontact.progress import listening
from roughcontact.study.executors.serial import Serial
from roughcontact.study.run import run
from roughcontact.study.run_task import run_task
from roughcontact.study.store import Store
from roughcontact.study.study import Study
from roughcontact.study.task import Summary
from study import trial
from study.trial import NAME


class Counting:
    """Serial, which remembers what it was given, and that it was closed."""

    workers = 1

    def __init__(self):
        self.given = []
        self.closed = False

    def results(self, run_task, tasks):
        try:
            for task in tasks:
                self.given.append(task.key)
                yield run_task(task)
        finally:
            self.closed = True


def study(samples=2, **more):
    return Study(
        **{"name": "a", "case": NAME, "samples": samples, "table": {"hurst": [0.1, 0.2, 0.3]}} | more
    )


def test_every_case_is_computed_and_kept(tmp_path):
    summary = run(study(), tmp_path / "new" / "folder")
    assert (summary.done, summary.failed, summary.left, summary.total) == (6, 0, 0, 6)
    assert summary.seconds > 0
    with Store.open(tmp_path / "new" / "folder") as store:
        for task, row in zip(study().tasks(), store.rows(), strict=True):
            assert (row.key, row.sample, row.status, row.message) == (task.key, task.sample, "done", "")
            assert row.parameters == task.parameters.model_dump()
            xarray.testing.assert_identical(row.record, run_task(task).record)
            assert row.residual == row.record["residual"].max()


def test_what_is_there_is_not_computed_again(tmp_path):
    run(study(), tmp_path)
    nothing = Counting()
    assert run(study(), tmp_path, nothing).done == 6
    assert nothing.given == []
    new = Counting()
    more = study(samples=3, table={"hurst": [0.1, 0.2, 0.3, 0.4]})
    assert run(more, tmp_path, new).done == 12
    assert len(new.given) == 6
    assert new.closed
    with Store.open(tmp_path) as store:
        assert [row.key for row in store.rows()] == [task.key for task in more.tasks()]


def test_failures_are_kept_and_stop_nothing(tmp_path):
    table = {"hurst": [0.1], "end": ["well", "error", "exit", "dictionary", "object"]}
    summary = run(study(table=table), tmp_path)
    assert (summary.done, summary.failed, summary.left) == (2, 8, 0)
    with Store.open(tmp_path) as store:
        failed = store.failed()
        assert [row.parameters["end"] for row in failed] == ["error", "exit", "dictionary", "object"] * 2
        assert failed[0].message.startswith("ArithmeticError: no contact")
        assert failed[0].record is None
        assert failed[0].residual is None


def test_failures_are_tried_again_when_asked(tmp_path, monkeypatch):
    given = study(table={"hurst": [0.1], "end": ["well", "error"]})
    run(given, tmp_path)
    assert run(given, tmp_path, counting := Counting()).failed == 2
    assert counting.given == []
    assert run(given, tmp_path, counting := Counting(), retry=True).failed == 2
    assert len(counting.given) == 2
    monkeypatch.setattr(trial, "fail", lambda parameters: None)
    assert run(given, tmp_path, retry=True) == Summary(4, 0, 0, ANY)
    with Store.open(tmp_path) as store:
        assert {row.status for row in store.rows()} == {"done"}
        assert store.failed() == ()


def test_a_retry_that_is_cut_off_loses_no_failure(tmp_path):
    given = study(table={"hurst": [0.1], "end": ["error"]})
    run(given, tmp_path)

    class Off(Counting):
        def results(self, run_task, tasks):
            raise KeyboardInterrupt
            yield

    with pytest.raises(KeyboardInterrupt):
        run(given, tmp_path, Off(), retry=True)
    with Store.open(tmp_path) as store:
        assert store.summary() == Summary(0, 2, 0)


def test_those_who_ask_hear_of_every_result_after_it_was_stored(tmp_path):
    results, told = [], []

    def on_result(result):
        results.append(result.key)
        with Store.open(tmp_path) as store:
            assert result.key in store.done_keys() | store.failed_keys()

    def heard(**given):
        told.clear()
        with listening(told.append):
            run(given_study, tmp_path, **given)
        return [
            (event.done, event.note) for event in told if event.unit == "cases" and event.state != "finished"
        ]

    given_study = study(table={"hurst": [0.1], "end": ["well", "error"]})
    assert heard(on_result=on_result) == [(0, ""), (1, ""), (2, "1 failed"), (3, "1 failed"), (4, "2 failed")]
    assert results == [task.key for task in given_study.tasks()]
    assert heard() == [(4, "")]
    assert heard(retry=True) == [(2, ""), (3, "1 failed"), (4, "2 failed")]


def test_an_interrupt_stops_the_workers_and_leaves_what_was_done(tmp_path):
    engine = Counting()

    def on_result(result):
        if len(engine.given) == 4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(study(), tmp_path, engine, on_result=on_result)
    assert engine.closed
    with Store.open(tmp_path) as store:
        assert store.summary() == Summary(4, 0, 2)
    assert run(study(), tmp_path).done == 6


def test_an_interrupt_within_a_case_is_one(tmp_path, monkeypatch):
    def interrupted(parameters):
        raise KeyboardInterrupt

    monkeypatch.setattr(trial, "fail", interrupted)
    with pytest.raises(KeyboardInterrupt):
        run(study(table={"hurst": [0.1], "end": ["well", "error"]}), tmp_path)
    with Store.open(tmp_path) as store:
        assert store.summary() == Summary(1, 0, 3)


def test_serial_computes_one_after_the_other_when_asked():
    assert Serial().workers == 1
    tasks = list(study().tasks())
    begun = []
    results = Serial().results(lambda task: begun.append(task) or task.key, tasks)
    assert begun == []
    assert next(results) == tasks[0].key
    assert begun == tasks[:1]
    results.close()
