import os
import sqlite3
from unittest.mock import ANY

import numpy as np
import pytest
import xarray

from roughcontact import __version__
from roughcontact.study.run import run
from roughcontact.study.run_task import run_task
from roughcontact.study.store import Store
from roughcontact.study.study import Study
from roughcontact.study.study_errors import StoreError
from roughcontact.study.task import Result, Summary
from study.trial import NAME


def study(**more):
    return Study(**{"name": "a", "case": NAME, "samples": 2, "table": {"hurst": [0.1, 0.2]}} | more)


@pytest.fixture
def filled(tmp_path):
    """Return a folder with all cases of the study."""
    run(study(), tmp_path / "filled")
    return tmp_path / "filled"


def test_a_folder_holds_the_study_and_one_database(filled):
    assert sorted(os.listdir(filled)) == ["cases.sqlite", "lock", "study.toml"]
    assert Study.read(filled / "study.toml") == study()


def test_the_database_can_be_read_by_anyone(filled):
    with sqlite3.connect(filled / "cases.sqlite") as database:
        (count,) = database.execute(
            "SELECT count(*) FROM cases WHERE status = 'done' AND residual < 1e-6"
        ).fetchone()
        versions = database.execute("SELECT DISTINCT version FROM cases").fetchall()
        hurst = database.execute("SELECT DISTINCT json_extract(parameters, '$.hurst') FROM cases").fetchall()
        force = database.execute(
            "SELECT json_extract(record, '$.data.force.values[0]') FROM cases"
        ).fetchall()
    database.close()
    assert count == 4
    assert versions == [(__version__,)]
    assert sorted(hurst) == [(0.1,), (0.2,)]
    with Store.open(filled) as store:
        assert sorted(force) == sorted((float(row.record["force"][0]),) for row in store.rows())


def test_readers_read_while_cases_are_added(tmp_path):
    tasks = list(study().tasks())
    with Store.open(tmp_path, study()) as writer:
        for number, task in enumerate(tasks, start=1):
            writer.add(task, run_task(task))
            with Store.open(tmp_path) as reader:
                assert reader.summary() == Summary(number, 0, 4 - number)
                rows = reader.rows()
                next(rows)  # and holds the rest
                if number < len(tasks):
                    writer.add(tasks[number], run_task(tasks[number]))
                    writer.add(tasks[number], run_task(tasks[number]))


def test_a_reader_changes_nothing(filled):
    (task, *_) = study().tasks()
    with Store.open(filled) as store, pytest.raises(StoreError, match="cannot be written"):
        store.add(task, run_task(task))


def test_what_is_done_stays_and_what_failed_is_replaced(tmp_path):
    (task, *_) = study().tasks()
    with Store.open(tmp_path, study()) as store:
        store.add(task, Result(task.key, None, "first", 1.0))
        store.add(task, Result(task.key, None, "second", 2.0))
        assert [row.message for row in store.rows()] == ["second"]
        store.add(task, run_task(task))
        store.add(task, Result(task.key, None, "third", 3.0))
        (row,) = store.rows()
        assert (row.status, row.message, store.failed()) == ("done", "", ())


def test_whatever_a_row_holds_comes_back(tmp_path):
    tasks = list(study().tasks())
    endless = xarray.Dataset({"residual": ("load", [np.nan, np.inf]), "word": "\0\n'\""})
    nothing = xarray.Dataset({"residual": ("load", [np.nan])})
    with Store.open(tmp_path, study()) as store:
        store.add(tasks[0], Result(tasks[0].key, endless, "", 1))
        store.add(tasks[1], Result(tasks[1].key, nothing, "", np.float64(0.1)))
        store.add(tasks[2], Result(tasks[2].key, None, "no file 'caf\udce9', \0 \U0001f980", 0))
        first, second, third = store.rows()
    assert (first.residual, second.residual) == (np.inf, None)
    assert (first.seconds, second.seconds, third.seconds) == (1.0, 0.1, 0.0)
    xarray.testing.assert_identical(first.record, endless)
    assert third.message == "no file 'caf?', \0 \U0001f980"


def test_any_name_of_a_folder_will_do(tmp_path):
    folder = tmp_path / "100% a?b #1 \u00e4"
    assert run(study(), folder).done == 4
    with Store.open(folder) as store:
        assert store.summary().done == 4


def test_rows_come_in_the_order_of_the_study(tmp_path, monkeypatch):
    monkeypatch.setattr("roughcontact.study.store._AT_ONCE", 3)
    given = study(samples=5)
    with Store.open(tmp_path, given) as store:
        for task in reversed(list(given.tasks())):
            store.add(task, Result(task.key, None, "", 0.0))
        assert [row.key for row in store.rows()] == [task.key for task in given.tasks()]


def test_fields_lie_beside_the_database(tmp_path):
    given = study(case="study.trial:WITH_FIELDS")
    run(given, tmp_path)
    with Store.open(tmp_path) as store:
        for task, row in zip(given.tasks(), store.rows(), strict=True):
            whole = run_task(task).record
            fields = store.fields(row.key)
            assert list(fields.data_vars) == ["pressure"]
            np.testing.assert_array_equal(fields["pressure"], whole["pressure"])
            np.testing.assert_array_equal(fields["x"], whole["x"])
            assert fields["pressure"].attrs == {"units": "Pa"}
            xarray.testing.assert_identical(row.record, whole.drop_vars(["pressure", "x"]))
    assert len(os.listdir(tmp_path / "fields")) == 4


def test_fields_that_are_not_there_are_said_to_be(filled):
    with (
        Store.open(filled) as store,
        pytest.raises(
            StoreError, match=r"no fields of the case 0123.*to compute it again, first run: sqlite3"
        ),
    ):
        store.fields("0123")


def test_what_a_killed_process_left_half_written_is_removed(tmp_path):
    (tmp_path / "fields").mkdir()
    (tmp_path / "fields" / ".0123.part").touch()
    (tmp_path / ".other.part").touch()  # perhaps that of an export under way
    run(study(case="study.trial:WITH_FIELDS"), tmp_path)
    assert not (tmp_path / "fields" / ".0123.part").exists()
    assert (tmp_path / ".other.part").exists()


def test_a_second_coordinator_is_refused(filled):
    with Store.open(filled, study()):
        with pytest.raises(
            StoreError, match="another process is running a study in this folder; wait until it ends"
        ):
            run(study(), filled)
        with Store.open(filled) as reader:
            assert reader.summary().done == 4
    run(study(), filled)


@pytest.mark.parametrize(
    "how", ["more samples", "more values", "a range", "rows", "moved", "the case by another way"]
)
def test_a_study_may_grow(filled, how):
    grown = {
        "more samples": study(samples=3),
        "more values": study(table={"hurst": [0.1, 0.2, 0.3]}),
        "a range": study(table={"hurst": {"start": 0.1, "stop": 0.3, "count": 3}}),
        "rows": study(table={}, rows=[{"hurst": 0.3}, {"hurst": 0.2}, {"hurst": 0.1}]),
        "moved": study(table={"hurst": [0.1, 0.2], "points": [4, 8]}),
        "the case by another way": study(case="study.trial:SAME"),
    }[how]
    assert run(grown, filled).done == len(list(grown.tasks()))
    with Store.open(filled) as store:
        assert store.study == grown
        assert store.outdated() == 0


@pytest.mark.parametrize(
    ("more", "complaint"),
    [
        ({"seed": 1}, "it holds results of a study with the seed 0, not 1; choose another folder"),
        ({"name": "b"}, "with the name 'a', not 'b'; choose another folder"),
        ({"case": "study.trial:WITH_FIELDS"}, "with the case 'trial', not 'trial with fields'"),
        ({"samples": 1}, "it holds 2 samples, but this study has 1; give 2 or more"),
        ({"table": {"hurst": [0.1]}}, "it holds cases that are not in this study"),
        ({"parameters": {"points": 5}}, '"points":4'),
    ],
)
def test_another_study_in_the_folder_is_refused(filled, more, complaint):
    before = (filled / "study.toml").read_text(), (filled / "cases.sqlite").read_bytes()
    with pytest.raises(StoreError) as caught:
        run(study(**more), filled)
    assert complaint in str(caught.value)
    assert ((filled / "study.toml").read_text(), (filled / "cases.sqlite").read_bytes()) == before
    run(study(), filled)


def test_a_new_version_of_a_case_is_computed_anew(filled, monkeypatch):
    from study import trial

    monkeypatch.setattr(trial, "CASE", trial.NEWER)
    with Store.open(filled) as store:
        assert store.summary() == Summary(0, 0, 4)
        assert store.outdated() == 4
    assert run(study(), filled) == Summary(4, 0, 0, ANY)


def test_a_study_file_that_is_lost_can_be_replaced(filled):
    (filled / "study.toml").unlink()
    with pytest.raises(StoreError, match=r"there is no study.toml in it; name the folder"):
        Store.open(filled)
    with Store.open(filled, study()) as store:
        assert store.summary().done == 4
    with Store.open(filled) as store:
        assert store.study == study()


def test_a_study_file_that_is_damaged_says_so(filled):
    (filled / "study.toml").write_text("name = ")
    for given in (None, study()):
        with pytest.raises(
            StoreError, match=r"its study.toml cannot be used .*not a valid TOML.*remove it and run"
        ):
            Store.open(filled, given)


def test_a_folder_without_results_says_so(tmp_path):
    study().write(tmp_path / "study.toml")
    with pytest.raises(StoreError, match=r"there is no cases.sqlite in it"):
        Store.open(tmp_path)
    with pytest.raises(StoreError, match=r"nowhere: there is no study.toml in it"):
        Store.open(tmp_path / "nowhere")
    assert not (tmp_path / "nowhere").exists()


def test_a_file_in_the_way_of_the_folder_says_so(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(StoreError, match="the folder does not exist and cannot be created: File exists"):
        Store.open(tmp_path / "file", study())
    with pytest.raises(StoreError, match="cannot be created: Not a directory"):
        Store.open(tmp_path / "file" / "in", study())
