"""Spikes: none on self-affine surfaces, clusters of a few cells found to the cell, and what becomes of them."""

import itertools

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.preparation.spikes import _gaps, _limits, _padded, _screened, spikes_in

GRID = rc.Grid((64, 80), 1e-6)


def rough(hurst=0.8, seed=3, shape=GRID.shape):
    return rc.self_affine(rc.Grid(shape, 1e-6), hurst, 1e-7, np.random.default_rng(seed)).heights.copy()


@pytest.mark.parametrize("hurst", [0.0, 0.25, 0.5, 0.75, 1.0])
def test_self_affine_surfaces_have_no_spikes(hurst):
    """Forty maps for each exponent, whole and cut from larger ones: of 200 at most two may have a cell marked.

    None has, and no gap comes within a quarter of the limit.
    """
    largest = 0.0
    for seed, periodic in itertools.product(range(20), (True, False)):
        side = 48 if periodic else 96
        wide = rc.self_affine(
            rc.Grid((side, side), 1.0, periodic=True),
            hurst,
            1.0,
            np.random.default_rng(seed),
            amplitudes="gaussian",
        )
        heights, repeats = wide.heights[:48, :48], (periodic, periodic)
        assert spikes_in(heights, repeats).count == 0
        gaps = _gaps(_padded(heights, repeats), np.argwhere(np.ones(heights.shape, dtype=bool)))
        largest = max(largest, np.abs(gaps).max() / _limits(heights, repeats, np.arange(heights.size))[1])
    assert largest < 0.75


@pytest.mark.parametrize("hurst", [0.0, 0.5, 1.0])
def test_self_affine_lines_have_no_spikes(hurst):
    for seed in range(40):
        heights = rc.self_affine(
            rc.Grid(512, 1.0, periodic=True), hurst, 1.0, np.random.default_rng(seed), amplitudes="gaussian"
        ).heights
        assert spikes_in(heights, (True,)).count == spikes_in(heights[:200], (False,)).count == 0


@pytest.mark.parametrize("tilt", [0.0, 1e-7])
@pytest.mark.parametrize("height", [2e-6, -2e-6])
@pytest.mark.parametrize(
    "cells",
    [
        [(30, 40)],
        [(30, 40), (31, 41)],
        [(30, 40), (30, 41), (31, 40), (31, 41)],
        [(30, 40), (30, 41), (30, 42), (31, 40), (31, 41), (31, 42), (32, 40), (32, 41)],
        [(0, 40), (0, 41)],
        [(63, 79)],
    ],
)
def test_a_cluster_of_a_few_cells_is_found_to_the_cell(cells, height, tilt):
    heights = rough() + tilt * np.arange(80)
    for cell in cells:
        heights[cell] += height
    spikes = rc.find_spikes(rc.Surface(heights, GRID))
    assert spikes.count == 1
    assert sorted(map(tuple, np.argwhere(spikes.mask))) == sorted(cells)
    assert tuple(spikes.places[0]) in cells
    # The cells around lie within the range of the map without it.
    assert abs(spikes.height[0] - height) < np.ptp(rough()) + abs(tilt) * 4


def test_several_are_counted_the_largest_first():
    heights = rough()
    heights[10, 10], heights[10, 70], heights[50:52, 20] = heights[10, 10] + 2e-6, -3e-6, 4e-6
    spikes = rc.find_spikes(rc.Surface(heights, GRID))
    assert str(spikes) == "3 spikes of 4 cells"
    assert spikes.places[:, 1].tolist() == [20, 70, 10]
    assert (np.sign(spikes.height) == [1, -1, 1]).all()


def test_the_flank_of_a_spike_goes_with_it():
    """As an optical instrument leaves it: a column of 4 um on a foot of a fifth of that."""
    heights = rough()
    heights[29:31, 39:42] += 0.8e-6
    heights[30, 40] += 3.2e-6
    spikes = rc.find_spikes(rc.Surface(heights, GRID))
    assert spikes.count == 1
    assert np.array_equal(np.argwhere(spikes.mask).min(axis=0), [29, 39])
    assert spikes.mask.sum() == 6


@pytest.mark.parametrize(
    "part",
    [
        (slice(20, 64), slice(0, 80)),
        (slice(20, 64), slice(30, 80)),
        (slice(20, 25), slice(30, 35)),
        (slice(30, 31), slice(0, 80)),
        (slice(63, 64), slice(0, 80)),
    ],
    ids=["step", "corner", "plateau", "scratch", "last row"],
)
def test_what_is_no_spike(part):
    heights = rough()
    heights[part] += 3e-6
    assert rc.find_spikes(rc.Surface(heights, GRID)).count == 0


def test_rough_surroundings_ask_for_more():
    """A cell that is a spike on the smooth map, but nothing beside heights that are twenty times as rough."""
    heights = rough()
    smooth = heights.copy()
    smooth[30, 40] += 1e-6
    assert rc.find_spikes(rc.Surface(smooth, GRID)).count == 1
    coarse = heights.copy()
    part = (slice(16, 44), slice(26, 54))
    coarse[part] += np.random.default_rng(0).normal(0, 2e-6, (28, 28))
    coarse[30, 40] += 1e-6
    assert rc.find_spikes(rc.Surface(coarse, GRID)).count == 0


def test_exact_plateaus_and_few_points():
    heights = np.zeros((24, 24))
    heights[5, 5] = 1.0
    assert rc.find_spikes(rc.Surface(heights, rc.Grid((24, 24), 1.0))).places.tolist() == [[5, 5]]
    assert rc.find_spikes(rc.Surface(np.zeros((24, 24)), rc.Grid((24, 24), 1.0))).count == 0
    assert rc.find_spikes(rc.Surface(heights[:9, :9], rc.Grid((9, 9), 1.0))).count == 0  # 81 cells
    line = rough(shape=400)
    line[100:102] += 3e-6
    spikes = rc.find_spikes(rc.Surface(line, rc.Grid(400, 1e-6)))
    assert np.flatnonzero(spikes.mask).tolist() == [100, 101]
    assert spikes.places.shape == (1, 1)


@pytest.mark.parametrize("periodic", [(False, False), (True, False)])
def test_gaps_and_screen_are_those_of_a_search_by_hand(periodic):
    heights = np.random.default_rng(5).standard_normal((14, 17)).round(1)
    heights[3, 4:9] = heights[10:, 0] = np.nan
    expected = np.zeros(heights.shape)
    for i, j in np.argwhere(~np.isnan(heights)):
        rows = [r % 14 if periodic[0] else r for r in range(i - 2, i + 3)]
        window = [
            heights[r, c]
            for r, c in itertools.product(rows, range(j - 2, j + 3))
            if 0 <= r < 14 and 0 <= c < 17
        ]
        for sign in (1, -1):
            order = sorted(-sign * h for h in window if not np.isnan(h))
            for k in range(1, (len(order) - 1) // 3 + 1):
                step = order[k] - order[k - 1]
                if -sign * heights[i, j] <= order[k - 1] and step > abs(expected[i, j]):
                    expected[i, j] = sign * step
    cells = np.argwhere(~np.isnan(heights))
    found = _gaps(_padded(heights, periodic), cells)
    np.testing.assert_allclose(np.abs(found), np.abs(expected[tuple(cells.T)]), rtol=0, atol=1e-15)
    for gap in (0.35, 0.55, 0.95):  # between the tenths that differences are
        assert _screened(heights, periodic, gap)[np.abs(expected) > gap].all()


def test_despiked_to_missing_or_filled():
    heights = rough()
    heights[20:23, 20:23] = np.nan
    heights[40, 40:42] += 3e-6
    surface = rc.Surface(heights, GRID, ("made",))
    marked = rc.find_spikes(surface).mask
    assert marked.sum() == 2
    clean, whole = surface.despiked(), surface.despiked("filled")
    assert np.array_equal(clean.heights, np.where(marked, np.nan, heights), equal_nan=True)
    assert clean.provenance == ("made", "despiked: 1 spike of 2 cells set to missing")
    assert np.array_equal(whole.measured, surface.measured)
    assert np.array_equal(whole.heights[~marked], heights[~marked], equal_nan=True)
    around = heights[39:42, 39:43][~marked[39:42, 39:43]]
    assert (around.min() <= whole.heights[marked]).all()
    assert (whole.heights[marked] <= around.max()).all()
    assert whole.provenance[-1] == "despiked: 1 spike of 2 cells filled in, harmonic"
    assert clean.despiked() is clean
    with pytest.raises(ValueError, match="'missing' or 'filled', not 'zero'"):
        surface.despiked("zero")
