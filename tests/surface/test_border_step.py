"""A periodic map that does not close at its border is found; one that repeats itself is not."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.border_step import OPEN, border_steps, open_border

CELLS = 64
REPEATS = rc.Grid((CELLS, CELLS), 1e-6, periodic=True)


def periodic(heights):
    return rc.Surface(heights, rc.Grid(heights.shape, 1e-6, periodic=True))


@pytest.mark.parametrize("hurst", [0.2, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("short_cutoff", [None, CELLS / 4 * 1e-6])
def test_random_surfaces_that_repeat_themselves_close(hurst, short_cutoff):
    """The border is a pair of rows like any other. With four waves along a side the ratio scatters most, up to 1.8."""
    for seed in range(20):
        surface = rc.self_affine(REPEATS, hurst, 1e-6, seed, short_cutoff=short_cutoff)
        assert max(step.ratio for step in border_steps(surface)) < 2
        assert open_border(surface) is None


@pytest.mark.parametrize("hurst", [0.5, 0.8, 1.0])
def test_a_part_of_a_larger_surface_does_not_close(hurst):
    """Its opposite edges are n cells apart: on average their heights differ up to n^H times as much as neighbours.

    With H = 0.2 this is 2.3, below the limit: such steps are little larger than those inside.
    """
    twice = rc.Grid((2 * CELLS, 2 * CELLS), 1e-6, periodic=True)
    for seed in range(20):
        surface = periodic(rc.self_affine(twice, hurst, 1e-6, seed).heights[:CELLS, :CELLS])
        worst = max(border_steps(surface), key=lambda step: step.ratio)
        assert open_border(surface) == worst
        assert worst.ratio > OPEN


@pytest.mark.parametrize("count", [1, 3, 16])
@pytest.mark.parametrize("shift", [0.0, 0.13, 0.25])
def test_waves_close_wherever_their_border_is(count, shift):
    """The steepest pair of rows of one wave has sqrt(2) times the mean square slope."""
    phase = 2 * np.pi * (count * np.arange(CELLS) / CELLS + shift)
    surface = periodic(np.cos(phase)[:, None] + np.cos(phase))
    for step in border_steps(surface):
        # The border is one of n pairs: the root mean square of the others is less by at most 1/(n - 1).
        assert step.ratio < np.sqrt(2) * (1 + 1 / (CELLS - 1))
    assert open_border(surface) is None


def test_of_many_rows_some_are_compared():
    heights = np.repeat(np.arange(5000.0)[:, np.newaxis], 2, axis=1)
    assert border_steps(periodic(heights))[0] == (4999.0, 4999.0)


def test_the_step_of_a_tilted_map_is_its_tilt():
    """Rows rise by 1 and columns by 0: the border of the rows steps by n - 1."""
    heights = np.repeat(np.arange(8.0), 8).reshape(8, 8)
    rows, columns = border_steps(periodic(heights))
    assert rows == (7.0, 7.0)
    assert columns.height == 0.0
    assert np.isnan(columns.ratio)
    assert open_border(periodic(heights)) == rows
    (singly,) = border_steps(rc.Surface(heights, rc.Grid((8, 8), 1.0, periodic=(False, True))))
    assert singly.height == 0.0
    assert border_steps(rc.Surface(heights, rc.Grid((8, 8), 1.0))) == ()
    line = rc.Surface(np.arange(8.0), rc.Grid((8,), 1.0, periodic=True))
    assert border_steps(line) == ((7.0, 7.0),)


def test_missing_heights_are_left_out_and_rounding_is_no_step():
    heights = np.repeat(np.arange(8.0), 8).reshape(8, 8)
    heights[0, 1:], heights[3, 3] = np.nan, np.nan
    assert border_steps(periodic(heights))[0] == (7.0, 7.0)
    heights[0] = np.nan
    assert np.isnan(border_steps(periodic(heights))[0].ratio)
    assert open_border(periodic(heights)) is None
    equal = np.tile(np.cos(2 * np.pi * np.arange(64) / 64), (64, 1))
    equal[0] += 1e-15
    assert border_steps(periodic(equal))[0].ratio > 0
    assert open_border(periodic(equal)) is None
    assert open_border(periodic(np.ones((8, 8)))) is None
