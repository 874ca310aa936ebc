"""Which notes an answer has, and in which order."""

from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.contact.notes.solution_notes import EDGE, notes_on
from roughcontact.labels.note import Note, Rank, in_order


def ball(beside, cells=96):
    """Return a sphere of unit radius over a unit square, its axis at a distance from the edge x = 0."""
    grid = rc.Grid((cells, cells), 1 / cells)
    y, x = grid.coordinates
    return rc.Surface(-((y[:, None] - 0.5) ** 2 + (x - beside) ** 2) / 2, grid)


@pytest.mark.parametrize(("part", "told"), [(0.1, False), (0.25, True)])
def test_the_edge_is_told_where_its_cells_carry_a_hundredth_of_the_force(part, told):
    """The outermost cells lie over Hertz's contact from x = 1 - part to 1 radius, and carry (3 part^2 - part^3)/4."""
    radius, cell = 8 / 96, 1 / 96
    force = 4 / 3 * radius**3
    solution = rc.press(ball(radius * (1 - part) + cell), 1.0, force=force)
    share = (3 * part**2 - part**3) / 4
    # On eight cells a radius the staircase of the border moves it by up to a quarter of a cell.
    low, high = ((3 * p**2 - p**3) / 4 for p in (part - 0.25 * cell / radius, part + 0.25 * cell / radius))
    assert low < solution.edge_share < high
    assert (share > EDGE) == told
    assert solution.touches_edge
    edge = [note for note in solution.notes if "at the edge of the map" in note]
    assert len(edge) == told
    assert all(f"carry {100 * solution.edge_share:.0f} % of the force" in note for note in edge)


def test_the_share_of_the_edge_counts_each_of_its_cells_once():
    for grid, operator, share in (
        (rc.Grid((4, 5), 1.0), None, 14 / 20),
        (rc.Grid((4, 5), 1.0, periodic=(True, False)), None, 8 / 20),
        (rc.Grid((4, 5), 1.0, periodic=True), None, 0.0),
        (rc.Grid((1, 5), 1.0), None, 1.0),
        (rc.Grid(8, 1.0), rc.foundation(rc.Grid(8, 1.0), 1.0), 2 / 8),
    ):
        surface = rc.Surface(np.zeros(grid.shape), grid)
        flat = rc.press(surface, 1.0, force=1e-3, operator=operator)
        even = replace(flat, pressure=np.full(grid.shape, 2.0))
        assert even.edge_share == pytest.approx(share, rel=1e-14), grid
        assert even.touches_edge == (share > 0)
        assert replace(flat, pressure=np.zeros(grid.shape)).edge_share == 0.0
    rings = rc.RadialGrid.uniform(4, 1.0)
    pressed = rc.press(rc.RadialProfile(-(rings.radii**2), rings), 1.0, force=1e-3)
    even = replace(pressed, pressure=np.ones(4))
    assert even.edge_share == pytest.approx(7 / 16, rel=1e-14)  # 4^2 - 3^2 of 4^2


def test_what_makes_a_number_wrong_comes_first_and_the_edge_last():
    """One cell in the corner, beside missing ones, under a pressure of the modulus, far above all others."""
    heights = np.zeros((16, 16))
    heights[0, 0], heights[5, 5:7] = 1.0, np.nan
    solution = rc.press(rc.Surface(heights, rc.Grid((16, 16), 1.0)), 1.0, force=0.9)
    words = (
        "A single cell",
        "largest pressure",
        "1 point stands more than 8 rms heights",
        "2 cells hold no height",
        "the edge",
    )
    assert len(solution.notes) == len(words)
    assert all(word in note for word, note in zip(words, solution.notes, strict=True)), solution.notes
    assert solution.to_record()["notes"] == list(solution.notes)
    ranks = sorted(note.rank for note in notes_on(solution))
    assert ranks == [Rank.WRONG, Rank.DOUBTFUL, Rank.DOUBTFUL, Rank.USUAL, Rank.USUAL]


def test_a_periodic_map_that_does_not_close_is_doubtful():
    """Heights that rise by 1e-3 a row step back by 15e-3 at the border; as a free map they have no border to close."""
    heights = np.repeat(1e-3 * np.arange(16.0), 16).reshape(16, 16)
    found = {}
    for repeats in (True, False):
        solution = rc.press(rc.Surface(heights, rc.Grid((16, 16), 1.0, periodic=repeats)), 1.0, force=0.1)
        found[repeats] = [note for note in notes_on(solution) if "does not close" in note.text]
    assert found[False] == []
    (note,) = found[True]
    assert note.rank == Rank.DOUBTFUL
    assert "heights step by 15 mm from one edge to the opposite one, 15 times as much" in note.text


def test_limits_of_pressure_and_depth():
    """A flat map of 4 x 5 cells of unit area, on which pressures and depths are put by hand."""
    grid = rc.Grid((4, 5), 1.0)
    flat = rc.press(rc.Surface(np.zeros(grid.shape), grid), ("steel", "aluminium"), force=1e6)

    def told(words, cells=0, pressure=0.0, **changed):
        loaded = np.where(np.arange(20) < cells, pressure, 1e5).reshape(4, 5)
        return any(words in note for note in replace(flat, pressure=loaded, **changed).notes)

    hardness, modulus = flat.problem.softer.hardness, flat.problem.modulus
    for cells, share in ((0, None), (3, None), (4, 20), (5, 25), (20, 100)):
        found = told("exceeds the hardness of aluminium", cells, 1.1 * hardness)
        assert (
            found == told(f"On {share} % of the contact area", cells, 1.1 * hardness) == (share is not None)
        )
        assert told("the largest pressure is 1.1 times the hardness", cells, 1.1 * hardness) == found
    assert not told("exceeds the hardness", 20, 0.9 * hardness)
    for part in (0.4, 0.6):
        assert told("times the reduced modulus", 1, part * modulus) == (part > 0.5)
    for depth in (4.5, 5.5):
        assert told("is larger than the side of the map, 5 m", depth=depth) == (depth > 5)


def test_notes_are_ordered_by_rank_then_as_they_are_made_and_stand_once():
    made = [Note(Rank.USUAL, "d"), Note(Rank.LIMITED, "b"), Note(Rank.WRONG, "a"), Note(Rank.LIMITED, "c")]
    assert in_order([*made, *made]) == ("a", "b", "c", "d")
    assert in_order(()) == ()


def test_a_stiffness_that_differs_on_loading_is_noted_with_the_number_of_cells():
    """One cell is raised by its gap, then a second one too: at the same depth they touch without pressure."""
    grid = rc.Grid((8, 9), 1e-6)
    heights = 1e-7 * np.random.default_rng(2).random(grid.shape)
    pressed = rc.press(rc.Surface(heights, grid), 1e9, depth=2e-8)
    open_cells = np.flatnonzero(pressed.gap > 0)
    nearest = open_cells[np.argsort(pressed.gap.flat[open_cells])]
    for number, words in ((1, "1 cell touches without pressure"), (2, "2 cells touch without pressure")):
        raised = heights.copy()
        raised.flat[nearest[:number]] += pressed.gap.flat[nearest[:number]]
        solution = rc.press(rc.Surface(raised, grid), 1e9, depth=2e-8 + raised.max() - heights.max())
        assert np.count_nonzero(solution.touching) == number
        [note] = [note for note in notes_on(solution) if "touch" in note.text and "without" in note.text]
        assert note.text.startswith(f"{words}: the stiffness is ")
