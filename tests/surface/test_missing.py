"""Missing points filled in."""

import numpy as np
import pytest

import roughcontact as rc

GRID = rc.Grid((20, 26), (1e-6, 2e-6))
Y, X = np.meshgrid(*(np.arange(n) * d for n, d in zip(GRID.shape, GRID.spacing, strict=True)), indexing="ij")


def with_holes(heights, *, edges=False):
    holed = heights.copy()
    holed[4:9, 6:15] = holed[12, 3] = holed[14:17, 18:20] = np.nan
    if edges:
        holed[:3, 20:] = holed[18:, :4] = np.nan
    return holed


@pytest.mark.parametrize("truth", [2 + 3e5 * X - 1e5 * Y, X * Y / 1e-12, (X**2 - Y**2) / 1e-12])
def test_what_solves_the_laplace_equation_is_filled_in_exactly(truth):
    """The five-point formula is exact for polynomials up to the third degree, on cells of any shape."""
    filled = rc.Surface(with_holes(truth), GRID).filled()
    np.testing.assert_allclose(filled.heights, truth, rtol=0, atol=1e-12 * np.abs(truth).max())
    assert filled.missing == 0
    assert filled.provenance == ("52 missing points filled in, harmonic",)


@pytest.mark.parametrize("periodic", [False, True, (True, False)])
def test_filled_heights_are_means_of_their_neighbours_and_measured_ones_stay(periodic):
    truth = np.random.default_rng(0).standard_normal(GRID.shape)
    holed = with_holes(truth, edges=True)
    surface = rc.Surface(holed, rc.Grid(GRID.shape, GRID.spacing, periodic))
    filled = surface.filled().heights
    assert np.array_equal(filled[surface.measured], holed[surface.measured])
    repeats = surface.grid.periodic
    for i, j in np.argwhere(np.isnan(holed)):
        weights, total = 0.0, 0.0
        for di, dj, weight in ((1, 0, 4.0), (-1, 0, 4.0), (0, 1, 1.0), (0, -1, 1.0)):
            a, b = i + di, j + dj
            if (0 <= a < 20 or repeats[0]) and (0 <= b < 26 or repeats[1]):
                weights, total = weights + weight, total + weight * filled[a % 20, b % 26]
        assert filled[i, j] == pytest.approx(total / weights, abs=1e-13)
    assert filled.max() <= np.nanmax(holed)
    assert filled.min() >= np.nanmin(holed)


@pytest.mark.parametrize("periodic", [False, True])
def test_the_nearest_height_is_that_of_the_nearest_point(periodic):
    truth = np.random.default_rng(1).standard_normal(GRID.shape)
    holed = with_holes(truth, edges=True)
    filled = rc.Surface(holed, rc.Grid(GRID.shape, GRID.spacing, periodic)).filled("nearest").heights
    known = np.argwhere(~np.isnan(holed))
    for i, j in np.argwhere(np.isnan(holed)):
        away = np.abs(known - [i, j])
        if periodic:
            away = np.minimum(away, np.array(GRID.shape) - away)
        distance = np.hypot(away[:, 0] * 1.0, away[:, 1] * 2.0)
        ties = known[distance <= distance.min() + 1e-9]
        assert filled[i, j] in holed[ties[:, 0], ties[:, 1]]


def test_a_line_is_filled_straight():
    line = rc.Surface([np.nan, 1.0, np.nan, np.nan, 4.0, np.nan], rc.Grid(6, 1e-6))
    np.testing.assert_allclose(line.filled().heights, [1, 1, 2, 3, 4, 4], rtol=1e-14)
    ring = rc.Surface(line.heights, rc.Grid(6, 1e-6, periodic=True))
    np.testing.assert_allclose(ring.filled().heights, [2, 1, 2, 3, 4, 3], rtol=1e-14)


def test_a_whole_surface_is_left_as_it_is():
    surface = rc.Surface(np.eye(3), rc.Grid((3, 3), 1e-6))
    assert surface.filled() is surface
    with pytest.raises(ValueError, match="method must be"):
        surface.filled("linear")
