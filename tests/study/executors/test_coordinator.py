"""A script that computes in local processes, seen from outside: however it ends, nothing goes on."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import psutil
import pytest

TESTS = Path(__file__).parents[2]
# Deliberately without ``if __name__ == "__main__"``: workers do not run the script again.
SCRIPT = """
import signal

from roughcontact.study.executors.processes import Processes
from study.executors.workload import NUMBERS, run_task, tasks

# A shell that starts a job in the background makes it deaf to Ctrl-C; a person's does not.
signal.signal(signal.SIGINT, signal.default_int_handler)
print("started", flush=True)
given = tasks(NUMBERS, [{"seconds": s} for s in %s])
for result in Processes(2).results(run_task, given):
    print(result.key, flush=True)
print("finished")
"""
PATIENCE = 30  # [s], of a busy machine
groups = pytest.mark.skipif(not hasattr(os, "killpg"), reason="no groups of processes here")


@pytest.fixture
def script(tmp_path):
    """Return a function that starts the script with tasks of so many seconds, in a process group of its own."""
    path = tmp_path / "script.py"
    started = []

    def start(seconds):
        path.write_text(SCRIPT % seconds)
        started.append(
            subprocess.Popen(
                [sys.executable, path],
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
                env=os.environ | {"PYTHONPATH": os.fspath(TESTS)},
                process_group=0,
            )
        )
        return started[-1]

    yield start
    for process in started:
        process.kill()
        process.communicate(timeout=PATIENCE)


def test_a_script_needs_no_guard(script):
    out, err = script([0, 0, 0]).communicate(timeout=PATIENCE)
    assert out.split()[0] == "started"
    assert sorted(out.split()[1:-1]) == ["key0", "key1", "key2"]
    assert out.split()[-1] == "finished"
    assert err == ""


@groups
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGKILL"])
def test_no_worker_outlives_it(script, name):
    number = getattr(signal, name)
    process = script([0, 0, 60, 60])
    assert {process.stdout.readline().strip() for _ in range(3)} == {"started", "key0", "key1"}
    workers = psutil.Process(process.pid).children(recursive=True)
    assert len(workers) == 2
    os.killpg(process.pid, number)  # as a terminal does for Ctrl-C
    _, err = process.communicate(timeout=PATIENCE)
    assert process.returncode == -number
    if number == signal.SIGINT:
        assert err.count("Traceback") == 1
        assert err.strip().endswith("KeyboardInterrupt")
    else:
        assert err == ""
    _, alive = psutil.wait_procs(workers, timeout=PATIENCE)
    assert alive == []


@groups
def test_ctrl_c_while_the_workers_start_is_as_quiet(script):
    process = script([60, 60])
    assert process.stdout.readline() == "started\n"
    os.killpg(process.pid, signal.SIGINT)
    _, err = process.communicate(timeout=PATIENCE)
    assert err.count("Traceback") == 1
    assert err.strip().endswith("KeyboardInterrupt")
