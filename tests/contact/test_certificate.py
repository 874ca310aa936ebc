"""A hundred random surfaces, each with a certificate that the test makes by its own product."""

import numpy as np
import oracles
import pytest

import roughcontact as rc

SMALL, LARGE = 80, 20


def problem(number):
    """Surface and force of a number: shape, boundary, Hurst exponent, gaps and load all vary."""
    rng = np.random.default_rng([2, number])
    if number < SMALL:
        ny, nx = (int(n) for n in rng.integers(16, 128, 2))
        nx = ny if rng.random() < 0.3 else nx
    else:
        ny = nx = 512
    periodic = bool(number % 2)
    grid = rc.Grid((ny, nx), (rng.uniform(0.5, 2) / nx, 1 / nx), periodic)
    surface = rc.self_affine(grid, rng.uniform(-0.5, 2.5), 0.01, rng)
    if rng.random() < 0.25:  # ragged: up to a third of the points missing
        heights = surface.heights.copy()
        heights[rng.random(heights.shape) < rng.uniform(0, 0.33)] = np.nan
        surface = rc.Surface(heights, grid)
    force = 10 ** rng.uniform(-5, 1) * 0.01 * np.sqrt(grid.area)
    return surface, force


@pytest.mark.parametrize("number", range(SMALL + LARGE))
def test_certified_from_a_cold_start(number):
    surface, force = problem(number)
    solution = rc.press(surface, 1.0, force=force)
    assert oracles.certificate(surface, 1.0, solution.pressure, solution.depth) <= 1e-8
    assert solution.force == pytest.approx(force, rel=1e-10)
    assert solution.pressure.sum() * surface.grid.cell_area == pytest.approx(force, rel=1e-10)
    assert solution.status is rc.Status.CONVERGED
    assert solution.missing == surface.missing
    k = solution.stiffness
    assert k > 0
    if np.isfinite(k):  # a unit displacement of the contact, by the test's own product
        assert solution.frozen.residual <= 1e-7
        u = oracles.displacement(surface.grid, 1.0, solution.frozen.tangent)
        np.testing.assert_allclose(u[solution.contact], 1.0, rtol=0, atol=2e-7)
    else:
        assert number % 2
        assert solution.contact.all()


@pytest.mark.parametrize("number", range(0, SMALL, 8))
def test_the_certificate_is_not_blind(number):
    """Other pressures, depths and surfaces fail it."""
    surface, force = problem(number)
    s = rc.press(surface, 1.0, force=force)
    shifted = np.roll(s.pressure, 1, axis=0)
    assert oracles.certificate(surface, 1.0, shifted, s.depth) > 1e-6
    assert oracles.certificate(surface, 1.0, s.pressure * 1.001, s.depth) > 1e-6
    assert oracles.certificate(surface, 1.0, s.pressure, s.depth * 1.001) > 1e-6


def test_a_missed_tolerance_is_said():
    surface = rc.self_affine(rc.Grid((64, 64), 1 / 64), 0.8, 0.01, np.random.default_rng(0))
    with pytest.raises(rc.ConvergenceError, match="ran out of steps") as caught:
        rc.press(surface, 1.0, force=1e-2, solver=rc.PolonskyKeer(max_steps=3))
    solution = caught.value.solution
    assert not solution.status.converged
    assert solution.residual > 1e-8
    assert solution.residual == pytest.approx(
        oracles.certificate(surface, 1.0, solution.pressure, solution.depth), rel=1e-6
    )
    assert any("ran out of steps" in note for note in solution.notes)


@pytest.mark.slow
@pytest.mark.parametrize("number", range(1, SMALL, 8))
@pytest.mark.parametrize("share", [0.5, 0.95, 0.999])
def test_certified_at_given_depth_up_to_full_contact(number, share):
    """Periodic, mostly of odd sizes: the depth leaves the mean pressure free only in full contact."""
    surface, _ = problem(number)
    depth = share * np.nanmean(np.nanmax(surface.heights) - surface.heights)
    solution = rc.press(surface, 1.0, depth=depth)
    assert oracles.certificate(surface, 1.0, solution.pressure, solution.depth) <= 1e-8
    again = rc.press(surface, 1.0, force=solution.force)
    assert again.depth == pytest.approx(depth, rel=1e-6)


@pytest.mark.parametrize("shape", [(64, 64), (65, 65), (81, 98)])
@pytest.mark.parametrize("load", [0.03, 0.1, 0.3, 1.0])
def test_stiffness_of_large_periodic_contacts(shape, load):
    """More cells than a factorisation takes, up to all of them, on even and odd grids."""
    surface = rc.self_affine(rc.Grid(shape, 1 / 64, True), 0.8, 0.01, np.random.default_rng(0))
    solution = rc.press(surface, 1.0, force=load)
    if solution.contact.all():
        assert solution.stiffness == np.inf
    else:
        u = oracles.displacement(surface.grid, 1.0, solution.frozen.tangent)
        np.testing.assert_allclose(u[solution.contact], 1.0, rtol=0, atol=2e-7)


def test_a_window_of_a_periodic_grid_with_an_odd_side():
    mask = np.zeros((81, 98), bool)
    mask[:81, :40] = True
    operator = rc.half_space(rc.Grid(mask.shape, 0.1, True), 1.0)
    answer = rc.prescribed_displacement(mask, 1.0, operator=operator)
    u = oracles.displacement(operator.grid, 1.0, answer.pressure)
    np.testing.assert_allclose(u[mask], 1.0, rtol=0, atol=1.1e-8)
    assert rc.contact_stiffness(mask, operator.grid, 1.0) == pytest.approx(answer.force, rel=1e-6)
