"""The judge of random problems (benchmarks/robust.py): it certifies what is right, and tells what is wrong."""

import importlib
import sys
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import roughcontact as rc

BENCHMARKS = str(Path(__file__).parents[1] / "benchmarks")


@pytest.fixture
def robust(monkeypatch):
    monkeypatch.syspath_prepend(BENCHMARKS)
    yield importlib.import_module("robust")
    for name in ("robust", "suite.certificate"):
        sys.modules.pop(name, None)


@pytest.mark.parametrize("periodic", [(False, False), (True, True), (True, False), (False, True)], ids=str)
def test_its_kernel_is_the_library_s(robust, periodic):
    grid = rc.Grid((16, 21), (0.7, 1.9), periodic)
    judge = robust.Judge(grid.shape, grid.spacing, periodic, 2.5)
    pressure = np.random.default_rng(0).random(grid.shape)
    expected = rc.half_space(grid, 2.5).apply(pressure)
    found = judge.displacement(pressure)
    assert np.abs(found - expected).max() < robust.KERNEL * np.abs(expected).max()


def test_some_problems_are_right(robust):
    tallies = defaultdict(robust.Tally)
    for seed in (0, 1, 7, 8, 11, 12):  # of every boundary, elastic and not, with few cells in contact
        robust.examine(seed, tallies)
    assert sum(t.problems for t in tallies.values()) == 6
    assert all(t.certified == t.loads == t.stiffnesses for t in tallies.values())


def wrong_answers(one, solution):
    """Pressures, depths and stiffnesses that are a little off."""
    p = solution.pressure
    free = int(np.argmax(np.where(p < one.hardness, p, 0)))
    none = np.flatnonzero((p == 0) & np.isfinite(one.surface.heights))
    for place, value in ((free, p.flat[free] * (1 + 1e-5)), (none[0], 1e-3 * p.max())):
        changed = p.copy()
        changed.flat[place] = value
        yield replace(solution, pressure=changed)
    yield replace(solution, depth=solution.depth * (1 + 1e-6))


@pytest.mark.parametrize("seed", [1, 8, 11])
def test_it_tells_what_is_wrong(robust, seed):
    one = robust.problem(seed)
    grid = one.surface.grid
    judge = robust.Judge(grid.shape, grid.spacing, grid.periodic, one.modulus)
    solution, load = next(one.solutions()), one.loads[0]
    assert robust.judge_pressure(one, judge, solution, load) <= 1
    for other in wrong_answers(one, solution):
        assert robust.judge_pressure(one, judge, other, load) > 1
    assert robust.judge_stiffness(one, judge, solution) <= 1
    other = replace(solution, _frozen=replace(solution.frozen, stiffness=solution.stiffness * (1 + 1e-5)))
    assert robust.judge_stiffness(one, judge, other) > 1
