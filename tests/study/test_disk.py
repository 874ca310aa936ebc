"""A disk that takes no more: a clear error, and stored cases are safe."""

import errno
import json
import os
import shutil
import subprocess
import sys
from collections import deque
from itertools import starmap
from pathlib import Path

import pytest

from roughcontact.study import field_files as fields_module
from roughcontact.study.run import run
from roughcontact.study.run_task import run_task
from roughcontact.study.store import Store
from roughcontact.study.study import Study
from roughcontact.study.study_errors import StoreError
from roughcontact.study.task import Summary
from study.trial import NAME

FULL = "the disk is full; make room and run again; stored cases are safe"


def study(**more):
    return Study(
        **{"name": "a", "case": NAME, "samples": 40, "parameters": {"hurst": 0.5, "points": 99}} | more
    )


def namespace():
    """Return the command before another that may mount what only it sees, or None."""
    for options in (["--mount"], ["--map-root-user", "--mount"]):
        command = ["unshare", *options]
        trial = [*command, "sh", "-c", f"mount -t tmpfs none /mnt && '{sys.executable}' -c ''"]
        if (
            shutil.which("unshare")
            and subprocess.run(trial, capture_output=True, check=False).returncode == 0
        ):
            return command
    return None


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """Return what happened on a small disk."""
    before = namespace()
    if before is None:
        pytest.skip("no disk can be mounted here")
    disk, large = tmp_path_factory.mktemp("disk"), tmp_path_factory.mktemp("large")
    script = Path(__file__).with_name("small_disk.py")
    environment = os.environ | {"PYTHONPATH": str(script.parents[1])}
    answer = subprocess.run(
        [*before, sys.executable, script, disk, large],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert answer.returncode == 0, answer.stderr
    return json.loads(answer.stdout)


def test_a_full_disk_ends_a_run_and_loses_nothing(found):
    assert found["full"].endswith(FULL)
    assert found["full again"].endswith(FULL)
    assert 0 < found["kept"] < 20
    assert found["room"] == 20
    assert found["same"]


def test_a_disk_without_any_room_is_told(found):
    assert found["no room at all"].endswith(FULL)


def test_fields_that_find_no_room_end_a_run_and_lose_nothing(found):
    assert "fields cannot be written: the disk is full; make room" in found["fields"]
    assert all(found["fields kept"])
    assert 0 < len(found["fields kept"]) == found["files"]


def test_a_read_only_disk_can_be_read_and_is_said_to_be_one(found):
    assert found["readable"] == found["kept"]
    for told in (found["read-only"], found["nothing to write"]):
        assert "Read-only file system" in told
        assert "change its permissions, or copy it elsewhere and resume there; stored cases are safe" in told


@pytest.mark.skipif(
    getattr(os, "geteuid", lambda: 0)() == 0,
    reason="no permissions of POSIX here, or root, who writes where it likes",
)
def test_a_folder_without_permission_to_write_says_so(tmp_path):
    run(study(samples=2), tmp_path)
    tmp_path.chmod(0o500)
    try:
        with Store.open(tmp_path) as store:
            assert store.summary().done == 2
        with pytest.raises(StoreError, match="Permission denied; change its permissions"):
            run(study(), tmp_path)
    finally:
        tmp_path.chmod(0o700)


def test_a_database_that_finds_no_room_keeps_what_it_has(tmp_path):
    tasks = list(study().tasks())
    with Store.open(tmp_path, study()) as store:
        for task in tasks[:5]:
            store.add(task, run_task(task))
        (pages,) = store._connection.execute("PRAGMA page_count").fetchone()
        store._connection.execute(f"PRAGMA max_page_count = {pages}")
        results = [(task, run_task(task)) for task in tasks[5:]]
        with pytest.raises(StoreError) as caught:
            deque(starmap(store.add, results))
        assert str(caught.value) == f"{tmp_path}: {FULL}"
    with Store.open(tmp_path) as store:
        kept = store.summary().done
    assert 5 <= kept < 40
    assert run(study(), tmp_path).done == 40


@pytest.mark.parametrize(
    ("number", "told"),
    [
        (errno.ENOSPC, "fields cannot be written: the disk is full; make room"),
        (
            errno.EIO,
            "fields cannot be written: Input/output error; change its permissions, or copy it elsewhere",
        ),
    ],
)
def test_fields_that_cannot_be_written_leave_no_row(tmp_path, monkeypatch, number, told):
    def fails(descriptor):
        raise OSError(number, os.strerror(number))

    given = study(case="study.trial:WITH_FIELDS", samples=2)
    monkeypatch.setattr(fields_module.os, "fsync", fails)
    with pytest.raises(StoreError, match=told):
        run(given, tmp_path)
    monkeypatch.undo()
    with Store.open(tmp_path) as store:
        assert store.summary() == Summary(0, 0, 2)
    assert list((tmp_path / "fields").iterdir()) == []
    assert run(given, tmp_path).done == 2


def test_a_database_that_another_program_keeps_is_told(tmp_path, monkeypatch):
    monkeypatch.setattr("roughcontact.study.schema._PATIENCE", 0.3)
    monkeypatch.setattr("roughcontact.study.schema._BREATH", 0.1)
    (task, *_) = study().tasks()
    with Store.open(tmp_path, study()) as store, Store.open(tmp_path) as reader:
        reader._connection.execute("BEGIN")
        reader._connection.execute("SELECT count(*) FROM cases").fetchall()
        with pytest.raises(
            StoreError, match=r"another program has locked cases.sqlite for minutes.*sqlite3 shell"
        ):
            store.add(task, run_task(task))
        reader._connection.execute("ROLLBACK")
        store.add(task, run_task(task))
        assert reader.summary().done == 1
