"""Despiking ends with a surface that has no spikes, and its provenance says what became of every cell."""

import re
import warnings

import numpy as np
import pytest

import roughcontact as rc
from measured import NOT_HERE, SURFACES

GRID = rc.Grid((64, 80), 1e-6)
BOTH = pytest.mark.parametrize("to", ["missing", "filled"])


def rough():
    return rc.self_affine(GRID, 0.8, 1e-7, np.random.default_rng(3)).heights.copy()


def rimmed():
    """Return a map with a hole of missing points, wrong heights at its rim and lone ones within, as optics leave it."""
    heights = rough()
    hole = np.zeros(heights.shape, dtype=bool)
    hole[15:50, 20:70] = True
    heights[hole] = np.nan
    heights[20:48:5, 23:68:5] = -70e-6  # alone: windows of one measured cell have no spikes
    heights[15, 30:60:8] = -70e-6  # at the rim
    heights[5, 5] += 5e-6
    return heights


def cells_in(line):
    """Return the numbers of cells that the provenance says were taken, filled in and set to missing."""
    taken = sum(int(count) for count in re.findall(r"of (\d+) cells?", line))
    filled = re.search(r"(\d+) filled in", line)
    missing = re.search(r"(\d+) set to missing", line)
    return taken, int(filled[1]) if filled else None, int(missing[1]) if missing else None


@BOTH
@pytest.mark.parametrize("make", [rimmed, rough])
def test_one_call_ends_clean(make, to):
    surface = rc.Surface(make(), GRID)
    clean = surface.despiked(to)
    assert (clean is surface) == (make is rough)
    assert rc.find_spikes(clean).count == 0
    assert clean.despiked(to) is clean


def test_cells_beside_a_hole_are_set_to_missing_and_said():
    """Filled from the hole's lone heights, 70 um too low, they would stand out as before."""
    surface = rc.Surface(rimmed(), GRID)
    clean = surface.despiked("filled")
    taken, filled, missing = cells_in(clean.provenance[-1])
    assert clean.provenance[-1].endswith("because the heights around them are also missing or faulty")
    assert (taken, filled, missing) == (5, 1, 4)
    assert missing == clean.missing - surface.missing


def test_a_streak_is_filled_in_from_both_sides():
    heights, streak = rough(), np.zeros(GRID.shape, dtype=bool)
    streak[30, 20:60] = True
    clean = rc.Surface(heights + 2e-6 * streak, GRID).despiked("filled")
    assert clean.provenance[-1] == "despiked: 1 streak of 40 cells filled in, harmonic"
    np.testing.assert_array_equal(clean.heights[~streak], heights[~streak])
    around = heights[[29, 31]][:, 19:61]  # a harmonic function lies between its values at the border
    assert around.min() <= clean.heights[streak].min() <= clean.heights[streak].max() <= around.max()


def test_what_is_left_is_said(monkeypatch):
    """After a single pass, which fills the cells at the rim as wrongly as they were."""
    monkeypatch.setattr("roughcontact.surface.preparation.despike._PASSES", 1)
    once = rc.Surface(rimmed(), GRID).despiked("filled")
    left = rc.find_spikes(once).count
    assert left > 0
    assert f"; {left} more are left after 1 passes" in once.provenance[-1]


@pytest.mark.skipif(SURFACES is None, reason=NOT_HERE)
@pytest.mark.parametrize(
    ("name", "to"),
    [
        ("frt-2.frt", "missing"),
        ("frt-2.frt", "filled"),
        ("derived_frt2_masked.gwy", "filled"),
        ("sur-2.sur", "filled"),
    ],
)
def test_measured_maps_end_clean(name, to):
    """A single pass left 32, 15 and 3 spikes, each time anew."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        surface = rc.read(SURFACES / name)
    clean = surface.despiked(to)
    assert rc.find_spikes(clean).count == 0
    taken, filled, missing = cells_in(clean.provenance[-1])
    lost = clean.missing - surface.missing
    assert lost == (taken if to == "missing" else missing or 0)
    if missing is not None:
        assert taken == filled + missing


@pytest.mark.parametrize(("height", "searches"), [(0.0, 1), (5e-6, 2)])
def test_warnings_search_a_map_once_and_once_more_what_is_left_of_a_spiky_one(monkeypatch, height, searches):
    from roughcontact.plot import preparation_warnings as warnings_of
    from roughcontact.surface.preparation import despike

    searched, heights = [], rough()
    heights[5, 5] += height
    for module in (warnings_of, despike):
        monkeypatch.setattr(
            module, "find_spikes", lambda surface: searched.append(surface) or rc.find_spikes(surface)
        )
    spikes, found = warnings_of.preparation_warnings(rc.Surface(heights, GRID))
    assert len(searched) == searches
    assert spikes.count == searches - 1 == sum(each.kind == "spikes" for each in found)
