"""The contact against what is known in closed form."""

import itertools

import numpy as np
import oracles
import pytest

import roughcontact as rc

K00 = 3.525494348078172  # thesis, eq. 4.15: 4 ln(1 + sqrt 2)


@pytest.mark.parametrize("modulus", [1.0, 110e9])
@pytest.mark.parametrize("dx", [1.0, 1e-7])
def test_one_cell(modulus, dx):
    """Eq. 4.16: k = pi E* dx / K00."""
    mask = np.zeros((9, 7), bool)
    mask[4, 2] = True
    stiffness = rc.contact_stiffness(mask, rc.Grid((9, 7), (dx, dx)), modulus)
    assert stiffness == pytest.approx(np.pi * modulus * dx / K00, rel=1e-12)


def test_full_square():
    """1.15230 E* L by two Richardson levels (error c/n, then c/n^2), to 1e-4; not the 1.1419 of eq. 4.14."""
    full = [rc.contact_stiffness(np.ones((n, n), bool), rc.Grid((n, n), 1 / n), 1.0) for n in (32, 64, 128)]
    assert full == sorted(full)
    first = [2 * b - a for a, b in itertools.pairwise(full)]
    second = (4 * first[1] - first[0]) / 3
    assert second == pytest.approx(1.15230, rel=1e-4)
    assert full[-1] > 1.1419


def test_uniform_cells_of_the_equation_page():
    """k_N of the square of N x N cells, six digits."""
    known = {1: 0.891107, 2: 0.993186, 4: 1.065467, 8: 1.106498, 16: 1.128631, 32: 1.140213, 64: 1.146173}
    for n, k in known.items():
        stiffness = rc.contact_stiffness(np.ones((n, n), bool), rc.Grid((n, n), 1 / n), 1.0)
        assert stiffness == pytest.approx(k, abs=5.1e-7)


def hertz(n, a=0.4, radius=1.0):
    """Relative errors of depth and of the largest pressure; the apex sits on a cell centre."""
    surface = rc.Surface(oracles.paraboloid(n, radius), rc.Grid((n, n), 1 / n))
    solution = rc.press(surface, 1.0, force=4 * a**3 / (3 * radius), tolerance=1e-10)
    return solution.depth / (a**2 / radius) - 1, solution.pressure.max() / (2 * a / (np.pi * radius)) - 1


def test_hertz():
    """Depth within 2e-5 at 77 cells in the radius; order near 2 between 39 and 154 cells."""
    errors = {n: hertz(n) for n in (97, 195, 385)}
    depth, peak = errors[195]  # 78 cells in the radius
    assert abs(depth) < 2e-5
    assert abs(peak) < 2e-5
    for which in (0, 1):
        order = np.log(errors[97][which] / errors[385][which]) / np.log(385 / 97)
        assert 1.5 < order < 2.5


def westergaard(n, s):
    """Wave h (1 - cos) with sin^2(pi a/lambda) = s in contact; depth h s (1 - ln s) from first touch."""
    h = 0.01
    x = np.arange(n) / n
    surface = rc.Surface(np.tile(h * np.cos(2 * np.pi * x), (4, 1)), rc.Grid((4, n), 1 / n, True))
    solution = rc.press(surface, 1.0, depth=h * s * (1 - np.log(s)), tolerance=1e-10)
    mean = np.pi * h * s
    return solution.pressure.mean() / mean - 1, solution.pressure.max() / (2 * mean / np.sqrt(s)) - 1


@pytest.mark.parametrize("s", [0.2, 0.5, 0.8])
def test_westergaard(s):
    mean, centre = westergaard(512, s)
    assert abs(mean) < 1e-4
    assert abs(centre) < 1e-4


def test_boundary_conditions_differ():
    """A free and a periodic wave of the same heights are different bodies."""
    heights = 0.01 * np.cos(2 * np.pi * np.arange(32) / 32) * np.ones((32, 1))
    free, periodic = (
        rc.press(rc.Surface(heights, rc.Grid((32, 32), 1 / 32, b)), 1.0, force=1e-3).depth
        for b in (False, True)
    )
    assert free > 1.02 * periodic


def test_prescribed_displacement_of_hertz():
    """A.7 forward: the parabola of Hertz' contact, given on its disc, takes Hertz' pressure."""
    n, a = 129, 0.4
    grid = rc.Grid((n, n), 1 / n)
    heights = oracles.paraboloid(n, 1.0)
    disc = -2 * heights <= a**2
    answer = rc.prescribed_displacement(
        disc, a**2 + heights, operator=rc.half_space(grid, 1.0), tolerance=1e-10
    )
    assert answer.residual <= 1e-10
    u = oracles.displacement(grid, 1.0, answer.pressure)
    np.testing.assert_allclose(u[disc], (a**2 + heights)[disc], rtol=0, atol=1.01e-10 * a**2)
    assert answer.force == pytest.approx(
        4 * a**3 / 3, rel=0.003
    )  # the staircase of the rim, some dx/a * 1/10
    assert answer.pressure[n // 2, n // 2] == pytest.approx(2 * a / np.pi, rel=1e-3)
