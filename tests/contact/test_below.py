"""Below a solved contact: Hertz, rough spots, rows, and which solutions have no half-space below them."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

import roughcontact as rc
from roughcontact.evaluation.below import below, displacement_below, largest_von_mises
from roughcontact.halfspace.operators.build import singly_periodic
from roughcontact.halfspace.operators.layer import layer

MODULUS = 2.0
STEEL, SOFT = rc.Solid(3.0, 0.3), rc.Solid(2.0, 0.4)


def sphere(n, side=4.0, periodic=False, **press):
    grid = rc.Grid((n, n), side / n, periodic)
    x = grid.coordinates[0] - side / 2
    surface = rc.Surface(-(x[:, None] ** 2 + x**2) / 2, grid)
    return rc.press(surface, MODULUS, **({"depth": 1.0} | press))


def test_the_largest_equivalent_stress_below_hertz():
    """0.62 p0, 0.48 a deep (nu = 0.3), by the closed form on the axis; the grid's part is (dx/a)^2/6 = 6e-4."""
    p0 = 2 * MODULUS / np.pi

    def on_axis(z, nu=0.3):
        return abs((1 + nu) * (1 - z * np.arctan(1 / z)) - 1.5 / (1 + z * z)) * p0

    best = minimize_scalar(lambda z: -on_axis(z), bounds=(0.2, 0.8), method="bounded")
    s = sphere(65)
    peak = largest_von_mises(s, 0.3)
    assert peak.von_mises == pytest.approx(-best.fun, rel=6e-4)
    assert peak.depth == pytest.approx(best.x, rel=5e-3)  # flat: the root of the error of the stress
    assert peak.position == pytest.approx((2.0, 2.0))
    assert peak.resolved
    assert peak == largest_von_mises(s, rc.Solid(70e9, 0.3))  # the modulus plays no part


def test_a_small_contact_on_a_large_map_costs_and_says_the_same():
    """Far from the loads nothing is looked for."""
    small, large = sphere(33, 4.0), sphere(99, 12.0)
    near, far = (largest_von_mises(s, 0.3) for s in (small, large))
    assert far.von_mises == pytest.approx(near.von_mises, rel=1e-6)
    assert far.depth == pytest.approx(near.depth, rel=2e-3)
    assert far.position == pytest.approx((6.0, 6.0))


def test_nothing_is_larger_anywhere():
    """Against every depth of a fine comb, on a rough surface."""
    grid = rc.Grid((48, 48), 1e-6)
    rough = rc.self_affine(grid, hurst=0.8, rms=2e-7, rng=np.random.default_rng(1))
    s = rc.press(rough, 1e11, pressure=1e8)
    peak = largest_von_mises(s, 0.3)
    comb = below(s, np.geomspace(0.5e-6, 40e-6, 60), 0.3).von_mises
    assert peak.von_mises >= comb.max() * (1 - 1e-3)
    row, column = (int(c // 1e-6) for c in peak.position)
    there = below(s, peak.depth, 0.3).von_mises
    assert there[row, column] == pytest.approx(peak.von_mises, rel=1e-9)
    assert there.max() == there[row, column]


@pytest.mark.parametrize("periodic", [False, True])
def test_two_bodies_share_the_displacement_of_the_surface(periodic):
    modulus = rc.reduced_modulus(STEEL, SOFT)
    grid = rc.Grid((20, 24), 0.1, periodic)
    rough = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(0))
    s = rc.press(rough, modulus, pressure=0.02)
    both = sum(displacement_below(s, 0.0, solid).z for solid in (STEEL, SOFT))
    np.testing.assert_allclose(both, s.displacement, rtol=1e-11, atol=1e-15)
    np.testing.assert_allclose(below(s, 0.0, STEEL).zz, -s.pressure, atol=1e-13 * s.pressure.max())


def test_a_row_of_spheres():
    """Equilibrium under one period, and the field of one alone when the next is far."""
    force, alone = 0.2, sphere(33, 2.0, force=0.2, depth=None)
    grid = rc.Grid((165, 33), 2.0 / 33, (True, False))
    y, x = (c - length / 2 for c, length in zip(grid.coordinates, grid.lengths, strict=True))
    surface = rc.Surface(-(y[:, None] ** 2 + x**2) / 2, grid)
    s = rc.press(surface, MODULUS, force=force, operator=singly_periodic(grid, MODULUS))
    found, exact = below(s, 0.3, 0.3).von_mises[66:99], below(alone, 0.3, 0.3).von_mises
    # The nearest images, ten away, bring 2 F/(2 pi 10^2) = 6e-4 at most and change the pressure by less.
    np.testing.assert_allclose(found, exact, atol=1.5e-3)


@pytest.mark.parametrize("base", ["rigid-frictionless", rc.Solid(0.3, 0.3)], ids=str)
def test_below_a_layer_nothing_is_claimed(base):
    grid = rc.Grid((16, 16), 0.1)
    x = grid.coordinates[0] - 0.8
    surface = rc.Surface(-(x[:, None] ** 2 + x**2) / 2, grid)
    s = rc.press(surface, MODULUS, force=0.05, operator=layer(grid, STEEL, 0.2, base=base))
    with pytest.raises(ValueError, match="another body"):
        below(s, 0.1, 0.3)
    with pytest.raises(ValueError, match="another body"):
        largest_von_mises(s, 0.3)


def test_a_constant_pressure_tells_a_half_space_from_a_layer():
    """Its displacement is rounding there, and compression here."""
    grid = rc.Grid((8, 8), 0.1, True)
    flat = rc.Surface(np.zeros((8, 8)), grid)
    s = below(rc.press(flat, MODULUS, pressure=0.01), 0.3, 0.3)
    np.testing.assert_allclose(s.zz, -0.01, rtol=1e-12)
    np.testing.assert_allclose(s.von_mises, 0.01 * (1 - 0.3 / 0.7), rtol=1e-12)
    operator = layer(grid, STEEL, 0.2, base="rigid-frictionless")
    with pytest.raises(ValueError, match="another body"):
        below(rc.press(flat, MODULUS, pressure=0.01, operator=operator), 0.1, 0.3)


def test_below_lines_rings_and_springs_nothing_is_known():
    line = rc.Grid(16, 0.1)
    heights = rc.Surface(-((line.coordinates[0] - 0.8) ** 2) / 2, line)
    for operator in (rc.line(line, MODULUS), rc.foundation(line, MODULUS)):
        s = rc.press(heights, MODULUS, force=0.05, operator=operator)
        with pytest.raises(ValueError, match=r"surface of two axes, not of a (line|foundation)"):
            below(s, 0.1, 0.3)


def test_a_pair_of_bodies_is_refused():
    body = rc.Solid(1e9, 0.3)
    solution = rc.press(rc.shapes.paraboloid(rc.Grid((16, 20), 1e-6), radius=1e-4), 1e9, force=1e-3)
    with pytest.raises(ValueError, match="one of the two bodies"):
        rc.below(solution, 1e-6, (body, body))


def test_without_contact_there_is_no_largest():
    s = sphere(9, depth=0.0)
    assert not s.contact.any()
    np.testing.assert_array_equal(below(s, 0.1, 0.3).von_mises, 0.0)
    with pytest.raises(ValueError, match="nothing is in contact"):
        largest_von_mises(s, 0.3)


@pytest.mark.parametrize("nu", [0.6, -1.0])
def test_nonsense_is_refused(nu):
    with pytest.raises(ValueError, match="poisson_ratio must lie"):
        largest_von_mises(sphere(9), nu)
