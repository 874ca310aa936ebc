"""Half as many cells over the same sides."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.preparation.halving import halved


def rough(shape, *, periodic=False):
    grid = rc.Grid(shape, (1e-6, 2e-6), periodic=periodic)
    return rc.Surface(1e-7 * np.random.default_rng(3).standard_normal(shape) + 1e-3, grid)


def by_repetition(heights, shape):
    """Return means over new cells, of an array in which each cell stands as often as there are new ones."""
    for axis, new in enumerate(shape):
        old = heights.shape[axis]
        repeated = np.moveaxis(np.repeat(heights, new, axis=axis), axis, 0)
        parts = repeated.reshape(new, old, *repeated.shape[1:])
        heights = np.moveaxis(parts.mean(axis=1), 0, axis)
    return heights


@pytest.mark.parametrize("shape", [(8, 12), (7, 12), (9, 5)])
@pytest.mark.parametrize("periodic", [False, True])
def test_new_cells_are_means_over_the_same_sides(shape, periodic):
    surface = rough(shape, periodic=periodic)
    half = halved(surface)
    assert half.grid.shape == tuple(n // 2 for n in shape)
    assert half.grid.lengths == pytest.approx(surface.grid.lengths, rel=1e-15)
    assert half.grid.periodic == surface.grid.periodic
    # Heights of a millimetre keep a few units in the last place of it.
    np.testing.assert_allclose(
        half.heights, by_repetition(surface.heights, half.grid.shape), rtol=0, atol=2e-18
    )
    assert half.provenance == ("means over half as many cells along each axis",)


def test_even_numbers_of_cells_are_averaged_by_two():
    surface = rough((8, 12))
    heights = surface.heights.copy()
    heights[0, :3] = heights[1, 0] = heights[1, 2] = heights[4:6, 4] = np.nan
    surface = rc.Surface(heights, surface.grid)
    np.testing.assert_allclose(halved(surface).heights, surface.averaged(2).heights, rtol=0, atol=2e-18)
    assert np.isnan(halved(surface).heights).sum() == 1  # three of four are missing; of two halves it is kept


def test_a_wave_keeps_its_place_and_most_of_its_height():
    grid = rc.Grid((16, 16), 1.0, periodic=True)
    x = grid.coordinates[1]
    surface = rc.Surface(np.broadcast_to(np.cos(2 * np.pi * x / 8), grid.shape).copy(), grid)
    half = halved(surface)
    expected = np.cos(np.pi / 8) * np.cos(2 * np.pi * half.grid.coordinates[1] / 8)
    np.testing.assert_allclose(half.heights, np.broadcast_to(expected, (8, 8)), atol=1e-15)


def test_three_cells_have_no_half():
    with pytest.raises(ValueError, match="a map of 3 x 8 cells has no half: 4 along each axis"):
        halved(rough((3, 8)))
