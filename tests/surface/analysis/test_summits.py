import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.analysis.summits import find_summits
from roughcontact.surface.generation.spectrum import SelfAffineSpectrum
from roughcontact.surface.moments import grid_moments


def egg_box(n=32, waves=2, amplitude=1e-6, spacing=1e-6, periodic=True):
    x = np.arange(n) * 2 * np.pi * waves / n
    return rc.Surface(amplitude * np.cos(x) * np.cos(x)[:, None], rc.Grid((n, n), spacing, periodic))


def test_an_egg_box_has_its_summits():
    """cos cos: two a cell of waves, height A, both curvatures A q^2, damped by central differences."""
    found = find_summits(egg_box())
    assert found.count == 2 * 2**2
    np.testing.assert_allclose(found.height, 1e-6, rtol=1e-12)
    q = 2 * np.pi * 2 / 32e-6
    expected = 1e-6 * q**2 * np.sinc(q * 1e-6 / 2 / np.pi) ** 2
    np.testing.assert_allclose(found.curvature, expected, rtol=1e-12)
    np.testing.assert_allclose(found.radius, 1 / expected, rtol=1e-12)
    assert found.density == pytest.approx(8 / (32e-6) ** 2)
    assert {(int(i), int(j)) for i, j in zip(found.rows, found.columns, strict=True)} == {
        (8 * i, 8 * j) for i in range(4) for j in range(4) if (i + j) % 2 == 0
    }


def test_the_rim_of_a_free_surface_has_none():
    free = find_summits(egg_box(periodic=False))
    assert free.count == 5  # those at row or column 0 are gone
    assert free.area == pytest.approx((30e-6) ** 2)
    assert (free.rows > 0).all()


def test_a_missing_neighbour_hides_a_summit():
    surface = egg_box()
    heights = surface.heights.copy()
    heights[9, 9] = np.nan  # a neighbour of the summit at 8, 8
    found = find_summits(rc.Surface(heights, surface.grid))
    assert found.count == 7
    assert found.area == pytest.approx((32**2 - 9) * 1e-12)


def test_principal_curvatures_of_a_turned_paraboloid():
    """z = -(a u^2 + b v^2)/2 with axes turned by 30 degrees: a and b, exactly, on oblong cells."""
    a, b, turn = 3.0, 0.5, math.radians(30)
    y, x = np.meshgrid(0.2 * np.arange(-4, 5), 0.1 * np.arange(-4, 5), indexing="ij")
    u, v = x * math.cos(turn) + y * math.sin(turn), -x * math.sin(turn) + y * math.cos(turn)
    found = find_summits(rc.Surface(-(a * u**2 + b * v**2) / 2, rc.Grid((9, 9), (0.2, 0.1))))
    assert found.count == 1
    np.testing.assert_allclose(found.curvature, [[a, b]], rtol=1e-10)
    np.testing.assert_allclose(found.mean_curvature, (a + b) / 2, rtol=1e-10)


def test_summits_of_a_random_surface_are_those_of_nayak():
    """Density m4/(6 sqrt3 pi m2) and mean height 4 sqrt(m0/(pi alpha)) (Nayak 1971), variance (1 - .8968/alpha) m0.

    With the shortest wave 16 cells long there are about N = 1900 summits: their number scatters by 1/sqrt(N)
    or less, their mean height by sqrt(m0/N), its square by sqrt(2/N). A point for a maximum errs by 1 to 2 %.
    """
    grid = rc.Grid((512, 512), 1e-6, True)
    law = {"short_cutoff": 16e-6, "rolloff": 40e-6}
    surface = rc.self_affine(grid, 0.8, 1e-6, np.random.default_rng(2), amplitudes="gaussian", **law)
    shape = SelfAffineSpectrum(0.8, **law)
    moments = grid_moments(grid, shape)
    scale = 1e-12 / moments.m0
    m0, m2, m4 = (scale * m for m in (moments.m0, moments.m2, moments.m4))
    alpha = m0 * m4 / m2**2
    found = find_summits(surface)
    assert found.density == pytest.approx(
        m4 / (6 * math.sqrt(3) * math.pi * m2), rel=3 / math.sqrt(found.count) + 0.02
    )
    slack = 3 * math.sqrt(m0 / found.count)
    assert found.height.mean() == pytest.approx(4 * math.sqrt(m0 / (math.pi * alpha)), abs=slack + 0.02e-6)
    expected = (1 - 0.8968 / alpha) * m0
    assert found.height.var() == pytest.approx(expected, rel=4 * math.sqrt(2 / found.count) + 0.05)
    # The mean curvature of all summits, 8/3 sqrt(m4/pi) (1/R in Greenwood and Williamson's model).
    assert found.mean_curvature.mean() == pytest.approx(8 / 3 * math.sqrt(m4 / math.pi), rel=0.05)


def test_what_has_no_neighbours_is_refused():
    with pytest.raises(ValueError, match="3 x 3"):
        find_summits(rc.Surface(np.zeros(9), rc.Grid(9, 1.0)))
    holed = np.zeros((3, 3))
    holed[0, 0] = np.nan
    with pytest.raises(ValueError, match="eight measured"):
        find_summits(rc.Surface(holed, rc.Grid((3, 3), 1.0)))
