"""The Gaussian filter against its transmission and against the plain sum."""

import math

import numpy as np
import pytest

import roughcontact as rc

CUTOFF = 8e-6
STEP = (1e-6, 1.5e-6)


def wave(grid, ny, nx, phase=0.3):
    """A wave with whole numbers of periods along y and x."""
    y, x = np.meshgrid(*(np.arange(n) / n for n in grid.shape), indexing="ij")
    return np.cos(2 * np.pi * (ny * y + nx * x) + phase)


def dumb_mean(heights, spacing, periodic, cutoff):
    """The standard's weighted mean, summed point by point over everything there is."""
    ny, nx = heights.shape
    y, x = np.arange(ny) * spacing[0], np.arange(nx) * spacing[1]
    scale = math.sqrt(math.log(2) / math.pi) * cutoff
    mean = np.full(heights.shape, np.nan)
    for i, j in np.argwhere(~np.isnan(heights)):
        weight = np.zeros(heights.shape)
        for ky in (-1, 0, 1) if periodic[0] else (0,):
            for kx in (-1, 0, 1) if periodic[1] else (0,):
                square = (y[:, None] - y[i] + ky * ny * spacing[0]) ** 2 + (
                    x - x[j] + kx * nx * spacing[1]
                ) ** 2
                weight += np.exp(-np.pi * square / scale**2)
        weight[np.isnan(heights)] = 0
        mean[i, j] = np.nansum(weight * heights) / weight.sum()
    return mean


@pytest.mark.parametrize("periodic", [(False, False), (True, False), (True, True)])
@pytest.mark.parametrize("holes", [False, True])
def test_it_is_the_weighted_mean_of_the_standard(periodic, holes):
    heights = np.random.default_rng(0).standard_normal((24, 30))
    if holes:
        heights[3:9, 5:20] = heights[15, 2] = np.nan
    surface = rc.Surface(heights + 7, rc.Grid(heights.shape, STEP, periodic))
    left = surface.filtered(short_cutoff=CUTOFF)
    expected = dumb_mean(heights, STEP, periodic, CUTOFF)
    # On a periodic axis the sampled weights differ from the exact ones by what they transmit beyond the Nyquist wave.
    aliased = sum(
        2 ** -((CUTOFF / (2 * d)) ** 2) for d, repeats in zip(STEP, periodic, strict=True) if repeats
    )
    np.testing.assert_allclose(left.heights - 7, expected, rtol=0, atol=1e-13 + 2 * aliased * 4)
    assert left.missing == surface.missing


@pytest.mark.parametrize(("ny", "nx"), [(0, 0), (3, 0), (0, 8), (5, 7), (24, 30)])
def test_on_a_periodic_grid_every_wave_has_its_transmission(ny, nx):
    grid = rc.Grid((48, 60), STEP, periodic=True)
    surface = rc.Surface(wave(grid, ny, nx) + 2, grid)
    wavenumber = math.hypot(ny / grid.lengths[0], nx / grid.lengths[1])
    transmitted = 2 ** -((CUTOFF * wavenumber) ** 2)
    low = surface.filtered(short_cutoff=CUTOFF)
    high = surface.filtered(long_cutoff=CUTOFF)
    np.testing.assert_allclose(low.heights, transmitted * wave(grid, ny, nx) + 2, rtol=0, atol=1e-14)
    np.testing.assert_allclose(high.heights, (1 - transmitted) * wave(grid, ny, nx), rtol=0, atol=1e-14)


@pytest.mark.parametrize("periodic", [False, True])
def test_half_of_the_wave_at_the_cutoff_is_left(periodic):
    grid = rc.Grid((60, 160), (1e-6, 1e-6), periodic)
    surface = rc.Surface(wave(grid, 0, 10), grid)  # a wave of 16 cells
    left = surface.filtered(short_cutoff=16e-6)
    middle = (
        slice(None),
        slice(40, 120),
    )  # two and a half cut-offs from the edges, beyond the reach of the weights
    # Sampled sixteen times a wave the weights transmit what they should, but for 2^(-15^2).
    np.testing.assert_allclose(left.heights[middle], surface.heights[middle] / 2, rtol=0, atol=1e-14)


def test_a_line_is_filtered_like_a_surface_that_does_not_change_along_y():
    heights = np.random.default_rng(2).standard_normal(50)
    line = rc.Surface(heights, rc.Grid(50, 1e-6)).filtered(short_cutoff=6e-6)
    sheet = rc.Surface(np.tile(heights, (9, 1)), rc.Grid((9, 50), 1e-6)).filtered(short_cutoff=6e-6)
    np.testing.assert_allclose(sheet.heights, np.tile(line.heights, (9, 1)), rtol=0, atol=1e-14)


def test_a_band_is_low_pass_then_high_pass():
    grid = rc.Grid((40, 44), 1e-6)
    surface = rc.Surface(np.random.default_rng(1).standard_normal(grid.shape), grid, ("made",))
    band = surface.filtered(short_cutoff=4e-6, long_cutoff=2e-5)
    steps = surface.filtered(short_cutoff=4e-6).filtered(long_cutoff=2e-5)
    assert np.array_equal(band.heights, steps.heights)
    assert band.provenance == (
        "made",
        "Gaussian filter: waves below 4e-06 m removed",
        "Gaussian filter: waves above 2e-05 m removed",
    )


@pytest.mark.parametrize("offset", [0.0, 1e3])
def test_a_constant_passes_low_and_not_high_with_edges_and_holes(offset):
    heights = np.full((30, 30), offset)
    heights[10:13, 2:25] = np.nan
    surface = rc.Surface(heights, rc.Grid((30, 30), 1e-6))
    np.testing.assert_allclose(surface.filtered(short_cutoff=1e-5).heights, heights, rtol=1e-14)
    high = surface.filtered(long_cutoff=1e-5).heights
    np.testing.assert_allclose(high[~np.isnan(high)], 0, atol=1e-14 * (1 + offset))


@pytest.mark.parametrize(
    ("keywords", "message"),
    [
        ({}, "give short_cutoff"),
        ({"short_cutoff": 2e-5, "long_cutoff": 1e-5}, "must be below"),
        ({"short_cutoff": -1.0}, "positive"),
        ({"long_cutoff": math.inf}, "positive"),
        ({"short_cutoff": 3.9e-6}, "at least 4e-06 m"),
    ],
)
def test_a_cutoff_that_cannot_be_is_refused(keywords, message):
    surface = rc.Surface(np.eye(8), rc.Grid((8, 8), 1e-6))
    with pytest.raises(ValueError, match=message):
        surface.filtered(**keywords)


def test_on_a_periodic_grid_the_cutoff_may_be_two_cells():
    surface = rc.Surface(np.eye(8), rc.Grid((8, 8), 1e-6, periodic=True))
    assert surface.filtered(short_cutoff=2e-6).rms < surface.rms
    with pytest.raises(ValueError, match="at least 2e-06 m"):
        surface.filtered(short_cutoff=1.9e-6)
