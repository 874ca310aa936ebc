"""The operator on tiles against the exact one: what it leaves out, its symmetry, and where it does not go."""

import math

import numpy as np
import pytest
from scipy.interpolate import BSpline

import roughcontact as rc
from roughcontact.halfspace.sums import local_inverse
from roughcontact.halfspace.sums.mesh import SPLINE_ORDER, _spline
from roughcontact.halfspace.sums.particle_mesh import SHORT_RANGE
from roughcontact.halfspace.sums.tiles import SIDE, Tiles
from roughcontact.kernels import loader
from roughcontact.kernels.active_cells import ActiveCells, with_margins

GRIDS = {
    "free": rc.Grid((96, 96), (1e-3, 1e-3)),
    "free, any shape": rc.Grid((101, 83), (1e-3, 1e-3)),
    "free, long cells": rc.Grid((90, 110), (2e-3, 1e-3)),
    "free, longer cells": rc.Grid((110, 60), (1e-3, 4e-3)),
    "periodic": rc.Grid((96, 120), (1e-3, 1e-3), True),
    "periodic, long cells": rc.Grid((120, 64), (1e-3, 2e-3), True),
}


@pytest.fixture(params=GRIDS)
def grid(request):
    return GRIDS[request.param]


def spots(grid, seed=0, count=12):
    """Discs here and there, one of them at a corner."""
    rng = np.random.default_rng(seed)
    y, x = np.indices(grid.shape)
    region = (y < 3) & (x < 4)
    for _ in range(count):
        row, column, radius = rng.integers(grid.shape[0]), rng.integers(grid.shape[1]), rng.uniform(1, 7)
        region |= (y - row) ** 2 + (x - column) ** 2 < radius**2
    return region


def on(grid, region):
    if not loader.is_available():
        pytest.skip("no machine code here")
    operator = rc.half_space(grid, 2e9)
    return operator, operator.particle_mesh.on(Tiles.of(region))


def test_it_misses_no_more_than_it_says(grid):
    # Its docstring: some 1e-4 of the answer at most; of pressure of both signs, of what its size alone would do.
    region = spots(grid)
    operator, patch = on(grid, region)
    for pressure in (np.where(region, 1e6, 0.0), np.random.default_rng(1).normal(size=grid.shape) * region):
        exact = operator.apply(pressure)
        found = patch.apply(patch.tiles.gather(pressure))
        error = np.abs(found - patch.tiles.gather(exact))[patch.tiles.gather(region)]
        assert error.max() < 1.5e-4 * operator.apply(np.abs(pressure)).max()


def test_one_cell_anywhere_on_a_tile_is_seen_by_all(grid):
    region = spots(grid)
    operator, patch = on(grid, region)
    rows, columns = np.nonzero(region)
    for place in np.linspace(0, len(rows) - 1, 9).astype(int):
        pressure = np.zeros(grid.shape)
        pressure[rows[place], columns[place]] = 1.0
        exact = operator.apply(pressure)
        found = patch.tiles.scatter(patch.apply(patch.tiles.gather(pressure)))
        assert np.abs(found - exact)[region].max() < 1.5e-4 * exact.max()


def test_it_is_symmetric_to_single_precision(grid):
    _, patch = on(grid, spots(grid))
    rng = np.random.default_rng(2)
    inside = patch.tiles.cells >= 0
    a, b = (rng.normal(size=patch.tiles.cells.shape) * inside for _ in range(2))
    for apply in (patch.apply, patch.approximate_inverse):
        size = np.linalg.norm(apply(a)) * np.linalg.norm(b)
        assert abs(np.vdot(apply(a), b) - np.vdot(a, apply(b))) < 1e-6 * size


def test_it_and_its_inverse_are_definite(grid):
    region = spots(grid)
    _, patch = on(grid, region)
    inside = patch.tiles.gather(region)
    rng = np.random.default_rng(3)
    y, x = np.indices(grid.shape)
    for k in range(0, 40, 3):  # from uniform to random, every wavelength in between
        wave = (
            np.cos(2 * np.pi * k * (x + 0.3 * y) / max(grid.shape)) if k < 39 else rng.normal(size=grid.shape)
        )
        field = patch.tiles.gather(wave) * inside
        assert np.vdot(field, patch.apply(field)) > 0
        assert np.vdot(field, patch.approximate_inverse(field)) > 0


def test_the_inverse_is_that_of_the_plane_within_some_percent(grid):
    region = spots(grid)
    operator, patch = on(grid, region)
    displacement = operator.apply(np.where(region, 1e6, 0.0)) * region
    wanted = patch.tiles.gather(operator.approximate_inverse(displacement))
    found = patch.approximate_inverse(patch.tiles.gather(displacement))
    inside = patch.tiles.gather(region)
    # It only has to make solves short; beyond the edge of a free plane the box repeats itself at another place.
    assert np.linalg.norm((found - wanted)[inside]) < 0.2 * np.linalg.norm(wanted[inside])


@pytest.mark.parametrize("large", [math.inf, 1], ids=["near", "near and far"])
def test_the_inverse_is_the_truncated_one_of_the_plane(grid, large, monkeypatch):
    """On tiles as on rows, with blocks that carry the long waves and without."""
    monkeypatch.setattr(local_inverse, "LARGE_PLANE", large)
    region = spots(grid)
    operator, patch = on(grid, region)
    displacement = operator.apply(np.where(region, 1e6, 0.0)) * region
    inverse = local_inverse.local_inverse(2e9, grid)
    assert (inverse.far is None) == (large > 1)
    wanted = inverse.on(ActiveCells(region.astype(float)), with_margins(displacement)) * region
    found = patch.tiles.scatter(patch.approximate_inverse(patch.tiles.gather(displacement))) * region
    # Single precision, of sums of 200 terms of either sign and of transforms, which are relative to the largest.
    terms = np.abs(inverse.near).sum() * 4 * displacement.max()
    np.testing.assert_allclose(found, wanted, rtol=0, atol=8 * np.finfo(np.float32).eps * terms)


@pytest.mark.parametrize(
    "grid",
    [
        rc.Grid((64, 64), (1.0, 5.0)),
        rc.Grid((96, 100), (1.0, 1.0), True),
        rc.Grid((32, 96), (1.0, 1.0), True),
    ],
    ids=["too slender", "no tiles fit the period", "images are near"],
)
def test_where_it_does_not_go(grid):
    assert rc.half_space(grid, 1.0).capabilities.particle_mesh() is None


def test_a_layer_has_none():
    grid = rc.Grid((64, 64), (1.0, 1.0))
    layer = rc.layer(grid, rc.Solid(1.0, 0.3), 4.0, base="bonded")
    assert layer.capabilities.particle_mesh() is None


class TestTiles:
    def test_there_and_back(self):
        region = spots(GRIDS["free, any shape"])
        tiles = Tiles.of(region)
        field = np.random.default_rng(0).normal(size=region.shape) * region
        np.testing.assert_array_equal(tiles.scatter(tiles.gather(field)), field)
        assert tiles.gather(region).sum() == region.sum()
        assert tiles.gather(region).dtype == bool

    def test_they_hold_their_region_and_no_other(self):
        region = np.zeros((50, 50), dtype=bool)
        region[3, 3] = region[40, 20] = True
        tiles = Tiles.of(region)
        assert len(tiles) == 2
        assert tiles.hold(region)
        region[7, 7] = True  # the same tile
        assert tiles.hold(region)
        region[8, 7] = True
        assert not tiles.hold(region)

    @pytest.mark.parametrize("periodic", [False, True])
    def test_the_map_knows_all_that_are_near(self, periodic):
        rng = np.random.default_rng(4)
        region = np.kron(rng.random((7, 9)) < 0.3, np.ones((SIDE, SIDE), dtype=bool))
        tiles = Tiles.of(region)
        places = {(int(y), int(x)): k for k, (y, x) in enumerate(zip(tiles.rows, tiles.columns, strict=True))}
        found = tiles.map(2, periodic)
        across = found.numbers.shape[1]
        for tile, place in enumerate(found.places):
            for dy in range(-2, 3):
                for dx in range(-2, 3):
                    y, x = int(tiles.rows[tile]) + dy, int(tiles.columns[tile]) + dx
                    wanted = places.get((y % 7, x % 9) if periodic else (y, x), len(tiles))
                    assert found.numbers.ravel()[place + dy * across + dx] == wanted


def test_the_splines_are_those_of_the_recursion():
    """No value exceeds 0.55, and those of the truncated powers that cancel are below 2.1."""
    knots = np.arange(SPLINE_ORDER + 1) - SPLINE_ORDER / 2
    x = np.linspace(-SPLINE_ORDER / 2, SPLINE_ORDER / 2, 241)
    assert _spline(x) == pytest.approx(BSpline.basis_element(knots)(x), abs=8 * np.finfo(float).eps)
    beyond = SPLINE_ORDER / 2 + np.array([0.0, 0.1, 7.0])
    assert not _spline(beyond).any()
    assert not _spline(-beyond).any()


@pytest.mark.skipif(not loader.is_available(), reason="no machine code here")
def test_a_period_of_at_least_all_near_tiles_has_a_mesh():
    """Tiles near in both directions and its own: one tile less would be its own image."""
    near = (2 * SHORT_RANGE - 1) * SIDE
    for cells, possible in ((near, True), (near - SIDE, False), (near + 1, False)):
        body = rc.half_space(rc.Grid((cells, near), 1.0, periodic=True), 1.0)
        assert (body.capabilities.particle_mesh() is not None) == possible
