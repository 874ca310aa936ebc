"""Random numbers in a few rows of a map are noticed; rough maps, rough patches and lone rows are none."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.files.noisy_rows import noisy_rows

RNG = np.random.default_rng(3)
MAP = rc.self_affine(rc.Grid((96, 128), 1e-6), 0.8, 0.1, np.random.default_rng(1)).heights
RANGE = np.ptp(MAP)


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("rows", [2, 10, 40])
def test_random_numbers_in_some_rows(rows, turned):
    heights = MAP.copy()
    heights[20 : 20 + rows] = RNG.uniform(-RANGE / 2, RANGE / 2, (rows, 128))
    heights[30, 3:9] = np.nan
    assert noisy_rows(heights.T if turned else heights) == rows


def test_a_lone_row_is_not_enough():
    """A line in which the tip lost the surface is no damage of the file."""
    heights = MAP.copy()
    heights[20] = RNG.uniform(-RANGE / 2, RANGE / 2, 128)
    assert noisy_rows(heights) == 0


@pytest.mark.parametrize("hurst", [0.05, 0.5, 0.95])
def test_self_affine_maps_are_not_warned_of(hurst):
    for seed in range(20):
        surface = rc.self_affine(rc.Grid((64, 96), 1e-6), hurst, 0.1, np.random.default_rng(seed))
        assert noisy_rows(surface.heights) == 0


def test_maps_that_are_noise_throughout_have_no_row_rougher_than_the_others():
    assert noisy_rows(RNG.standard_normal((64, 64))) == 0


def test_spikes_and_a_rough_patch_are_no_noise():
    heights = MAP.copy()
    heights[20:40, 7::20] += 5 * RANGE  # their neighbours are related all the same
    assert noisy_rows(heights) == 0
    waves = MAP.copy()
    waves[20:40] += RANGE * np.sin(np.arange(128) * 2 * np.pi / 16)
    assert noisy_rows(waves) == 0


def test_what_is_no_map_or_too_narrow_is_not_looked_at():
    assert noisy_rows(RNG.standard_normal(500)) == 0
    assert noisy_rows(RNG.standard_normal((20, 30))) == 0
    assert noisy_rows(np.full((40, 40), np.nan)) == 0


def test_a_file_with_such_rows_is_warned_of(put, npy):
    heights = MAP.copy()
    heights[20:30] = RNG.uniform(-RANGE / 2, RANGE / 2, (10, 128))
    with pytest.warns(rc.SurfaceWarning, match="in 10 rows or columns .*as random numbers are"):
        rc.read(put("a.npy", npy(heights)), unit="um", size=1e-4)
