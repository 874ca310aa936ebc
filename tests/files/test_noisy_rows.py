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


def with_rows(heights, rows, rougher):
    """Return a map with rows whose mean steps are so many times those of a typical row."""
    heights, rows = heights.copy(), np.atleast_2d(rows)
    typical = np.median(np.abs(np.diff(heights, axis=1)).mean(axis=1))
    own = np.abs(np.diff(rows, axis=1)).mean(axis=1, keepdims=True)
    heights[20 : 20 + len(rows)] = rows * (rougher * typical / own)
    return heights


@pytest.mark.parametrize(("rougher", "found"), [(3.8, 0), (4.2, 2), (6.0, 2)])
def test_only_rows_four_times_as_rough_as_the_others_are_damaged(rougher, found):
    """Two rows of 96 change the median of all by a rank or two."""
    rows = np.random.default_rng(6).uniform(-1, 1, (2, 128))
    assert noisy_rows(with_rows(MAP, rows, rougher)) == found


@pytest.mark.parametrize(("changes", "found"), [(47, 2), (46, 0), (80, 2), (81, 0)])
def test_unrelated_neighbours_are_on_one_side_as_often_as_on_both_within_three_deviations(changes, found):
    """Of 127 pairs 127 - 2 n more lie on one side than on both, if n change it; three deviations are 33.8 pairs."""
    runs = changes + 1
    lengths = np.zeros(runs, int)
    for side in (0, 1):  # 64 points above and 64 below, so that the median lies between
        lengths[side::2] = [len(part) for part in np.array_split(np.arange(64), len(lengths[side::2]))]
    row = np.repeat((-1.0) ** np.arange(runs), lengths) * np.random.default_rng(7).uniform(1, 2, 128)
    assert np.count_nonzero(np.diff(np.sign(row))) == changes
    assert noisy_rows(with_rows(MAP, [row, row], 10)) == found


@pytest.mark.parametrize(("missing", "found"), [(0, 2), (94, 2), (96, 0)])
def test_rows_need_32_pairs_of_neighbours(missing, found):
    """Of 128 points with 95 missing ones at an end 33 are left, and 32 pairs."""
    heights = with_rows(MAP, np.random.default_rng(6).uniform(-1, 1, (2, 128)), 10)
    heights[20:22, :missing] = np.nan
    assert noisy_rows(heights) == found
    assert noisy_rows(with_rows(MAP[:, :33], np.random.default_rng(6).uniform(-1, 1, (2, 33)), 10)) == 2
