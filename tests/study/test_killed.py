"""kill -9 of the coordinator at any moment: after resuming every case is there once, and the same to the last bit."""

import multiprocessing
import sqlite3
import time
from contextlib import closing
from pathlib import Path

import pytest

from roughcontact.study.run import run
from roughcontact.study.store import Store
from roughcontact.study.study import Study
from study.coordinator import run_until

PLAIN = {
    "name": "killed",
    "case": "study.trial:CASE",
    "samples": 20,
    "parameters": {"points": 600},  # a row of several pages, so that a commit is more than one write
    "table": {"hurst": {"start": 0.1, "stop": 1.1, "count": 11}},
}
WITH_FIELDS = PLAIN | {"case": "study.trial:WITH_FIELDS", "samples": 1}
PATIENCE = 240  # [s], of a busy machine


@pytest.fixture(scope="module")
def processes():
    """Return a maker of processes that start within milliseconds, and share nothing with this one."""
    context = multiprocessing.get_context("forkserver")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(
            "PYTHONPATH", str(Path(__file__).parents[1])
        )  # Python 3.11 and 3.12 need it to find what follows
        context.set_forkserver_preload(["study.coordinator", "study.trial"])
        process = context.Process(target=time.sleep, args=(0,))
        process.start()
        process.join()
    return context


def content(folder):
    """Return all that is stored, but for what differs from one run to the next: times."""
    with Store.open(folder) as store:
        rows = [
            (row.key, row.sample, row.parameters, row.status, row.message, row.residual, row.text)
            for row in store.rows()
        ]
        fields = [
            store.fields(task.key)["pressure"].values.tobytes()
            for task in store.study.tasks()
            if task.case.fields
        ]
    with closing(sqlite3.connect(folder / "cases.sqlite")) as database:
        (count,) = database.execute("SELECT count(*) FROM cases").fetchone()
    assert count == len(rows)
    return rows, fields


def killed(processes, folder, given, place, number):
    """Kill a run at a place, and return the names in its folder and the size of its database then."""
    here = folder.parent / "here"
    here.unlink(missing_ok=True)
    process = processes.Process(target=run_until, args=(folder, given, place, number))
    process.start()
    try:
        end = time.monotonic() + PATIENCE
        while not here.exists():
            assert process.is_alive()
            assert time.monotonic() < end
            time.sleep(0.01)
    finally:
        process.kill()
        process.join()
    assert process.exitcode == -9
    return {path.name for path in folder.iterdir()}, (folder / "cases.sqlite").stat().st_size


def test_killed_at_twenty_moments_nothing_is_lost_and_nothing_twice(tmp_path, processes):
    study = Study(**PLAIN)
    run(study, tmp_path / "undisturbed")
    folder = tmp_path / "killed"
    done = 0
    for moment in range(20):
        place = ("before", "inserted", "spilled", "after")[moment % 4]
        names, size = killed(processes, folder, PLAIN, place, 11)
        # A journal tells that a transaction was under way; where a part of it was written already, the file is longer.
        assert ("cases.sqlite-journal" in names) == (place in ("inserted", "spilled"))
        done += 11 if place == "after" else 10
        with Store.open(folder) as store:  # which undoes what was half done
            assert store.summary().done == done
        assert ((folder / "cases.sqlite").stat().st_size < size) == (place == "spilled")
    assert run(study, folder).done == 220
    assert content(folder) == content(tmp_path / "undisturbed")


def test_killed_between_its_field_and_its_row_a_case_is_computed_again(tmp_path, processes):
    study = Study(**WITH_FIELDS)
    run(study, tmp_path / "undisturbed")
    folder = tmp_path / "killed"
    for moment in range(2):
        names, _ = killed(processes, folder, WITH_FIELDS, "field", 4)
        assert "fields" in names
        with Store.open(folder) as store:
            assert store.summary().done == 3 * (moment + 1)
            assert len(list((folder / "fields").iterdir())) == 3 * (moment + 1) + 1
    assert run(study, folder).done == 11
    assert content(folder) == content(tmp_path / "undisturbed")


def test_killed_while_it_makes_the_database_a_run_begins_again(tmp_path):
    study = Study(**PLAIN).with_samples(1)
    folder = tmp_path / "killed"
    folder.mkdir()
    # What a process leaves that is killed before the database or before the study file is in its place.
    (folder / "lock").touch()
    (folder / ".0123.part").write_bytes(b"SQLite format 3\0")
    run(study, folder)
    (folder / "study.toml").unlink()
    assert run(study, folder).done == 11
