"""Streaks along scan lines: found to the cell, and nothing that is as long but no streak."""

import itertools
import warnings

import numpy as np
import pytest

import roughcontact as rc
from measured import NOT_HERE, SURFACES
from roughcontact.surface.preparation.streaks import LONG, pieces_along_rows, streaks_in, tail_of

GRID = rc.Grid((64, 80), 1e-6)
HIGH = 2e-6  # twenty rms heights, of which the steps between lines are a part


def rough(seed=3, hurst=0.8):
    return rc.self_affine(GRID, hurst, 1e-7, np.random.default_rng(seed)).heights.copy()


def raised(rows, columns, height=HIGH):
    heights = rough()
    heights[rows, columns] += height
    return heights


@pytest.mark.parametrize("height", [HIGH, -HIGH])
@pytest.mark.parametrize("width", [1, 2, 3, 4])
@pytest.mark.parametrize("length", [16, 40])
def test_a_streak_is_found_to_the_cell_along_rows_and_columns(width, length, height):
    heights = raised(slice(30, 30 + width), slice(20, 20 + length), height)
    expected = np.zeros(heights.shape, dtype=bool)
    expected[30 : 30 + width, 20 : 20 + length] = True
    np.testing.assert_array_equal(streaks_in(heights), expected)
    np.testing.assert_array_equal(streaks_in(heights.T), expected.T)


@pytest.mark.parametrize(
    ("rows", "columns"),
    [
        (slice(30, 31), slice(20, 35)),
        (slice(30, 35), slice(20, 60)),
        (slice(30, 31), slice(0, 80)),
        (slice(30, 64), slice(0, 40)),
        (slice(0, 1), slice(0, 40)),
    ],
    ids=["fifteen cells", "five lines", "a whole line", "step", "the first line, of which one side is known"],
)
def test_what_is_no_streak(rows, columns):
    assert not streaks_in(raised(rows, columns)).any()


def with_pieces(lengths, streak=0):
    """Return a rough map with pieces of these lengths on every fifth row, from row 3, and the cells of them all."""
    cells = np.zeros(GRID.shape, dtype=bool)
    for place, length in enumerate([*lengths, *[streak] * bool(streak)]):
        cells[3 + 5 * place, 20 : 20 + length] = True
    return rough() + HIGH * cells, cells


def test_pieces_of_streaks_are_found_to_the_cell_on_a_map_with_a_streak():
    heights, cells = with_pieces((3, 5, 9, 15), streak=16)
    np.testing.assert_array_equal(streaks_in(heights), cells)
    np.testing.assert_array_equal(streaks_in(-heights.T), cells.T)
    assert not streaks_in(with_pieces((3, 5, 9, 15 - 1))[0]).any()  # 31 cells, and no streak
    heights, cells = with_pieces((2,), streak=16)
    assert streaks_in(heights).sum() == 16  # two cells are no piece


def test_many_pieces_along_one_axis_show_streaks_by_themselves():
    """As on a map of which parts of the streaks were masked before."""
    heights, cells = with_pieces((3, 5, 9, 15))
    np.testing.assert_array_equal(streaks_in(heights), cells)
    crossed = heights.copy()
    crossed[50:54, 60] += HIGH  # along the other axis, four cells: more than a tenth
    assert not streaks_in(crossed).any()
    assert pieces_along_rows(crossed.T).sum() == 4


def test_plateaus_have_no_pieces():
    heights = np.zeros(GRID.shape)
    heights[10, 10:30] = HIGH
    assert not pieces_along_rows(heights).any()
    assert pieces_along_rows(heights + 0.01 * rough()).sum() == 20


@pytest.mark.parametrize("along", [False, True])
def test_made_surfaces_have_no_pieces(along):
    """Without noise of an instrument a step is below the limit even on a ground surface along or across its lay."""
    made = [rc.examples.surface(name).heights for name in ("ground", "blasted", "turned")]
    for seed, hurst, stretch in itertools.product(range(4), (0.0, 0.5, 1.0), (1.0, 4.0, 12.0)):
        lay = {"anisotropy": (stretch, 0.0), "rolloff": 30e-6} if stretch > 1 else {}
        made.append(rc.self_affine(GRID, hurst, 1e-7, np.random.default_rng(seed), **lay).heights)
    assert not any(pieces_along_rows(each.T if along else each).any() for each in made)


@pytest.mark.parametrize("hurst", [0.0, 0.5, 1.0])
def test_self_affine_maps_have_none(hurst):
    """A run of 16 cells above both neighbours is rarer than 3^-16 a cell on a rough map, even without a limit."""
    assert not any(streaks_in(rough(seed, hurst)).any() for seed in range(20))


@pytest.mark.parametrize("period", [2, 4, 8])
def test_a_lay_along_the_lines_has_none(period):
    """Ridges as wide as streaks, on every line: their steps are most of the steps, and below the limit of the tail."""
    y, x = np.mgrid[:64, :80]
    heights = 1e-6 * (y % period < period // 2) * (x > 5) * (x < 60) + rough()
    assert not streaks_in(heights).any()


def test_missing_points_flat_maps_and_profiles_have_none():
    heights = raised(slice(30, 31), slice(20, 60))
    heights[29, :] = np.nan  # one side is not known
    assert not streaks_in(heights).any()
    assert not streaks_in(np.zeros((32, 32))).any()
    assert not streaks_in(rough()[0]).any()
    assert not streaks_in(raised(30, slice(20, 60))[28:33, :24]).any()  # 96 steps are too few


def test_the_tail_is_that_of_an_exponential_distribution():
    """Of n exponential sizes of mean 1 the limit is ln(1000 n): it is exceeded by 1/1000 of one of them on average."""
    sizes = -np.log1p(-(np.arange(100_000) + 0.5) / 100_000)
    most, limit = tail_of(sizes, sizes.size)
    assert most == pytest.approx(np.log(10), rel=1e-4)
    assert limit == pytest.approx(np.log(1000 * sizes.size), rel=1e-4)


def test_streaks_and_spikes_are_counted_apart():
    heights = raised(slice(30, 32), slice(20, 60))
    heights[10, 10] -= 3 * HIGH
    spikes = rc.find_spikes(rc.Surface(heights, GRID))
    assert str(spikes) == "1 spike of 1 cell and 1 streak of 80 cells"
    assert (spikes.cells.tolist(), spikes.streak.tolist()) == ([1, 80], [False, True])
    assert str(rc.find_spikes(rc.Surface(raised(30, slice(20, 60)), GRID))) == "1 streak of 40 cells"
    assert str(rc.find_spikes(rc.Surface(rough(), GRID))) == "0 spikes of 0 cells"


@pytest.mark.skipif(SURFACES is None, reason=NOT_HERE)
def test_streaks_of_a_measured_map_lie_along_its_scan_lines():
    """Scars of an AFM tip, which `derived_mi1.mat` shows as well."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        surface = rc.read(SURFACES / "mi-1.mi")
    spikes = rc.find_spikes(surface)
    rows, columns = np.nonzero(spikes.mask)
    assert str(spikes) == "9 spikes of 75 cells and 7 streaks of 336 cells"
    assert LONG < 3 * len(set(rows)) < len(set(columns))
    clean = surface.despiked("filled")
    assert rc.find_spikes(clean).count == 0
    assert clean.missing < 20 < spikes.mask.sum()  # cells beside others that are faulty
