"""Strategies draw what they state, and pressed problems are certified or say that they missed."""

import hypothesis
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis.errors import NoSuchExample

import roughcontact as rc
from roughcontact.testing import grids, loads, surfaces

MODULUS = 3e9


def find(strategy, wanted):
    """Return the first example of a hundred tries, which need not be the simplest one."""
    few = settings(max_examples=100, phases=[hypothesis.Phase.generate], database=None)
    return hypothesis.find(strategy, wanted, settings=few)


@given(grids(3, 9, periodic=False))
def test_grids_have_sides_within_their_limits(grid):
    assert all(3 <= n <= 9 for n in grid.shape)
    assert grid.periodic == (False, False)


def test_grids_are_of_both_kinds_with_square_cells_and_others():
    for wanted in (
        lambda grid: all(grid.periodic),
        lambda grid: not any(grid.periodic),
        lambda grid: grid.spacing[0] == grid.spacing[1],
        lambda grid: grid.spacing[0] != grid.spacing[1],
    ):
        assert wanted(find(grids(), wanted))


def test_limits_out_of_order_are_refused():
    with pytest.raises(ValueError, match="increasing numbers from 1 on, not 5 and 4"):
        grids(5, 4)


@given(surfaces(grids(2, 12)))
def test_surfaces_without_missing_cells_are_whole(surface):
    assert np.isfinite(surface.heights).all()


def test_surfaces_may_miss_cells_but_not_all():
    drawn = find(surfaces(missing=True), lambda surface: np.isnan(surface.heights).any())
    assert np.isfinite(drawn.heights).any()


def problems(on, missing):
    return surfaces(on, missing=missing).flatmap(
        lambda surface: loads(surface, MODULUS).map(lambda load: (surface, load))
    )


@settings(max_examples=80, deadline=None, suppress_health_check=list(HealthCheck))
@given(problem=problems(grids(2, 32), missing=False))
def test_drawn_problems_are_solved_or_say_that_they_are_not(problem):
    """The load is reached to 1e-9, pressures push, and the residual is within the tolerance of 1e-8."""
    surface, load = problem
    try:
        answer = rc.press(surface, MODULUS, **load, tolerance=1e-8)
    except rc.ConvergenceError as error:
        answer = error.solution
    assert answer.pressure.min() >= 0
    assert answer.status.converged == (answer.residual <= 1e-8)
    if answer.status.converged and "force" in load:
        assert answer.force == pytest.approx(load["force"], rel=1e-9)


def test_every_control_is_drawn():
    periodic = find(surfaces(grids(4, 8, periodic=True)), lambda surface: True)
    for name in ("force", "pressure", "depth"):
        [(found, value)] = find(loads(periodic, MODULUS), lambda load, name=name: name in load).items()
        assert found == name
        assert value > 0


def test_a_flat_periodic_surface_has_no_depth():
    free, periodic = (rc.Surface(np.zeros((4, 6)), rc.Grid((4, 6), 1e-6, around)) for around in (False, True))
    assert "depth" in find(loads(free, MODULUS), lambda load: "depth" in load)
    with pytest.raises(NoSuchExample):
        find(loads(periodic, MODULUS), lambda load: "depth" in load)
