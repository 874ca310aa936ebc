"""Allocations that fail, one at a time: no wrong answer, nothing half-written, and the next press works."""

import os

import numpy as np
import pytest
from typer.testing import CliRunner

import roughcontact as rc
from refused_memory import RefusedMemory
from roughcontact.cli.app import app

TRIED = 30  # of the allocations of a task at most, spread over it
SURFACES = {
    "free": rc.self_affine(rc.Grid((48, 40), 1e-6), 0.8, 1e-7, 1),
    "periodic": rc.self_affine(rc.Grid((48, 40), 1e-6, periodic=True), 0.8, 1e-7, 1),
}
TASKS = {
    "free": lambda: rc.press(SURFACES["free"], 1e11, force=1e-1),
    "periodic": lambda: rc.press(SURFACES["periodic"], 1e11, pressure=5e8),
    "plastic": lambda: rc.press(SURFACES["periodic"], 1e11, pressure=5e8, hardness=3e9),
    "curve": lambda: rc.loading_curve(SURFACES["free"], 1e11, forces=[1e-4, 1e-3]),
}


pytestmark = pytest.mark.skipif(os.name != "posix", reason="the allocator is that of a C library of POSIX")


@pytest.fixture(scope="module")
def memory():
    return RefusedMemory()


def fields(answer):
    return answer.pressure if hasattr(answer, "pressure") else answer.stiffness


@pytest.mark.parametrize("kind", TASKS)
def test_a_press_without_memory_raises_and_the_next_one_works(memory, kind):
    task = TASKS[kind]
    task()  # what is made once is made now
    right = fields(memory.run(task))
    total = memory.count
    raised = 0
    tried = np.unique(np.linspace(1, total, TRIED).round())
    assert tried.size > 12
    for n in tried:
        try:
            answer = memory.run(task, refused=int(n))
        except MemoryError:
            raised += 1
        else:  # a copy or a hint that it does without
            # Another start of the same solve: 1e-6 is a hundred times its tolerance.
            np.testing.assert_allclose(fields(answer), right, rtol=1e-6, atol=1e-6 * abs(right).max())
        np.testing.assert_array_equal(fields(task()), right)
    assert raised > tried.size / 2


def test_a_command_without_memory_writes_nothing(memory, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rc.write(SURFACES["free"], "rough.npz")
    words = ["press", "rough.npz", "--modulus", "100GPa", "--force", "1mN", "--out", "result"]
    runner = CliRunner()
    memory.run(lambda: runner.invoke(app, [*words[:-1], "first"]))
    whole = sorted(path.name for path in (tmp_path / "first").iterdir())
    result = memory.run(lambda: runner.invoke(app, [*words[:-1], "second"]))
    assert result.exit_code == 0
    total, failed = memory.count, 0
    for n in np.linspace(1, total, 12).round():
        result = memory.run(lambda: runner.invoke(app, words), refused=int(n))
        written = sorted(path.name for path in (tmp_path / "result").glob("*"))
        assert written in ([], whole), n
        failed += result.exit_code != 0
        assert result.exit_code != 0 or written == whole
        for path in (tmp_path / "result").glob("*"):
            path.unlink()
    assert failed > 3
