"""Cutting, thinning, averaging, turning, tapering."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.preparation.windows import window_values

GRID = rc.Grid((12, 18), (1e-6, 2e-6), (True, False))
HEIGHTS = np.random.default_rng(0).standard_normal(GRID.shape)
SURFACE = rc.Surface(HEIGHTS, GRID, ("made",))


def test_a_crop_keeps_its_cells_and_loses_its_periods():
    part = SURFACE.cropped(slice(2, -1), slice(None, 5))
    assert np.array_equal(part.heights, HEIGHTS[2:-1, :5])
    assert part.grid == rc.Grid((9, 5), GRID.spacing)
    assert part.provenance == ("made", "cropped to cells 2:11, 0:5 of 12 x 18, no longer periodic along y")
    strip = SURFACE.cropped(slice(None), slice(3, 9))
    assert strip.grid.periodic == (True, False)
    assert "periodic" not in strip.provenance[-1]
    both = rc.Surface(HEIGHTS, rc.Grid(GRID.shape, GRID.spacing, periodic=True)).cropped(slice(6), slice(4))
    assert both.provenance[-1].endswith(", no longer periodic along y and x")
    line = rc.Surface(HEIGHTS[0], rc.Grid(18, 1e-6)).cropped(slice(4, 8))
    assert np.array_equal(line.heights, HEIGHTS[0, 4:8])


@pytest.mark.parametrize(
    ("parts", "message"),
    [
        ((slice(2, 5),), "one slice an axis"),
        ((slice(0, 9, 2), slice(None)), "downsampled"),
        ((slice(5, 5), slice(None)), "no cell is left"),
        (
            (slice(20, 30), slice(None)),
            "a crop of cells 20:30 ends beyond the 12 cells of the map: end at 12 at most",
        ),
        ((slice(None), slice(17, 19)), "a crop of cells 17:19 ends beyond the 18 cells of the map"),
        ((slice(-13, None), slice(None)), "a crop of cells -13: ends beyond the 12 cells of the map"),
    ],
)
def test_a_crop_of_nothing_is_refused(parts, message):
    with pytest.raises(ValueError, match=message):
        SURFACE.cropped(*parts)


@pytest.mark.parametrize(
    ("factor", "rows", "columns"),
    [(2, slice(0, 12, 2), slice(0, 18, 2)), ((3, 4), slice(1, 12, 3), slice(1, 16, 4))],
)
def test_thinning_takes_the_middle_of_each_block(factor, rows, columns):
    thin = SURFACE.downsampled(factor, anti_alias=False)
    assert np.array_equal(thin.heights, HEIGHTS[rows, columns])
    ky, kx = (factor, factor) if isinstance(factor, int) else factor
    assert thin.grid == rc.Grid(thin.heights.shape, (ky * 1e-6, kx * 2e-6), GRID.periodic)


@pytest.mark.parametrize("factor", [0, -1, 7, (2, 2, 2), (2, 10), (5, 1)])
def test_a_factor_that_cannot_be_is_refused(factor):
    for method in (SURFACE.downsampled, SURFACE.averaged):
        with pytest.raises(ValueError, match="factor"):
            method(factor)


def sines(count, waves):
    return np.cos(2 * np.pi * waves * np.arange(count) / count)


def test_a_wave_too_short_for_the_new_grid_comes_back_only_without_the_filter():
    count, factor = 240, 6
    waves = count // factor - 3  # it aliases to three waves
    surface = rc.Surface(np.tile(sines(count, waves), (24, 1)), rc.Grid((24, count), 1e-6, periodic=True))
    raw = surface.downsampled((1, factor), anti_alias=False)
    clean = surface.downsampled((1, factor))
    assert raw.rms == pytest.approx(surface.rms, rel=1e-12)
    # The cut-off is two new cells: what is left of this wave of length count/waves is 2^(-(cut-off/length)^2).
    left = 2 ** -((2 * factor * waves / count) ** 2)
    assert clean.rms == pytest.approx(left * surface.rms, rel=1e-10)


def test_thinning_one_axis_leaves_the_other_alone():
    ridges = rc.Surface(np.tile(sines(16, 8)[:, None], (1, 40)), rc.Grid((16, 40), 1e-6))
    thin = ridges.downsampled((1, 4))
    np.testing.assert_allclose(thin.heights, np.tile(sines(16, 8)[:, None], (1, 10)), rtol=0, atol=1e-14)


@pytest.mark.parametrize("waves", [1, 7, 30])
def test_a_pixel_averages_a_wave_as_its_sinc(waves):
    count, k = 120, 5
    surface = rc.Surface(np.tile(sines(count, waves), (10, 1)), rc.Grid((10, count), 1e-6, periodic=True))
    seen = surface.averaged((2, k))
    middle = np.arange(k // 2, count, k)
    angle = np.pi * waves / count
    factor = math.sin(k * angle) / (k * math.sin(angle))
    expected = factor * np.cos(2 * np.pi * waves * middle / count)
    np.testing.assert_allclose(seen.heights, np.tile(expected, (5, 1)), rtol=0, atol=1e-13)
    assert seen.grid == rc.Grid((5, 24), (2 * 1e-6, 5 * 1e-6), periodic=True)


def test_a_pixel_half_measured_counts_and_one_less_so_does_not():
    heights = np.arange(16.0).reshape(4, 4)
    heights[0, :2] = heights[2:, 2] = heights[2, 3] = np.nan
    seen = rc.Surface(heights, rc.Grid((4, 4), 1e-6)).averaged(2)
    assert seen.heights[0, 0] == (4 + 5) / 2
    assert np.isnan(seen.heights[1, 1])
    assert seen.heights[1, 0] == (8 + 9 + 12 + 13) / 4


def test_cells_that_fill_no_pixel_are_left_out():
    seen = rc.Surface(HEIGHTS, rc.Grid((12, 18), 1e-6)).averaged(5)
    assert seen.grid.shape == (2, 3)
    np.testing.assert_allclose(seen.heights[1, 2], HEIGHTS[5:10, 10:15].mean(), rtol=1e-14)


def test_turning_and_mirroring():
    turned = SURFACE.rotated()
    # What was on the right is on top.
    assert np.array_equal(turned.heights[0], HEIGHTS[:, -1])
    assert turned.grid == rc.Grid((18, 12), (2e-6, 1e-6), (False, True))
    assert np.array_equal(SURFACE.rotated(4).heights, HEIGHTS)
    assert SURFACE.rotated(-2).grid == GRID
    assert np.array_equal(SURFACE.flipped("y").heights, HEIGHTS[::-1])
    assert np.array_equal(SURFACE.flipped("x").heights, HEIGHTS[:, ::-1])
    assert np.array_equal(SURFACE.transposed().heights, HEIGHTS.T)
    assert SURFACE.transposed().grid == turned.grid
    assert np.array_equal(SURFACE.transposed().flipped("y").heights, turned.heights)
    assert turned.provenance == ("made", "rotated by 90 degrees counter-clockwise")


def test_a_line_cannot_be_turned():
    line = rc.Surface(HEIGHTS[0], rc.Grid(18, 1e-6))
    assert np.array_equal(line.flipped("x").heights, HEIGHTS[0, ::-1])
    with pytest.raises(ValueError, match="turned"):
        line.rotated()
    with pytest.raises(ValueError, match="axis must be"):
        line.flipped("y")
    with pytest.raises(ValueError, match="axis must be"):
        SURFACE.flipped("z")


@pytest.mark.parametrize(
    ("window", "share", "power"),
    # Mean squares of sin^2, of 1 - t^2 on [-1, 1], and of a share of sin^2 beside ones.
    [("hann", 0.25, 3 / 8), ("welch", 0.25, 8 / 15), ("tukey", 0.4, 0.6 + 0.4 * 3 / 8), ("tukey", 0, 1.0)],
)
def test_windows_have_their_known_mean_square(window, share, power):
    weights = window_values(window, 2000, share)
    # The midpoint rule of these windows, whose slopes are bounded by 2 pi / 0.4 times 2000 cells.
    assert float((weights**2).mean()) == pytest.approx(power, abs=1e-5)
    np.testing.assert_allclose(weights, weights[::-1], atol=1e-12)
    assert weights.max() <= 1


def test_only_free_axes_are_tapered():
    heights = SURFACE.tapered().heights
    np.testing.assert_allclose(heights, (HEIGHTS - HEIGHTS.mean()) * window_values("hann", 18), rtol=1e-14)
    assert SURFACE.tapered().provenance[-1] == "hann window, mean square times 0.375"
    with pytest.raises(ValueError, match="window must be"):
        SURFACE.tapered("bell")
    with pytest.raises(ValueError, match="share"):
        SURFACE.tapered("tukey", share=1.5)


@pytest.mark.parametrize("method", ["averaged", "downsampled"])
def test_cells_that_fill_no_block_are_named(method):
    free = rc.Surface(HEIGHTS, rc.Grid(HEIGHTS.shape, 1e-6))
    assert getattr(free, method)((5, 3)).provenance[-1].endswith("; the last 2 of 12 rows are left out")
    assert getattr(free, method)((5, 4)).provenance[-1].endswith("rows and 2 of 18 columns are left out")
    assert "left out" not in getattr(free, method)(3).provenance[-1]
    line = rc.Surface(HEIGHTS[0], rc.Grid(18, 1e-6))
    assert getattr(line, method)(4).provenance[-1].endswith("; the last 2 of 18 cells are left out")
