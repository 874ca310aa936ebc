"""A force on faults of the measurement is noted, with a remedy after which it is not."""

import re
import warnings

import numpy as np
import pytest

import roughcontact as rc
from measured import NOT_HERE, SURFACES
from roughcontact.contact.notes import fault_notes as faults
from roughcontact.contact.notes.fault_notes import FEW, fault_notes
from roughcontact.labels.note import Rank

GRID = rc.Grid((96, 96), 1e-6, periodic=True)


def rough(hurst=0.8, seed=3):
    return rc.self_affine(GRID, hurst, 1e-7, np.random.default_rng(seed), rolloff=30e-6)


def with_cells(*cells, height=1e-6):
    heights = rough().heights.copy()
    for cell in cells:
        heights[cell] += height
    return rc.Surface(heights, GRID)


def noted(surface, pressure=3e6):
    return list(fault_notes(rc.press(surface, 1e9, pressure=pressure)))


def masked_as_said(surface, note):
    ends = list(
        map(int, re.search(r"masked\(box=\(slice\((\d+), (\d+)\), slice\((\d+), (\d+)", note.text).groups())
    )
    return surface.masked(box=(slice(*ends[:2]), slice(*ends[2:])))


def test_streaks_that_carry_the_force_are_noted_until_they_are_removed():
    streaks = [np.s_[row, 20:60] for row in (10, 40, 70)]
    surface = with_cells(*streaks, np.s_[25, 30:36])
    (note,) = noted(surface)
    assert note.rank is Rank.DOUBTFUL
    assert re.match(
        r"Streaks along scan lines carry \d+% of the force, on \d+ cells: .*Remove them by despiked",
        note.text,
    )
    assert noted(surface.despiked()) == []


@pytest.mark.parametrize(("axis", "turned"), [("rows", False), ("columns", True)])
def test_pieces_that_carry_the_force_are_noted_until_they_are_masked(axis, turned):
    """A piece of ten cells and one of eight show no streak by themselves."""
    surface = with_cells(np.s_[10, 20:30], np.s_[60, 40:48])
    surface = rc.Surface(surface.heights.T, GRID) if turned else surface
    (first,) = noted(surface)
    assert re.match(
        rf"\d+ cells in runs along {axis}, far above the {axis} on both sides, carry \d+%", first.text
    )
    once = masked_as_said(surface, first)
    assert 8 <= once.missing <= 10
    assert all(axis not in note.text for note in noted(once))


def test_a_force_on_few_cells_is_noted_until_they_are_masked():
    """A particle of 5 x 5 cells, which is neither a spike nor a streak."""
    surface = with_cells(np.s_[30:35, 50:55], height=1.5e-6)
    (note,) = noted(surface)
    few, whole = map(
        int, re.match(r"(\d+) of (\d+) cells in contact carry half of the force", note.text).groups()
    )
    assert few < FEW * whole
    pressure = np.sort(rc.press(surface, 1e9, pressure=3e6).pressure, axis=None)[::-1]
    assert pressure[: few - 1].sum() < pressure.sum() / 2 <= pressure[:few].sum() * (1 + 1e-12)
    assert noted(masked_as_said(surface, note)) == []


@pytest.mark.parametrize("pressure", [3e5, 3e6, 3e7])
@pytest.mark.parametrize("hurst", [0.2, 0.8])
def test_rough_surfaces_have_no_such_note(hurst, pressure):
    for seed in range(3):
        assert noted(rough(hurst, seed), pressure) == []
    for name in ("ground", "blasted", "turned"):
        assert noted(rc.examples.surface(name).levelled("plane"), pressure) == []


@pytest.mark.parametrize("power", [1, 2, 8])
def test_smooth_bodies_have_no_such_note(power):
    y, x = (axis - 48e-6 for axis in GRID.coordinates)
    body = rc.Surface(-1e-5 * (np.hypot(y[:, None], x) / 48e-6) ** power, rc.Grid((96, 96), 1e-6))
    assert noted(body, 1e6) == []


def test_rings_and_lines_have_no_such_note():
    rings = rc.RadialGrid.uniform(40, 1e-5)
    ball = rc.RadialProfile(-(rings.radii**2) / 2e-4, rings)
    assert list(fault_notes(rc.press(ball, 1e9, force=1e-4))) == []


@pytest.mark.skipif(SURFACES is None, reason=NOT_HERE)
def test_a_measured_map_is_noted_before_its_streaks_are_removed_and_not_after():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        raw = rc.read(SURFACES / "mi-1.mi", periodic=True)
    (note,) = noted(raw, 1e6)
    assert "Streaks along scan lines carry" in note.text
    assert noted(raw.despiked(), 1e6) == []


@pytest.mark.parametrize(("share", "sought"), [(0.05, False), (0.15, True), (0.3, True)])
def test_streaks_are_sought_if_cells_that_stand_out_carry_a_tenth_of_the_force(monkeypatch, share, sought):
    """Half of what streaks have to carry: an estimate from each cell's neighbours."""
    searched = []

    def standing_out(heights, cells):
        loads = np.cumsum(solution.pressure.ravel()[cells])
        return loads <= share * loads[-1]

    def none(heights):
        searched.append(heights)
        return (np.zeros(heights.shape, bool),) * 3

    solution = rc.press(rough(), 1e9, pressure=3e6)
    monkeypatch.setattr(faults, "stands_out", standing_out)
    monkeypatch.setattr(faults, "streaks_and_pieces", none)
    list(fault_notes(solution))
    assert bool(searched) == sought
