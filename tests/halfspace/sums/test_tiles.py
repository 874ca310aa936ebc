"""Tiles of a list of cells, as those of a region of the plane."""

import numpy as np
import pytest

from roughcontact.halfspace.sums.tiles import SIDE, Tiles, count

SHAPES = [(37, 61), (64, 40), (8, 8), (1, 75), (75, 1), (5, 3)]


@pytest.fixture(params=SHAPES, ids=str)
def region(request):
    region = np.random.default_rng(0).random(request.param) < 0.08
    region[0, 0] = region[-1, -1] = True
    return region


def listed(region, order=None):
    """The tiles of a list of the cells of a region, and their flat indices."""
    cells = np.flatnonzero(region)
    if order is not None:
        cells = order.permutation(cells)
    return Tiles.of_list(region.shape, *np.divmod(cells, region.shape[1])), cells


def test_a_list_has_the_tiles_of_its_region(region):
    tiles, cells = listed(region)
    whole = Tiles.of(region)
    np.testing.assert_array_equal(tiles.rows, whole.rows)
    np.testing.assert_array_equal(tiles.columns, whole.columns)
    assert tiles.shape == whole.shape == region.shape
    assert tiles.fields == (len(cells),)
    assert whole.fields == region.shape
    field = np.random.default_rng(1).normal(size=region.shape) * region
    np.testing.assert_array_equal(tiles.gather(field.ravel()[cells]), whole.gather(field))
    np.testing.assert_array_equal(tiles.gather(np.ones(len(cells), dtype=bool)), whole.gather(region))


def test_the_order_of_a_list_is_no_matter(region):
    tiles, cells = listed(region, np.random.default_rng(2))
    whole = Tiles.of(region)
    field = np.random.default_rng(1).normal(size=region.shape) * region
    np.testing.assert_array_equal(tiles.gather(field.ravel()[cells]), whole.gather(field))


def test_there_and_back(region):
    tiles, cells = listed(region, np.random.default_rng(2))
    for field in (
        np.random.default_rng(1).normal(size=len(cells)),
        np.arange(len(cells), dtype=np.float32),
        np.random.default_rng(1).random(len(cells)) < 0.5,
    ):
        back = tiles.scatter(tiles.gather(field))
        assert back.dtype == field.dtype
        np.testing.assert_array_equal(back, field)


def test_a_cell_lies_where_it_is(region):
    tiles, cells = listed(region, np.random.default_rng(2))
    tile, place = np.nonzero(tiles.cells >= 0)
    rows, columns = tiles.rows[tile] * SIDE + place // SIDE, tiles.columns[tile] * SIDE + place % SIDE
    found = cells[tiles.cells[tile, place]]
    np.testing.assert_array_equal(rows * region.shape[1] + columns, found)
    np.testing.assert_array_equal(np.sort(found), np.sort(cells))


def test_what_is_beyond_the_list_is_left_out(region):
    """Values on a tile where the list has no cell go nowhere, whatever they are."""
    tiles, cells = listed(region)
    values = np.where(tiles.cells >= 0, 1.0, np.nan)
    np.testing.assert_array_equal(tiles.scatter(values), np.ones(len(cells)))


@pytest.mark.parametrize("share", [0.0, 0.1, 1.0])
def test_those_of_a_part(region, share):
    tiles, cells = listed(region)
    part = np.random.default_rng(3).random(len(cells)) < share
    some = tiles.those(part)
    on_the_plane = np.zeros(region.shape, dtype=bool)
    on_the_plane.ravel()[cells[part]] = True
    wanted = Tiles.of(on_the_plane)
    np.testing.assert_array_equal(some.rows, wanted.rows)
    np.testing.assert_array_equal(some.columns, wanted.columns)
    assert (some.shape, some.fields) == (tiles.shape, tiles.fields)
    # All cells of the list that lie on them come along.
    field = np.random.default_rng(1).normal(size=len(cells))
    touched = np.isin(_tile_of(cells, region.shape), _tile_of(cells[part], region.shape))
    np.testing.assert_array_equal(some.scatter(some.gather(field)), np.where(touched, field, 0.0))
    assert some.hold(part)
    assert some.hold(touched)
    assert some.hold(np.ones(len(cells), dtype=bool)) == touched.all()


def test_those_of_a_region_of_the_plane(region):
    whole = Tiles.of(region)
    part = region & (np.random.default_rng(3).random(region.shape) < 0.2)
    some, wanted = whole.those(part), Tiles.of(part)
    for name in ("rows", "columns", "cells"):
        np.testing.assert_array_equal(getattr(some, name), getattr(wanted, name))
    assert some.hold(part)


def test_they_hold_what_lies_on_them():
    region = np.zeros((50, 50), dtype=bool)
    region[3, 3] = region[7, 7] = region[8, 7] = region[49, 49] = True  # the first two on one tile
    tiles, _ = listed(region)
    assert len(tiles) == 3
    some = tiles.those(np.array([True, False, False, False]))
    assert len(some) == 1
    assert some.hold(np.array([True, True, False, False]))
    assert some.hold(np.zeros(4, dtype=bool))
    assert not some.hold(np.array([True, False, True, False]))
    assert not some.hold(np.array([False, False, False, True]))
    assert tiles.hold(np.ones(4, dtype=bool))


def test_a_list_has_the_map_of_its_region(region):
    tiles, _ = listed(region, np.random.default_rng(2))
    found, wanted = tiles.map(2, False), Tiles.of(region).map(2, False)
    np.testing.assert_array_equal(found.numbers, wanted.numbers)
    np.testing.assert_array_equal(found.places, wanted.places)


@pytest.mark.parametrize(("cells", "tiles"), [(1, 1), (7, 1), (8, 1), (9, 2), (16, 2), (17, 3)])
def test_how_many_a_side_takes(cells, tiles):
    assert count(cells) == tiles


def _tile_of(cells, shape):
    rows, columns = np.divmod(cells, shape[1])
    return rows // SIDE * count(shape[1]) + columns // SIDE
