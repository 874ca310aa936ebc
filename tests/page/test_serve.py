"""The server from its start to its end: what it answers, what it survives, what it leaves behind."""

import io
import signal
import socket
import subprocess
import sys
import zipfile
from time import monotonic

import numpy as np
import psutil
import pytest

pytest.importorskip("starlette", reason="the page needs the extra 'page'")
pytest.importorskip("uvicorn", reason="the page needs the extra 'page'")

import roughcontact as rc
from served import PATIENCE, ended, started

MADE = {"kind": "self-affine", "hurst": "0.8", "rms": "0.1um", "size": "32um", "points": "32"}
LARGE = {"kind": "self-affine", "hurst": "0.8", "rms": "1um", "size": "2mm", "points": "1024"}
BODIES = {"modulus": "100GPa"}
LOOK = {"job": "surface", "source": MADE}
PRESS = {"job": "press", "source": MADE, "bodies": BODIES, "load": {"pressure": "1MPa"}}
CURVE = {"job": "curve", "source": LARGE, "bodies": BODIES}


@pytest.fixture(scope="module")
def served(tmp_path_factory):
    found = started(tmp_path_factory.mktemp("served"))
    yield found
    ended(found)


def last(messages):
    """Return the last of the messages, of which there are some."""
    *_, end = messages
    return end


def bomb(name, unpacked):
    """Return an archive of so many zeros."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive, archive.open(name, "w") as member:
        for _ in range(unpacked // 2**20):
            member.write(bytes(2**20))
    return stream.getvalue()


def boast():
    """Return an archive that says of its one member that it unpacks to a petabyte."""
    plain = bomb("heights.npy", 2**20)
    size = (2**20).to_bytes(4, "little")
    return plain.replace(size, (2**32 - 2).to_bytes(4, "little"))


def head(shape):
    """Return the head of a NumPy file of that shape, and little behind it."""
    stream = io.BytesIO()
    np.lib.format.write_array_header_1_0(stream, {"descr": "<f8", "fortran_order": False, "shape": shape})
    return stream.getvalue() + bytes(64)


FILES = {
    "bomb.npz": bomb("heights.npy", 2**26),
    "bomb.x3p": bomb("main.xml", 2**26),
    "boast.npz": boast(),
    "wide.npy": head((10**7, 10**7)),
    "endless.npy": head((2**62, 2)),
    "pickled.npy": b"\x93NUMPY\x01\x00F\x00{'descr': '|O', 'fortran_order': False, 'shape': (1,), }".ljust(
        200
    ),
    "text.xyz": b"1 2\n" * 1000 + b"1e999 nan\n",
    "sur-2.sur": b"DIGITAL SURF" + b"\xff" * 600,
    "nothing.x3p": b"",
}


def test_files_that_mean_harm_are_refused_with_a_reason(served):
    session = served.begin()
    for number, (name, content) in enumerate(FILES.items()):
        file = served.put(session, name, content)
        source = {"kind": "file", "file": file, "size": "1mm"}
        end = last(served.request(session, "look", {**LOOK, "source": source}, key=str(number)))
        assert end["how"] == "refused", (name, end)
        assert end["message"]
        assert str(served.folder) not in str(end)
    assert last(served.request(session, "look", LOOK, key="last"))["how"] == "done"
    served.ask("POST", f"/end?session={session}")


def test_a_map_larger_than_the_screen_is_reduced_and_keeps_its_highest_point(served):
    session = served.begin()
    source = {**MADE, "size": "200um", "points": "200"}
    messages = served.request(
        session, "look", {**LOOK, "source": source, "preparation": {"level": "plane"}}, more={"pixels": 64}
    )
    [found] = [each for each in messages if each["type"] == "map"]
    assert (found["shape"], found["cells"], found["factor"]) == ([50, 50], [200, 200], 4)
    grid = rc.Grid((200, 200), 1e-6)
    heights = rc.self_affine(grid, 0.8, 0.1e-6, np.random.default_rng(1)).levelled("plane").heights
    # In single precision, as it goes to the screen.
    assert found["ends"][1] == np.float32((heights - heights.mean()).max())
    served.ask("POST", f"/end?session={session}")


def test_a_path_is_no_file_of_a_session_nor_is_the_file_of_another(served):
    mine, other = served.begin(), served.begin()
    theirs = served.put(other, "part.npy", FILES["wide.npy"])
    for name in (theirs, "/etc/passwd", f"../{other}/{theirs}/part.npy", "given", ""):
        end = last(served.request(mine, "look", {**LOOK, "source": {"kind": "file", "file": name}}))
        assert end["how"] == "refused"
        assert end["message"].startswith(("The server no longer has this file.", "The name is empty."))
    for session in (mine, other):
        served.ask("POST", f"/end?session={session}")
    before = monotonic() + PATIENCE
    while served.left():
        assert monotonic() < before


def test_another_host_another_origin_and_a_gigabyte_are_refused(served):
    session = served.begin()
    assert served.ask("GET", "/", host=f"evil.example:{served.port}")[0] == 400
    assert served.ask("POST", "/session", headers=[("Origin", "http://evil.example")])[0] == 403
    gigabyte = [("Content-Length", str(2**30))]
    status, words = served.ask("PUT", f"/file?session={session}&name=large.x3p", headers=gigabyte)
    assert status == 413
    assert b"512 MB" in words
    served.ask("POST", f"/end?session={session}")


def test_a_worker_that_is_killed_is_said_and_replaced(served):
    session = served.begin()
    messages = served.request(session, "curve", CURVE)
    assert next(messages)["type"] == "progress"
    for worker in served.workers:
        worker.kill()
    end = last(messages)
    assert end["how"] == "died"
    assert "A new one takes over" in end["message"]
    assert last(served.request(session, "press", PRESS, key="2"))["how"] == "done"
    served.ask("POST", f"/end?session={session}")


def test_an_order_is_stopped_and_the_next_one_answered(served):
    session = served.begin()
    messages = served.request(session, "curve", CURVE, key="long")
    assert next(messages)["type"] == "progress"
    assert served.ask("POST", f"/stop?session={session}&queue=front&key=long")[0] == 200
    assert last(messages)["how"] == "stopped"
    assert last(served.request(session, "press", PRESS, key="2"))["how"] == "done"
    served.ask("POST", f"/end?session={session}")


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_server_that_ends_leaves_no_process_and_no_file(tmp_path, name):
    """In the middle of a curve, with a dropped file; and its log holds no key."""
    if signal.getsignal(getattr(signal, name)) is signal.SIG_IGN:
        pytest.skip("the tests run so that they outlive their terminal, and so does the server")
    served = started(tmp_path)
    session = served.begin()
    served.put(session, "part.npy", b"heights")
    messages = served.request(session, "curve", CURVE, queue="back")
    assert next(messages)["type"] == "progress"
    assert len(served.left()) == 1
    workers = served.workers
    assert workers
    status = ended(served, getattr(signal, name))
    assert status == (0 if name == "SIGINT" else 128 + signal.SIGTERM)
    assert [each["type"] for each in messages if each["type"] == "end"] == []
    assert psutil.wait_procs(workers, timeout=PATIENCE)[1] == []
    assert {path.name for path in tmp_path.iterdir()} == {"log"}
    assert "Traceback" not in served.log
    assert served.token not in served.log
    assert session not in served.log


def test_workers_end_with_a_server_that_is_killed_and_its_files_at_the_next_start(tmp_path):
    served = started(tmp_path)
    session = served.begin()
    served.put(session, "part.npy", b"heights")
    assert last(served.request(session, "look", LOOK))["how"] == "done"
    workers = served.workers
    served.process.kill()
    served.process.wait()
    served.process.stdout.close()
    assert psutil.wait_procs(workers, timeout=PATIENCE)[1] == []
    assert len(served.left()) == 1
    again = started(tmp_path)
    again.begin()  # it then serves: Python may lose a signal that comes while it starts
    ended(again)
    assert {path.name for path in tmp_path.iterdir()} == {"log"}


def refused(*arguments):
    """Return what `serve` says that does not start."""
    command = [sys.executable, "-m", "roughcontact", "serve", "--no-browser", *arguments]
    found = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)
    assert (found.returncode, found.stdout) == (2, "")
    return found.stderr


def test_a_port_that_is_taken_is_named():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        assert refused("--port", str(port)).startswith(f"Error: --port: port {port} is not available")


def test_ports_and_files_that_there_are_not_are_named():
    assert "from 1024 to 65535, not '70000'" in refused("--port", "70000")
    assert "part.x3p: there is no such file" in refused("part.x3p")
