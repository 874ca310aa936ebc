"""Tables of an influence function: what is cut out of them, to one side or to both, in any order."""

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.influence.tables import FIRST_TABLE, Love, Periodic, Strip, Tables, table_of_waves

LIMIT = (150, 200)
INFLUENCES = {
    "free": Love((0.3, 0.5), 2.0),
    "periodic": Periodic(rc.Grid(LIMIT, (0.3, 0.5), True), 2.0),
}
LARGEST = max(float(one.table((1, 1))[0, 0]) for one in INFLUENCES.values())  # of all values


@pytest.fixture(params=INFLUENCES)
def tables(request):
    return Tables(INFLUENCES[request.param], LIMIT)


def same(found, wanted, size=None):
    """Equal but for roundings of the largest: of a period, small tables are made wave by wave, large ones not."""
    atol = 8 * np.finfo(found.dtype).eps * (size or LARGEST)
    np.testing.assert_allclose(found, wanted, rtol=0, atol=atol)


def signed(tables, shape):
    """The influence at offsets of both signs, as a slice of a table to both sides has it."""
    rows, columns = np.arange(shape[0])[:, None], np.abs(np.arange(1 - shape[1], shape[1]))
    inside = (rows < tables.limit[0]) & (columns < tables.limit[1])
    values = tables.influence.table(tables.limit)
    rows, columns = np.minimum(rows, tables.limit[0] - 1), np.minimum(columns, tables.limit[1] - 1)
    return np.where(inside, values[rows, columns], 0.0)


def check_both_sides(tables, shape, precision="float64"):
    found = tables.to_both_sides(shape, precision)
    middle = found.shape[1] // 2
    assert found.dtype == precision
    assert found.flags.c_contiguous  # machine code takes it by its address
    assert found.shape[1] == 2 * middle
    assert found.shape[0] >= shape[0]
    assert middle >= shape[1]
    part = found[: shape[0], middle - shape[1] + 1 : middle + shape[1]]
    same(part, signed(tables, shape).astype(precision))
    assert np.isfinite(found).all()


def check_single_values(tables, far=LIMIT, seed=0):
    rng = np.random.default_rng(seed)
    rows, columns = (rng.integers(1 - n, n, 300) for n in far)
    values = tables.influence.table(LIMIT)[np.abs(rows), np.abs(columns)]
    same(tables.at(rows, columns), values)


@pytest.mark.parametrize(
    "period", [(16, 20), (15, 20), (16, 21), (9, 7), (1, 12), (70, 130), (71, 131)], ids=str
)
def test_a_table_of_waves_is_the_sum_of_them(period):
    """Of all waves of both axes, one by one: an even function of the offset."""
    rng = np.random.default_rng(0)
    transform = rng.random((period[0] // 2 + 1, period[1] // 2 + 1))
    y, x = (np.arange(n) for n in period)
    folded = transform[np.minimum(y, period[0] - y)[:, None], np.minimum(x, period[1] - x)]
    whole = np.fft.ifft2(folded).real
    for shape in ((1, 1), (1, 5), (3, 2), (2, 100), (100, 2), period):
        shape = tuple(min(a, b) for a, b in zip(shape, period, strict=True))
        found = table_of_waves(transform, period, shape)
        assert found.shape == shape
        same(found, whole[: shape[0], : shape[1]], transform.mean())


@pytest.mark.parametrize("name", INFLUENCES)
def test_one_value_takes_no_table_of_others(name, monkeypatch):
    """That of a cell on itself is asked for first, and often."""
    made = []
    table = type(INFLUENCES[name]).table
    monkeypatch.setattr(
        type(INFLUENCES[name]), "table", lambda self, shape: made.append(shape) or table(self, shape)
    )
    tables = Tables(INFLUENCES[name], LIMIT)
    here = np.zeros(1, np.intp)
    first = tables.matrix(here, here)
    assert first.shape == (1, 1)
    first *= 2  # it is the caller's own
    np.testing.assert_array_equal(2 * tables.matrix(here, here), first)
    assert made == [(1, 1)]


@pytest.mark.parametrize("name", INFLUENCES)
def test_a_matrix_is_taken_from_the_first_table(name, monkeypatch):
    """Not from single values, which cost much."""
    one = INFLUENCES[name]
    rows, columns = np.array([3, 60, 7]), np.array([5, 2, 64])
    wanted = one.at(rows[:, None] - rows, columns[:, None] - columns)
    monkeypatch.setattr(type(one), "at", lambda self, *offsets: pytest.fail("single values are computed"))
    tables = Tables(one, LIMIT)
    same(tables.matrix(rows, columns), wanted)
    assert tables.has((FIRST_TABLE, FIRST_TABLE))
    assert not tables.has(LIMIT)
    assert tables.reach(rows, columns) == (58, 63)
    tables.table(LIMIT)
    assert tables.reach(rows, columns) == LIMIT  # no need to look at all cells
    same(tables.matrix(rows, columns), wanted)


@pytest.mark.parametrize("shape", [(8, 8), (40, 24), (16, 200), (152, 208), (300, 8), (8, 300)], ids=str)
@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_to_both_sides(tables, shape, precision):
    check_both_sides(tables, shape, precision)


@pytest.mark.parametrize(
    "shapes",
    [
        [(8, 8), (16, 40), (16, 16), (152, 24), (64, 200)],
        [(152, 208), (8, 8)],
        [(8, 208), (152, 8)],
        [(70, 70), (72, 72), (80, 64)],
    ],
    ids=str,
)
def test_to_both_sides_as_they_grow(tables, shapes):
    for shape in shapes:
        for precision in ("float32", "float64"):
            check_both_sides(tables, shape, precision)
            check_single_values(tables)
            same(tables.table(shape), tables.influence.table(LIMIT)[: shape[0], : shape[1]])


def test_the_table_may_grow_between(tables):
    whole = tables.influence.table(LIMIT)
    for shape in ((30, 30), (70, 90), (100, 100), LIMIT):
        check_both_sides(tables, (24, 32))
        same(tables.table(shape), whole[: shape[0], : shape[1]])
        check_both_sides(tables, (40, 16), "float32")
        check_single_values(tables, shape)


def test_what_is_large_enough_is_kept(tables):
    first = tables.to_both_sides((40, 48), "float64")
    assert tables.to_both_sides((40, 48), "float64") is first
    assert tables.to_both_sides((8, 16), "float64") is first
    single = tables.to_both_sides((40, 48), "float32")
    assert tables.to_both_sides((24, 48), "float32") is single
    assert tables.table((40, 48)).base is first  # one table serves both
    np.testing.assert_array_equal(single, first.astype(np.float32))


def test_the_rounded_copy_grows_too(tables):
    small = tables.to_both_sides((16, 16), "float32")
    large = tables.to_both_sides((80, 96), "float32")
    assert large.shape[0] > small.shape[0]
    np.testing.assert_array_equal(large, tables.to_both_sides((80, 96), "float64").astype(np.float32))


@pytest.mark.parametrize("shapes", [[(16, 120), (120, 16)], [(120, 16), (16, 120)]], ids=str)
def test_wide_ones_and_long_ones_in_turn(tables, shapes):
    for shape in shapes:
        check_both_sides(tables, shape)
    # Each keeps what there was: the last has room for all.
    found = tables.to_both_sides((120, 120), "float64")
    for shape in shapes:
        assert tables.to_both_sides(shape, "float64") is found


@pytest.mark.parametrize("both", [False, True])
@pytest.mark.parametrize("far", [(20, 30), (FIRST_TABLE, FIRST_TABLE), (100, 20), LIMIT], ids=str)
def test_single_values_of_either_sign(tables, far, both):
    """From the table, beyond it, and from the larger one that many of them are worth."""
    if both:
        tables.to_both_sides((16, 24), "float64")
    for seed in range(3):
        check_single_values(tables, far, seed)
    rows, columns = np.mgrid[1 - far[0] : far[0], 1 - far[1] : far[1]]
    values = tables.influence.table(LIMIT)[np.abs(rows), np.abs(columns)]
    same(tables.at(rows, columns), values)
    same(tables.at(rows, columns, far), values)
    assert tables.at(rows[:0], columns[:0]).size == 0


def test_single_values_leave_offsets_alone(tables):
    rows, columns = np.array([[-3, 4], [0, -100]]), np.array([[5, -6], [-7, 150]])
    given = rows.copy(), columns.copy()
    for shape in ((8, 8), LIMIT):
        tables.to_both_sides(shape, "float64")
        tables.at(rows, columns)
        np.testing.assert_array_equal((rows, columns), given)


def test_a_single_row():
    """A line: nothing above or below, however high tiles are."""
    tables = Tables(Strip((1.0, 0.5), 2.0, 100.0), (1, 120))
    found = tables.to_both_sides((8, 64), "float64")
    middle = found.shape[1] // 2
    wanted = tables.influence.table((1, 120))[0]
    np.testing.assert_array_equal(found[0, middle : middle + 64], wanted[:64])
    np.testing.assert_array_equal(found[0, middle - 63 : middle + 1], wanted[63::-1])
    assert not found[1:8].any()
    columns = np.arange(-119, 120)
    np.testing.assert_array_equal(tables.at(0 * columns, columns), wanted[np.abs(columns)])


@pytest.mark.parametrize("shape", [(1, 1), (3, 2)], ids=str)
def test_a_few_values_of_a_large_plane_take_some_waves_at_a_time(shape, monkeypatch):
    """The sum of 65 x 76 waves in another order: each rounding is one of a number no larger than the sum of sizes."""
    body = Periodic(rc.Grid((128, 150), (1.0, 2.0), True), 1.0)
    at_once = body.table(shape)
    monkeypatch.setattr("roughcontact.halfspace.influence.tables.LARGE_PLANE", 0)
    sizes = body.table((1, 1))[0, 0]  # all waves are positive, and so is each cosine at zero
    digits = (65 + 76) * np.finfo(float).eps
    np.testing.assert_allclose(body.table(shape), at_once, rtol=0, atol=digits * sizes)
