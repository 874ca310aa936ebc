"""What is no ordinary file is refused at once, and nothing is read that changes meanwhile."""

import os
import socket
import subprocess
import sys
import threading
from pathlib import Path

import pytest

import roughcontact as rc
from roughcontact.files import content as module
from roughcontact.files.content import content
from roughcontact.files.read import channels

READERS = (rc.read, rc.read_line, rc.read_curve, channels)


@pytest.mark.skipif(not Path("/dev/zero").is_char_device(), reason="no such device")
def test_devices_are_refused(tmp_path):
    for device in ("/dev/zero", "/dev/null"):
        (tmp_path / "a.txt").unlink(missing_ok=True)
        (tmp_path / "a.txt").symlink_to(device)
        for path in (device, tmp_path / "a.txt"):
            for function in READERS:
                with pytest.raises(rc.ReadError, match="it is a device, a pipe or a socket; save it as"):
                    function(path)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no such pipes")
def test_a_pipe_without_a_writer_keeps_nobody_waiting(tmp_path, monkeypatch):
    os.mkfifo(tmp_path / "a.txt")
    ended = threading.Event()

    def attempts():
        with pytest.raises(rc.ReadError, match="a pipe"):
            rc.read(tmp_path / "a.txt")
        # Another file may take the place of the one that was looked at, before it is opened.
        ordinary = Path(__file__).stat()
        monkeypatch.setattr(module.os, "stat", lambda _: ordinary)
        with pytest.raises(rc.ReadError, match="a pipe"):
            content(tmp_path / "a.txt").__enter__()
        ended.set()

    threading.Thread(target=attempts, daemon=True).start()
    assert ended.wait(20)


@pytest.mark.skipif(not hasattr(socket, "AF_UNIX"), reason="no such sockets")
def test_a_socket_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # the path of a socket is short
    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind("a.npy")
        with pytest.raises(rc.ReadError, match="a socket"):
            rc.read("a.npy")


@pytest.mark.skipif(not Path("/proc/self/status").is_file(), reason="no such folder")
@pytest.mark.parametrize("path", ["/proc/self/status", "/proc/self/environ", "/proc/self/pagemap"])
def test_files_that_the_system_makes_up_are_refused(path):
    for function in READERS:
        with pytest.raises(rc.ReadError, match="it is empty, or not an ordinary file"):
            function(path)


def test_a_file_that_grows_while_it_is_read_is_refused(put, monkeypatch):
    path = put("a.txt", "1 2\n3 4\n")

    def grow(*_):
        with open(path, "a") as stream:
            stream.write("5 6\n")
        return 0

    monkeypatch.setattr(module, "needed", grow)
    with pytest.raises(rc.ReadError, match="it does not hold the 8 bytes that it should"):
        content(path).__enter__()


def test_a_link_to_an_ordinary_file_is_followed(tmp_path, put):
    (tmp_path / "b.txt").symlink_to(put("a.txt", "1 2\n3 4\n"))
    with content(tmp_path / "b.txt") as found:
        assert found == ("b.txt", b"1 2\n3 4\n")


@pytest.mark.skipif(not Path("/dev/stdin").exists(), reason="no such device")
def test_standard_input_is_no_file():
    code = "import roughcontact as rc\ntry: rc.read('/dev/stdin')\nexcept rc.ReadError as e: print(e)"
    answer = subprocess.run(
        [sys.executable, "-c", code], input="1 2\n3 4\n", capture_output=True, text=True, timeout=60
    )
    assert "a pipe" in answer.stdout
