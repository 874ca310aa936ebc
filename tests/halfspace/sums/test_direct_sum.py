"""The sum over tiles in machine code against sums over pairs of cells, and what it reads."""

from functools import cache

import numpy as np
import pytest

from roughcontact.halfspace.influence.love import love
from roughcontact.halfspace.influence.tables import Love, Tables
from roughcontact.halfspace.sums import direct_sum
from roughcontact.halfspace.sums.direct_sum import DirectSum
from roughcontact.halfspace.sums.tiles import SIDE, Tiles
from roughcontact.kernels import loader
from roughcontact.threads import limit_threads

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

SPACING = (0.3, 0.5)
PLACES = {
    "one": [(0, 0)],
    "one, far from the corner": [(7, 3)],
    "in a row": [(2, 0), (2, 1), (2, 5)],
    "in a column": [(0, 4), (1, 4), (3, 4)],
    "ahead and behind": [(0, 3), (1, 0), (1, 3), (1, 9), (4, 2)],
    "in no order": [(5, 2), (0, 6), (5, 0), (2, 2), (0, 0)],
    "a square": [(y, x) for y in range(2) for x in range(3)],
}
PRECISIONS = ["float32", "float64"]


def kernel_over(rows, columns, precision):
    """Love's integral at offsets of rows from zero up, and of columns to both sides."""
    down, across = (int(np.ptp(places) + 1) * SIDE for places in (rows, columns))
    y, x = np.arange(down)[:, None], np.arange(-across, across)
    return love(x * SPACING[1], y * SPACING[0], SPACING[1], SPACING[0]).astype(precision)


def over(places, precision, kernel=None):
    rows, columns = np.array(places, np.int64).T.copy()
    return DirectSum(rows, columns, kernel_over(rows, columns, precision) if kernel is None else kernel)


def cells_of(places):
    """Rows and columns of the cells of each tile in turn."""
    y, x = np.divmod(np.arange(SIDE * SIDE), SIDE)
    return np.concatenate([[SIDE * down + y, SIDE * across + x] for down, across in places], axis=1)


def dense(places):
    return _dense(tuple(places))


@cache
def _dense(places):
    rows, columns = cells_of(places)
    down, across = rows[:, None] - rows, columns[:, None] - columns
    return love(across * SPACING[1], down * SPACING[0], SPACING[1], SPACING[0])


def load(places, seed=0, share=0.4):
    """Of both signs, on some of the cells."""
    rng = np.random.default_rng(seed)
    shape = (len(places), SIDE * SIDE)
    return rng.normal(size=shape) * (rng.random(shape) < share)


def rounding(matrix, pressure, precision):
    """What sums of n terms, of rounded numbers, may be wrong by; the dense ones as well."""
    terms = np.count_nonzero(pressure) + 3
    return terms * np.finfo(precision).eps * (np.abs(matrix) @ np.abs(pressure).ravel())


def check(places, pressure, precision, kernel=None):
    matrix = dense(places)
    found = over(places, precision, kernel).apply(pressure)
    assert found.shape == pressure.shape
    assert found.dtype == precision
    error = np.abs(found.ravel() - matrix @ pressure.ravel())
    assert (error <= rounding(matrix, pressure, precision)).all()


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("name", PLACES)
def test_the_sum_over_all_pairs(name, precision):
    check(PLACES[name], load(PLACES[name]), precision)


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("cell", [0, 7, 8, 27, 56, 63])
def test_one_cell_is_a_column_of_the_table(cell, precision):
    """No sum at all: each value is a single product, and exact."""
    places = PLACES["ahead and behind"]
    matrix = dense(places).astype(precision)
    for tile in range(len(places)):
        pressure = np.zeros((len(places), SIDE * SIDE))
        pressure[tile, cell] = 2.0
        found = over(places, precision).apply(pressure)
        np.testing.assert_array_equal(found.ravel(), 2 * matrix[:, tile * SIDE * SIDE + cell])


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("without", [[0], [2], [4], [1, 2], [0, 1, 3, 4]])
def test_tiles_without_load(without, precision):
    places = PLACES["ahead and behind"]
    pressure = load(places)
    pressure[without] = 0.0
    check(places, pressure, precision)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_no_load_at_all(precision):
    places = PLACES["in no order"]
    found = over(places, precision).apply(np.zeros((len(places), SIDE * SIDE)))
    np.testing.assert_array_equal(found, 0.0)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_every_cell_is_loaded(precision):
    check(PLACES["a square"], load(PLACES["a square"], share=2.0), precision)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_a_larger_kernel_is_as_good(precision):
    """The middle is where its rows say: more room to the sides and below is no matter."""
    places = PLACES["ahead and behind"]
    y, x = np.arange(97)[:, None], np.arange(-203, 203)
    kernel = love(x * SPACING[1], y * SPACING[0], SPACING[1], SPACING[0]).astype(precision)
    pressure = load(places)
    np.testing.assert_array_equal(
        over(places, precision, kernel).apply(pressure), over(places, precision).apply(pressure)
    )


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("name", PLACES)
def test_it_reads_what_it_needs_and_no_more(name, precision):
    """All of the kernel that is at no offset from a cell under load, and the memory around it, is no number."""
    places, pressure = PLACES[name], load(PLACES[name], share=0.1)
    rows, columns = cells_of(places)
    some = pressure.ravel() != 0
    whole = kernel_over(*np.array(places).T, precision)
    room = np.full(whole.size + 2000, np.nan, precision)
    kernel = room[1000 : 1000 + whole.size].reshape(whole.shape)
    down = np.abs(rows[:, None] - rows[some])
    across = whole.shape[1] // 2 + columns[:, None] - columns[some]
    kernel[down, across] = whole[down, across]
    assert np.isnan(kernel).any()
    check(places, pressure, precision, kernel)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_what_is_no_number_shows(precision):
    places = PLACES["in no order"]
    pressure = np.zeros((len(places), SIDE * SIDE))
    pressure[3, 50] = np.nan
    assert np.isnan(over(places, precision).apply(pressure)).all()


@pytest.mark.parametrize("precision", PRECISIONS)
def test_any_array_will_do(precision):
    places = PLACES["in no order"]
    pressure = load(places).astype(precision)
    expected = over(places, precision).apply(pressure)
    turned, locked, other = np.asfortranarray(pressure), pressure.copy(), pressure.astype(">f8")
    locked.flags.writeable = False
    for given in (turned, locked, other, np.repeat(pressure, 2, axis=0)[::2]):
        np.testing.assert_array_equal(over(places, precision).apply(given), expected)


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("count", [2, 3, 8])
def test_threads_are_no_matter(monkeypatch, count, precision):
    places = [(y, x) for y in range(0, 40, 3) for x in range(y % 4, 30, 4)]
    operator, pressure = over(places, precision), load(places, share=0.3)
    with limit_threads(1):
        alone = operator.apply(pressure)
    monkeypatch.setattr(direct_sum, "PAIRS_FOR_THREADS", 0)
    for _ in range(5):
        with limit_threads(count):
            np.testing.assert_array_equal(operator.apply(pressure), alone)


@pytest.mark.parametrize("short", [0, 1])
def test_few_pairs_are_summed_by_one_thread(monkeypatch, short):
    """A pair is a loaded cell and a tile that it acts on."""
    places, asked = PLACES["a square"], []
    pressure = load(places)
    pairs = np.count_nonzero(pressure) * len(places)
    monkeypatch.setattr(direct_sum, "PAIRS_FOR_THREADS", pairs + short)
    monkeypatch.setattr(direct_sum, "threads", lambda: asked.append(2) or 2)
    over(places, "float64").apply(pressure)
    assert len(asked) == 1 - short


@pytest.mark.parametrize("precision", PRECISIONS)
def test_over_tiles_of_a_plane(precision):
    """Tiles at the far edges reach beyond the plane, where nothing is."""
    rng = np.random.default_rng(1)
    region = rng.random((37, 61)) < 0.02
    region[0, 60] = region[36, 0] = True
    tiles, influence = Tiles.of(region), Tables(Love(SPACING, 1 / np.pi), region.shape)
    found = DirectSum.over(tiles, influence, precision)
    assert found.kernel.dtype == precision
    field = rng.normal(size=region.shape) * region
    y, x = np.divmod(np.arange(region.size), region.shape[1])
    loaded = np.flatnonzero(region)
    across, down = (x[:, None] - x[loaded]) * SPACING[1], (y[:, None] - y[loaded]) * SPACING[0]
    matrix = love(across, down, SPACING[1], SPACING[0])
    error = tiles.scatter(found.apply(tiles.gather(field))).ravel() - matrix @ field.ravel()[loaded]
    inside = tiles.scatter(np.ones(tiles.cells.shape)).ravel() > 0
    limit = rounding(matrix, field.ravel()[loaded], precision)
    assert (np.abs(error) <= limit)[inside].all()
