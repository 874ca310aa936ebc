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
