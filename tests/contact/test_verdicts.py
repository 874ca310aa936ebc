"""What an answer says of itself by yes or no: each verdict is yes once and no once."""

import numpy as np
import pytest

import roughcontact as rc

GRID = rc.Grid((32, 40), 1e-6)
BALL = rc.shapes.paraboloid(GRID, radius=1e-4)
STEEL = rc.Solid(1e9, 0.3)
MODULUS = rc.reduced_modulus(STEEL)


def pressed(**load):
    return rc.press(BALL, MODULUS, **load)


@pytest.mark.parametrize(("force", "resolved"), [(5e-3, True), (1e-6, False)])
def test_the_peak_of_the_stress_is_resolved_from_two_cells_below_the_surface(force, resolved):
    """Under a ball it lies at half the radius of contact: below one cell in contact it is none of the ball's."""
    peak = rc.largest_von_mises(pressed(force=force), STEEL)
    assert peak.resolved is resolved
    assert (peak.depth >= 2e-6) is resolved


@pytest.mark.parametrize(
    ("force", "resolved_from_below", "resolved"),
    [(1e-6, False, False), (3e-2, True, True), (10.0, True, False)],
)
def test_a_contact_is_resolved_between_a_cell_and_the_whole_map(force, resolved_from_below, resolved):
    solution = pressed(force=force)
    assert solution.contact.sum() > 1 or not resolved_from_below
    assert (solution.contact.mean() > 0.9) == (resolved_from_below and not resolved)
    assert solution.resolved_from_below is resolved_from_below
    assert solution.resolved is resolved


@pytest.mark.parametrize("periodic", [False, True, (True, False)])
def test_a_problem_is_semidefinite_where_a_constant_pressure_moves_nothing(periodic):
    surface = rc.Surface(BALL.heights, rc.Grid((32, 40), 1e-6, periodic))
    operator = rc.singly_periodic(surface.grid, MODULUS) if isinstance(periodic, tuple) else None
    problem = rc.press(surface, MODULUS, force=1e-3, operator=operator).problem
    moved = np.abs(problem.operator.apply(np.ones(surface.grid.shape))).max()
    assert problem.semidefinite is (periodic is True)
    assert (moved < 1e-12 * surface.grid.lengths[0] / MODULUS) == (periodic is True)


def test_a_problem_is_plastic_under_a_hardness():
    assert pressed(force=1e-3, hardness=1e9).problem.plastic is True
    assert pressed(force=1e-3).problem.plastic is False


def test_bodies_slide_where_every_cell_slips():
    solution = pressed(force=1e-3)
    assert rc.slide(solution, STEEL, friction=0.5, force=(0.5e-3, 0.0)).sliding is True
    assert rc.slide(solution, STEEL, friction=0.5, force=(0.3e-3, 0.0)).sliding is False
