"""Random loops under a hardness (benchmarks/loops.py): each state is certified, or says that it is not."""

import importlib
import sys
from dataclasses import replace
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

BENCHMARKS = str(Path(__file__).parents[1] / "benchmarks")


@pytest.fixture
def loops(monkeypatch):
    monkeypatch.syspath_prepend(BENCHMARKS)
    yield importlib.import_module("loops")
    for name in ("loops", "robust", "suite.certificate"):
        sys.modules.pop(name, None)


def test_some_loops_are_right(loops):
    tally = loops.LoopTally()
    for seed, one in islice(loops.loops(0), 16):
        loops.examine(one, str(seed), tally)
    assert tally.loops == 16
    assert tally.certified == tally.states == 16 * len(loops.LOADS)
    assert tally.wrong == tally.missed == 0
    # Pressures of states that are known to 1e-8 of the largest displacement, which moves a pressure by some times that.
    assert max(tally.beyond, tally.again, tally.steps) < 1e-5


def test_its_judge_tells_a_wrong_state(loops):
    one = next(
        one for _, one in loops.loops(0) if np.ptp(loops.states_of(one, one.loads[-1:])[0].flow.depth) > 0
    )
    judge = loops.Judge(
        one.surface.grid.shape, one.surface.grid.spacing, one.surface.grid.periodic, one.modulus
    )
    load = float(one.loads.max())
    first, _, back = loops.states_of(one, load * np.array([0.9, 1.0, 0.5]))
    none, flowed = np.zeros(one.surface.grid.shape), back.flow.depth
    assert loops.error_of(one, judge, first, none, 0.9 * load) <= 1
    assert loops.error_of(one, judge, back, flowed, 0.5 * load) <= 1
    assert flowed.any()
    deeper = replace(back, depth=back.depth * (1 + 1e-5))
    assert loops.error_of(one, judge, deeper, flowed, 0.5 * load) > 1
    assert loops.error_of(one, judge, back, flowed * (1 + 1e-5), 0.5 * load) > 1
    assert loops.error_of(one, judge, back, flowed, 0.5001 * load) > 1
