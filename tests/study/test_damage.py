"""A database that was damaged is refused or gives what was stored: never something else in silence."""

import os
import shutil
import sqlite3
from contextlib import closing

import numpy as np
import pytest

from roughcontact.study.run import run
from roughcontact.study.store import Store
from roughcontact.study.study import Study
from roughcontact.study.study_errors import StoreError
from study.trial import NAME

STUDY = Study(name="a", case=NAME, samples=10, parameters={"points": 20}, table={"hurst": [0.1, 0.2, 0.3]})


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole")
    run(STUDY, folder)
    return folder


@pytest.fixture
def folder(whole, tmp_path):
    """Return a copy of a whole store."""
    return shutil.copytree(whole, tmp_path / "store")


def rows(folder):
    with Store.open(folder) as store:
        return list(store.rows())


def opened(folder):
    with Store.open(folder, STUDY):
        pass


def refused(folder, complaint):
    """Check that whoever opens the store is told, and that nothing in it changes."""
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    for attempt in (rows, opened, lambda folder: run(STUDY.with_samples(11), folder)):
        with pytest.raises(StoreError) as caught:
            attempt(folder)
        assert complaint in str(caught.value)
        assert str(caught.value).startswith(f"{folder}: ")
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_a_newer_version_is_refused(folder):
    with closing(sqlite3.connect(folder / "cases.sqlite")) as database:
        database.execute("PRAGMA user_version = 2")
    refused(
        folder,
        "cases.sqlite has version 2, but this roughcontact reads version 1; use the newer roughcontact",
    )


def test_an_empty_file_is_refused(folder):
    (folder / "cases.sqlite").write_bytes(b"")
    refused(folder, "cases.sqlite is empty; put a backup in its place")


def test_a_foreign_file_is_refused(folder):
    (folder / "cases.sqlite").write_text("Experiments of last summer\n" * 100)
    refused(folder, "cases.sqlite is damaged, or is not a database (file is not a database)")


def test_a_foreign_database_is_refused(folder):
    (folder / "cases.sqlite").unlink()
    with closing(sqlite3.connect(folder / "cases.sqlite")) as database:
        database.execute("CREATE TABLE cases (key, record)")
    refused(folder, "cases.sqlite is not a database of cases")


@pytest.mark.parametrize("share", [0.3, 0.6, 0.95])
def test_a_truncated_file_is_refused(folder, share):
    size = (folder / "cases.sqlite").stat().st_size
    os.truncate(folder / "cases.sqlite", int(share * size))
    refused(folder, "damaged")


def test_pages_of_zeros_are_refused(folder):
    with open(folder / "cases.sqlite", "r+b") as stream:
        stream.seek(8 * 4096)
        stream.write(bytes(4 * 4096))
    refused(folder, "damaged")


def test_a_changed_number_is_seen(folder):
    data = (folder / "cases.sqlite").read_bytes()
    at = data.index(b'"values":[', len(data) // 2) + len('"values":[0.')
    changed = b"1" if data[at : at + 1] != b"1" else b"2"
    (folder / "cases.sqlite").write_bytes(data[:at] + changed + data[at + 1 :])
    with pytest.raises(
        StoreError, match=r"the case (\w{64}) in cases.sqlite is damaged; put a backup"
    ) as caught:
        rows(folder)
    # What the message advises:
    command = str(caught.value).split('cases.sqlite "')[1].rstrip('"')
    with closing(sqlite3.connect(folder / "cases.sqlite")) as database, database:
        database.execute(command)
    assert run(STUDY, folder).done == 30
    assert len(rows(folder)) == 30


def test_flipped_bytes_are_refused_or_change_nothing(folder, whole):
    expected = rows(whole)
    sound = (whole / "cases.sqlite").read_bytes()
    rng = np.random.default_rng(1)
    refusals = 0
    for _ in range(150):
        data = np.frombuffer(sound, np.uint8).copy()
        at = rng.integers(100 if rng.random() < 0.5 else len(data), size=rng.integers(1, 4))
        data[at] ^= rng.integers(1, 256, size=at.size, dtype=np.uint8)
        (folder / "cases.sqlite").write_bytes(data.tobytes())
        try:
            assert rows(folder) == expected
        except StoreError:
            refusals += 1
    assert refusals > 50
