"""Defect correction with inexact sums of known error: what it solves, what it counts, and where it ends."""

from dataclasses import dataclass, field

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.operators.operator import self_influence
from roughcontact.solver.control import Force, Specification, Status
from roughcontact.solver.optimality import Optimality
from roughcontact.solver.refinement import defect_correction

GRID = rc.Grid((14, 20), (0.5, 0.75))
EXACT = rc.half_space(GRID, 2.0)
GAP = -rc.shapes.paraboloid(GRID, radius=6.0).heights
GAP -= GAP.min()
SPEC = Specification(Force(3.0), tolerance=1e-9)


@dataclass
class Softened:
    """A sum that is too large by some part."""

    part: float
    grid, weights = GRID, EXACT.weights

    def apply(self, pressure):
        return (1 + self.part) * EXACT.apply(pressure)

    def as_matrix(self, cells=None):
        return (1 + self.part) * EXACT.as_matrix(cells)


@dataclass
class Watched:
    """A solver that notes its answers."""

    solver: object
    states: list = field(default_factory=list)

    def run(self, *given):
        self.states.append(self.solver.run(*given))
        return self.states[-1]


def corrected(part, solver=rc.PolonskyKeer()):  # noqa: B008
    watched = Watched(solver)
    conditions = Optimality.of(EXACT, SPEC, GAP)
    return defect_correction(
        watched, Softened(part), EXACT, GAP, conditions, np.zeros(GRID.shape)
    ), watched.states


@pytest.mark.parametrize(("part", "rounds"), [(0.0, 1), (1e-3, 4), (0.1, 11)])
def test_the_answer_is_that_of_the_exact_sum(part, rounds):
    """Each round leaves about the part of the error that the sum is wrong by: 1e-9 takes a few."""
    exact = rc.PolonskyKeer().run(EXACT, GAP, SPEC, np.zeros(GRID.shape))
    state, inner = corrected(part)
    assert state.status is Status.CONVERGED
    assert len(inner) <= rounds
    assert state.steps == sum(each.steps for each in inner) + len(inner)  # an exact product a round
    # Two displacements within the tolerance of the largest, and pressures a few times that over the self-influence.
    scale = SPEC.tolerance * state.displacement.max()
    assert abs(state.depth - exact.depth) <= 10 * scale
    assert np.abs(state.pressure - exact.pressure).max() * self_influence(EXACT) <= 10 * scale
    np.testing.assert_array_equal(state.displacement, EXACT.apply(state.pressure))


def test_a_sum_that_reduces_no_residual_stagnates():
    state, inner = corrected(-0.7)
    assert state.status is Status.STAGNATED
    assert state.residual > SPEC.tolerance
    assert len(inner) > 1


def test_a_sum_that_halves_no_residual_stagnates():
    """One that is three times too large leaves two thirds of the error: tens of rounds would end it."""
    state, inner = corrected(2.0)
    assert state.status is Status.STAGNATED
    assert 1 < len(inner) < 6


def test_a_solver_that_gives_up_says_why():
    state, inner = corrected(1e-3, rc.PolonskyKeer(max_steps=3))
    assert state.status is Status.MAX_STEPS
    assert len(inner) == 1
