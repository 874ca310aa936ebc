"""The inverse by near cells: symmetric and definite on any region, and how well it knows each wave."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.sums import local_inverse
from roughcontact.halfspace.sums.local_inverse import BLOCK, DIAGONAL_CORRECTION, LARGE_PLANE, LocalInverse
from roughcontact.kernels import loader
from roughcontact.kernels.active_cells import ActiveCells, with_margins
from roughcontact.kernels.constants import REACH

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

MODULUS = 2e9
SPACINGS = {"square": (1e-3, 1e-3), "slender": (1e-3, 5e-3), "slender the other way": (5e-3, 1e-3)}


@pytest.fixture(params=SPACINGS)
def spacing(request):
    return SPACINGS[request.param]


@pytest.fixture(params=[False, True], ids=["near", "near and far"])
def far(request, monkeypatch):
    """Whether blocks carry the long waves of a plane that is small."""
    monkeypatch.setattr(local_inverse, "LARGE_PLANE", 1 if request.param else math.inf)
    return request.param


def regions(shape):
    rng = np.random.default_rng(8)
    y, x = np.indices(shape)
    return {
        "whole": np.ones(shape, bool),
        "one cell": (y == 3) & (x == 5),
        "sparse": rng.random(shape) < 0.2,
        "dense": rng.random(shape) < 0.8,
        "the edges": (y == 0) | (x == 0) | (x == shape[1] - 1),
        "stripes": x % 2 == 0,
        "squares": (x + y) % 2 == 0,
        "disc": (y - shape[0] / 2) ** 2 + (x - shape[1] / 2) ** 2 < 30,
    }


def matrix(inverse, inside, precision="float64"):
    """Return the matrix between the cells of a region, column by column."""
    region, cells = ActiveCells(inside.astype(precision)), np.flatnonzero(inside)
    columns = []
    for cell in cells:
        field = np.zeros(inside.shape, precision)
        field.flat[cell] = 1.0
        columns.append(inverse.on(region, with_margins(field)).ravel()[cells])
    return np.array(columns, np.float64).T


def response(inverse, shape, spacing, rows, columns):
    """Return the response to waves along a plane, so many on each axis, over E* q/2."""
    y, x = np.indices(shape)
    wave = np.cos(2 * np.pi * (rows * y / shape[0] + columns * x / shape[1]))
    found = inverse.on(ActiveCells(np.ones(shape)), with_margins(wave))
    q = 2 * np.pi * np.hypot(rows / shape[0] / spacing[0], columns / shape[1] / spacing[1])
    inner = np.s_[2 * REACH : -2 * REACH, 2 * REACH : -2 * REACH]
    return np.vdot(found[inner], wave[inner]) / np.vdot(wave[inner], wave[inner]) / (MODULUS / 2 * q)


def around(cells, least, most):
    """Return how many waves along each axis of a square plane have so many cells to a wave, in several directions."""
    lengths = np.geomspace(least, most, 9)
    angles = np.linspace(0, np.pi / 2, 5)
    found = [
        np.rint(cells / n * np.array([np.sin(a), np.cos(a)])).astype(int) for n in lengths for a in angles
    ]
    return sorted({(int(r), int(c)) for r, c in found})


@pytest.mark.parametrize("shape", [(12, 10), (9, 14)])
def test_symmetric_and_definite_on_any_region(spacing, far, shape):
    inverse = LocalInverse.of(MODULUS, shape, spacing)
    assert (inverse.far is not None) == far
    for name, inside in regions(shape).items():
        found = matrix(inverse, inside)
        scale = np.abs(found).max()
        # The far part comes of a transform of blocks: some roundings of its largest number.
        np.testing.assert_allclose(found, found.T, rtol=0, atol=1e-14 * scale, err_msg=name)
        assert np.linalg.eigvalsh(found / scale)[0] > 0.01, name


@pytest.mark.parametrize("shape", [(12, 10), (21, 20)])
def test_definite_without_what_the_outside_takes_off(spacing, far, shape):
    """On any region: were all weights but the first negative, at least what is not taken off of the least is left."""
    inverse = LocalInverse.of(MODULUS, shape, spacing)
    for name, inside in regions(shape).items():
        found = matrix(inverse, inside)
        relieved = found - DIAGONAL_CORRECTION * np.diag(found.sum(axis=0))
        least, most = (np.linalg.eigvalsh(one / found.max())[0] for one in (relieved, found))
        assert least > (1 - DIAGONAL_CORRECTION) * most * (1 - 1e-12) > 0, name


def test_what_the_outside_takes_off_brings_it_nearer_the_inverse():
    """Of a disc on a half-space: largest over least number of the product of both, without and with relief."""
    grid, shape = rc.Grid((24, 24), 1e-3), (24, 24)
    y, x = np.indices(shape)
    disc = (y - 11.5) ** 2 + (x - 11.5) ** 2 < 80
    found = matrix(LocalInverse.of(MODULUS, shape, grid.spacing), disc)
    influence = rc.half_space(grid, MODULUS).as_matrix(np.flatnonzero(disc))

    def spread(inverse):
        numbers = np.linalg.eigvals(inverse @ influence).real
        return numbers.max() / numbers.min()

    assert spread(found - DIAGONAL_CORRECTION * np.diag(found.sum(axis=0))) < 0.8 * spread(found)


def test_symmetric_and_definite_in_single_precision(spacing, far):
    inverse, shape = LocalInverse.of(MODULUS, (12, 10), spacing), (12, 10)
    inside = regions(shape)["dense"]
    single, double = (matrix(inverse, inside, precision) for precision in ("float32", "float64"))
    scale = np.abs(double).max()
    np.testing.assert_allclose(single, double, rtol=0, atol=1e-6 * scale)
    assert np.linalg.eigvalsh((single + single.T) / 2)[0] > 0


@pytest.mark.parametrize("ratio", [1, 5, 15, 30, 100])
def test_near_cells_alone_answer_every_wave_with_more_than_nothing(ratio, far):
    """However slender cells are, and between the waves that weights are fitted to too: rows that follow rows."""
    angle = np.linspace(0, np.pi, 500)
    waves = np.cos(np.outer(np.arange(REACH + 1), angle)) * np.array([1, *[2] * REACH])[:, None]
    for spacing in ((1.0, ratio), (ratio, 1.0)):
        near = LocalInverse.of(MODULUS, (40, 40), spacing).near
        assert (waves.T @ near @ waves).min() > 0


def test_waves_of_square_cells_are_known_within_a_fourth():
    """Those of 3 to 40 cells: the weights are fitted to waves up to 64, of which there are few."""
    spacing = SPACINGS["square"]
    inverse = LocalInverse.of(MODULUS, (120, 120), spacing)
    found = [response(inverse, (120, 120), spacing, *waves) for waves in around(120, 3, 40)]
    assert 0.75 < min(found) <= max(found) < 1.25


@pytest.mark.parametrize("name", ["slender", "slender the other way"])
def test_waves_of_slender_cells_are_known_within_a_factor_of_three(name):
    """Too little is answered to waves along the short sides, of which few cells see little."""
    spacing = SPACINGS[name]
    inverse = LocalInverse.of(MODULUS, (120, 120), spacing)
    found = [response(inverse, (120, 120), spacing, *waves) for waves in around(120, 3, 40)]
    assert 1 / 3 < min(found) <= max(found) < 1.4


def test_blocks_know_the_long_waves_within_a_fourth(spacing, monkeypatch):
    """Those of up to a third of the plane; it is as long as its blocks repeat themselves."""
    monkeypatch.setattr(local_inverse, "LARGE_PLANE", 1)
    inverse = LocalInverse.of(MODULUS, (240, 240), spacing)
    found = [response(inverse, (240, 240), spacing, *waves) for waves in around(240, 6, 80)]
    assert 0.75 < min(found) <= max(found) < 1.25


def test_without_blocks_the_longest_waves_are_unknown():
    spacing = SPACINGS["square"]
    near = LocalInverse.of(MODULUS, (240, 240), spacing)
    assert response(near, (240, 240), spacing, 0, 2) > 2


def test_large_planes_have_blocks():
    spacing, shape = SPACINGS["square"], (768, 800)
    assert math.prod(shape) > LARGE_PLANE
    assert LocalInverse.of(MODULUS, (512, 800), spacing).far is None
    inverse = LocalInverse.of(MODULUS, shape, spacing)
    assert inverse.far.lengths == (768 // BLOCK, 800 // BLOCK)
    for waves in ((8, 0), (0, 10), (9, 9)):
        assert 0.75 < response(inverse, shape, spacing, *waves) < 1.25


def test_blocks_at_the_edges_are_cut_off():
    rows, columns = LocalInverse.of(MODULUS, (769, 803), SPACINGS["square"]).far.lengths
    assert rows >= 193
    assert columns >= 201


@pytest.mark.parametrize("shape", [(12, 20), (13, 23)])
def test_scale_laws(spacing, far, shape):
    """A stiffer body takes more pressure, larger cells take less."""
    field = with_margins(np.random.default_rng(0).standard_normal(shape))
    region = ActiveCells(np.ones(shape))

    def pressure(modulus, factor):
        return LocalInverse.of(modulus, shape, tuple(factor * d for d in spacing)).on(region, field)

    once = pressure(MODULUS, 1.0)
    atol = 1e-10 * np.abs(once).max()  # the fit is a least-squares solve of some condition
    np.testing.assert_allclose(pressure(100 * MODULUS, 1.0), 100 * once, rtol=0, atol=100 * atol)
    np.testing.assert_allclose(pressure(MODULUS, 1e-3), 1e3 * once, rtol=0, atol=1e3 * atol)


def test_the_far_part_is_added_to_the_near_one(spacing, monkeypatch):
    """Block by block: what a displacement that sums to nothing on each block leaves is near."""
    monkeypatch.setattr(local_inverse, "LARGE_PLANE", 1)
    shape = (4 * BLOCK, 6 * BLOCK)
    inverse = LocalInverse.of(MODULUS, shape, spacing)
    region = ActiveCells(np.ones(shape))
    blocks = np.random.default_rng(1).standard_normal((4, 6))
    bumps = np.zeros((BLOCK, BLOCK))
    bumps[0, 0], bumps[-1, -1] = 1.0, -1.0
    near = LocalInverse(inverse.near, None)
    for inside, sums in ((bumps, 0.0), (np.full((BLOCK, BLOCK), 1 / BLOCK**2), blocks)):
        field = with_margins(np.kron(blocks, inside))
        added = inverse.on(region, field) - near.on(region, field)
        wanted = np.kron(inverse.far.apply(blocks) * np.any(sums), np.ones((BLOCK, BLOCK)))
        np.testing.assert_allclose(added, wanted, rtol=0, atol=1e-13 * np.abs(inverse.near).max())


@pytest.mark.parametrize("periodic", [False, True])
def test_half_spaces_have_one_and_other_bodies_none(periodic):
    plane = rc.half_space(rc.Grid((20, 30), 1e-3, periodic), MODULUS)
    np.testing.assert_array_equal(
        plane.local_inverse.near, LocalInverse.of(MODULUS, (20, 30), (1e-3, 1e-3)).near
    )
    assert rc.half_space(rc.Grid((1, 30), 1e-3, periodic), MODULUS).local_inverse is None
    layer = rc.layer(rc.Grid((20, 30), 1e-3, periodic), rc.Solid(1e9, 0.3), 0.01, base="bonded")
    assert layer.capabilities.local_inverse() is None
