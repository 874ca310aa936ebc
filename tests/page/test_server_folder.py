"""The folder of a server: what a killed one left is removed, and nothing else is."""

import os
import subprocess
import sys
import tempfile

import pytest

from roughcontact.page.server.server_folder import SCRATCH, server_folder

RUNNING = """
from roughcontact.page.server.server_folder import server_folder
with server_folder() as folder:
    (folder / "session").mkdir()
    (folder / "session" / "part.npy").write_bytes(b"heights")
    print(folder, flush=True)
    input()
"""


@pytest.fixture(autouse=True)
def place(tmp_path, monkeypatch):
    """Return the folder for temporary files."""
    monkeypatch.setattr(tempfile, "tempdir", os.fspath(tmp_path))
    return tmp_path


@pytest.fixture
def running(place):
    """Return a process whose folder stands."""
    command = [sys.executable, "-c", RUNNING]
    env = os.environ | dict.fromkeys(("TMPDIR", "TEMP", "TMP"), os.fspath(place))
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=env
    ) as process:
        assert process.stdout.readline()
        yield process
        process.kill()


def test_it_goes_with_the_server(place):
    with server_folder() as folder:
        assert [*place.iterdir()] == [folder]
        if os.name == "posix":
            assert folder.stat().st_mode & 0o777 == 0o700
    assert [*place.iterdir()] == []


def test_what_a_killed_server_left_is_removed_at_the_next_start_and_no_earlier(place, running):
    [theirs] = place.iterdir()
    with server_folder():
        assert (theirs / "session" / "part.npy").exists()  # of one that runs
    running.kill()
    running.wait()
    assert [*place.iterdir()] == [theirs]
    with server_folder() as mine:
        assert [*place.iterdir()] == [mine]


def test_a_server_that_is_starting_keeps_its_folder(place):
    starting = place / "roughcontact-page-starting"
    starting.mkdir(mode=0o700)
    with server_folder():
        assert starting.exists()


@pytest.mark.skipif(
    os.name != "posix", reason="Windows keeps others out of a user's folder for temporary files"
)
@pytest.mark.parametrize("how", ["link", "open to all"])
def test_what_others_may_have_put_there_is_left_alone(place, how):
    found = place / "roughcontact-page-trap"
    real = place / "mine" if how == "link" else found
    (real / SCRATCH).mkdir(parents=True)
    real.chmod(0o700 if how == "link" else 0o777)
    if how == "link":
        found.symlink_to(real)
    with server_folder():
        assert [each.name for each in real.iterdir()] == [SCRATCH]
