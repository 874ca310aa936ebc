"""What machine code does to the cells of a region, against plain NumPy; and that it leaves the others alone."""

import ctypes

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roughcontact.machine import loader, region
from roughcontact.machine.layout import REACH, WIDTH
from roughcontact.machine.region import (
    Region,
    add_blocks,
    lower,
    near,
    sum_blocks,
    take_in,
    with_margins,
)
from roughcontact.threads import limit_threads

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

PRECISIONS = ("float32", "float64")
MASKS = {
    "empty": lambda rng, shape: np.zeros(shape, bool),
    "full": lambda rng, shape: np.ones(shape, bool),
    "one cell": lambda rng, shape: np.arange(np.prod(shape)).reshape(shape) == rng.integers(np.prod(shape)),
    "the last cell": lambda rng, shape: np.arange(1, np.prod(shape) + 1).reshape(shape) == np.prod(shape),
    "sparse": lambda rng, shape: rng.random(shape) < 0.05,
    "dense": lambda rng, shape: rng.random(shape) < 0.7,
    "a corner": lambda rng, shape: np.add.outer(np.arange(shape[0]), np.arange(shape[1])) < sum(shape) / 3,
}
ALPHA, BETA, SHIFT = 0.375, -0.75, 1.25  # numbers of single precision too


@st.composite
def regions(draw):
    """Return a mask as numbers, and a generator for the fields."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    shape = draw(st.integers(1, 20)), draw(st.integers(1, 40))
    mask = MASKS[draw(st.sampled_from(sorted(MASKS)))](rng, shape)
    return mask.astype(draw(st.sampled_from(PRECISIONS))), rng


@pytest.fixture(autouse=True, params=[region.PART, 3], ids=["one part", "many parts"])
def part(request):
    """So many groups at a time: with few, small fields come in many parts, on several threads."""
    before, region.PART = region.PART, request.param
    with limit_threads(2):
        yield
    region.PART = before


many = settings(max_examples=60, deadline=None, derandomize=True)


def fields(rng, inside, count):
    return list(rng.standard_normal((count, *inside.shape)).astype(inside.dtype))


def reached(inside):
    """Return the cells that are worked on: groups with a cell inside, and the single ones at the end."""
    lanes, flat = WIDTH // inside.itemsize, inside.ravel() != 0
    whole = flat.size // lanes * lanes
    cells = np.ones(flat.size, bool)
    cells[:whole] = flat[:whole].reshape(-1, lanes).any(axis=1).repeat(lanes)
    return cells.reshape(inside.shape)


def hidden(inside, *given):
    """Make fields no numbers where nothing is read."""
    for field in given:
        field[~reached(inside)] = np.nan


def close(found, wanted, terms, precision):
    """Equal up to the rounding of each term in its precision, and of their sum in double precision."""
    terms = np.abs(np.asarray(terms, np.float64))
    rounding = 2 * np.finfo(precision).eps + terms.size * np.finfo(np.float64).eps
    assert found == pytest.approx(wanted, rel=0, abs=rounding * terms.sum())


def same(found, wanted, inside, size, rounding=2):
    """Equal, where it is worked on, to some roundings of numbers of a size; else nothing was written."""
    there = reached(inside)
    bound = rounding * np.finfo(inside.dtype).eps * size
    assert (np.abs(found[there] - wanted[there]) <= np.broadcast_to(bound, there.shape)[there]).all()
    assert np.isnan(found[~there]).all()


@many
@given(regions())
def test_weigh(given_region):
    inside, rng = given_region
    z, error, v, constant = fields(rng, inside, 4)
    taken = error * constant * inside.dtype.type(ALPHA)
    wanted, size = (z - taken) * inside, np.abs(z) + np.abs(taken)
    hidden(inside, z, error, v, constant)
    sums = Region(inside).run("weigh", 3, z, inside, error, v, constant, ALPHA)
    same(z, wanted, inside, size)
    there = inside > 0
    z, error, v = (f[there].astype(np.float64) for f in (z, error, v))
    for found, terms in zip(sums, (error * z, z * v, z), strict=True):
        close(found, terms.sum(), terms, inside.dtype)


@many
@given(regions())
def test_a_region_is_empty(given_region):
    inside, _ = given_region
    assert Region(inside).is_empty() == (not inside.any())


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (1, 8), (3, 3), (5, 13), (4, 16), (17,)])
def test_a_region_of_one_cell_is_not_empty(precision, shape):
    """Wherever it is: in a whole group, or in what is left after the last."""
    inside = np.zeros(shape, precision)
    assert Region(inside).is_empty()
    for at in np.ndindex(shape):
        inside[at] = 1
        assert not Region(inside).is_empty()
        inside[at] = 0


@many
@given(regions())
def test_turn(given_region):
    inside, rng = given_region
    t, z, uniform = fields(rng, inside, 3)
    wanted = t.astype(np.float64) * BETA + z - uniform * SHIFT
    size = np.abs(t) + np.abs(z) + 2 * np.abs(uniform)
    hidden(inside, t, z, uniform)
    assert Region(inside).run("turn", 0, t, z, uniform, BETA, SHIFT) == []
    same(t, wanted, inside, size)


@many
@given(regions())
def test_measure(given_region):
    inside, rng = given_region
    t, v, error = fields(rng, inside, 3)
    t *= inside
    error *= inside
    a, b, c = (f.astype(np.float64) for f in (t, v, error))
    terms = [a * b, inside * b, c * a, a]
    hidden(inside, t, v, error)
    sums = Region(inside).run("measure", 4, t, v, inside, error)
    for found, one in zip(sums, terms, strict=True):
        close(found, one.sum(), one, inside.dtype)


@many
@given(regions())
def test_advance(given_region):
    inside, rng = given_region
    change, r, error, t = fields(rng, inside, 4)
    wanted = change + t.astype(np.float64) * ALPHA
    size, lack, before = np.abs(change) + np.abs(t), r * inside, r.copy()
    hidden(inside, change, r, error, t)
    largest = Region(inside).run("advance", 1, change, r, error, t, inside, ALPHA, largest=True)[0]
    same(change, wanted, inside, size)
    same(error, lack, inside, 0)
    assert largest == np.abs(lack).max()
    np.testing.assert_array_equal(r[inside > 0], before[inside > 0])


@many
@given(regions())
def test_let_go(given_region):
    inside, rng = given_region
    base, change, moved, t, error = fields(rng, inside, 5)
    before, p, was = inside > 0, base + change, change.copy()
    pulls = before & (p < 0)
    others = [(field, field * (before & ~pulls)) for field in (t, error)]
    hidden(inside, base, change, moved, t, error)
    cells, given_base = Region(inside), base.copy()
    given_fields = base, change, inside, moved, t, error
    count, lost, carried, left = cells.run("let_go", 4, *given_fields)
    np.testing.assert_array_equal(inside, before & ~pulls)
    assert count == pulls.sum()
    assert left == inside.sum()
    worked_on = reached(before.astype(inside.dtype))
    same(change, was - p * pulls, before.astype(inside.dtype), np.abs(was) + np.abs(p))
    np.testing.assert_array_equal(change[worked_on & ~pulls], was[worked_on & ~pulls])
    for field, wanted in others:
        same(field, wanted, before.astype(inside.dtype), 0)
    p = p.astype(np.float64)
    close(lost, -p[pulls].sum(), p[pulls], inside.dtype)
    close(carried, p[inside > 0].sum(), p[inside > 0], inside.dtype)
    np.testing.assert_array_equal(moved[pulls], -p[pulls])
    assert (moved[worked_on & ~pulls] == 0).all()
    assert np.isnan(moved[~worked_on]).all()
    np.testing.assert_array_equal(base, given_base)


@many
@given(regions())
def test_share_out(given_region):
    inside, rng = given_region
    base, change, moved = fields(rng, inside, 3)
    p = (base + change).astype(np.float64)
    less = inside * (p * ALPHA + BETA)
    wanted, left = moved - less, change - less
    size = np.abs(p) + 1
    sizes = np.abs(moved) + size, np.abs(change) + size
    hidden(inside, base, change, moved)
    Region(inside).run("share_out", 0, base, change, inside, moved, ALPHA, BETA)
    same(moved, wanted, inside, sizes[0], 3)
    same(change, left, inside, sizes[1], 3)


@many
@given(regions(), st.sampled_from([0.0, 0.5, 10.0]))
def test_take_in(given_region, least):
    inside, rng = given_region
    lacking = fields(rng, inside, 1)[0]
    kept = inside > 0
    added = ~kept & (lacking > least)
    worst = take_in(inside, lacking, least)
    np.testing.assert_array_equal(inside, kept | added)
    assert worst == (lacking[added].max() if added.any() else 0.0)


def test_what_is_never_touched_is_not_taken_in():
    inside = np.zeros((3, 7), np.float32)
    inside[0] = 1.0
    lacking = np.full((3, 7), -1e30, np.float32)
    assert take_in(inside, lacking, 0.0) == 0.0
    lacking[1, 5] = lacking[0, 0] = 2.0
    assert take_in(inside, np.asfortranarray(lacking), 0.0) == 2.0
    assert inside.sum() == 8
    assert inside[1, 5] == 1


@many
@given(regions())
def test_lower(given_region):
    inside, rng = given_region
    r, v = fields(rng, inside, 2)
    wanted = r - (v.astype(np.float64) - BETA) * ALPHA
    lower(r, v, ALPHA, BETA)
    bound = 3 * np.finfo(r.dtype).eps * (np.abs(wanted) + np.abs(v) + 1)
    assert (np.abs(r - wanted) <= bound).all()


@many
@given(regions(), st.sampled_from([None, *PRECISIONS, np.dtype(np.float32), np.float64]))
def test_margins_are_zero(given_region, precision):
    inside, rng = given_region
    field = fields(rng, inside, 1)[0]
    for given_field in (field, np.asfortranarray(field), *(() if precision is None else (inside > 0,))):
        found = with_margins(given_field, precision)
        assert found.dtype == (given_field.dtype if precision is None else precision)
        np.testing.assert_array_equal(found, given_field.astype(found.dtype))
        assert found.flags.c_contiguous
        assert not np.shares_memory(found, given_field)
        margin = REACH * (found.shape[1] + 1) + WIDTH // found.itemsize
        start, size = found.__array_interface__["data"][0], margin * found.itemsize
        for place in (start - size, start + found.nbytes):
            assert not any((ctypes.c_char * size).from_address(place).raw)


@many
@given(regions())
def test_near(given_region):
    """A sum over cells near each in one long row, in which each row follows the one before."""
    inside, rng = given_region
    field = with_margins(fields(rng, inside, 1)[0])
    weights = rng.standard_normal((REACH + 1, REACH + 1)).astype(inside.dtype)
    found = near(Region(inside), field, weights)
    nx, far = field.shape[1], REACH * (field.shape[1] + 1)
    row = np.pad(field.ravel().astype(np.float64), far)
    wanted, size = np.zeros(field.size), np.zeros(field.size)
    for dy in range(-REACH, REACH + 1):
        for dx in range(-REACH, REACH + 1):
            start = far + dy * nx + dx
            term = weights[abs(dy), abs(dx)] * row[start : start + field.size]
            wanted += term
            size += np.abs(term)
    there, terms = inside.ravel() > 0, (2 * REACH + 1) ** 2  # one rounding or less for each
    error = np.abs(found.ravel()[there] - wanted[there])
    assert (error <= terms * np.finfo(inside.dtype).eps * size[there]).all()


@pytest.mark.parametrize("few", [-1.0, 1.0], ids=["all of the plane", "group by group"])
@many
@given(regions(), st.integers(1, 8), st.booleans())
def test_blocks(few, given_region, side, fits):
    """Group by group where rows are whole groups, and groups whole blocks: else all of the plane."""
    inside, rng = given_region
    lanes = WIDTH // inside.itemsize
    if fits:
        inside = np.ascontiguousarray(np.tile(inside, (1, lanes))[:, : -(-inside.shape[1] // lanes) * lanes])
    field = fields(rng, inside, 1)[0]
    field *= inside
    by_groups = few > 0 and inside.shape[1] % lanes == 0 and lanes % side == 0
    shown = field.copy()
    if by_groups:
        hidden(inside, shown)
    cells, (ny, nx) = Region(inside), field.shape
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(region, "FEW", few)
        sums = sum_blocks(cells, shown, side)
        assert sums.shape == (-(-ny // side), -(-nx // side))
        out = np.random.default_rng(0).standard_normal(sums.shape).astype(field.dtype)
        added = shown.copy()
        add_blocks(cells, added, out, side)
    worked_on = reached(inside) if by_groups else np.ones(inside.shape, bool)
    eps = np.finfo(field.dtype).eps
    for b, a in np.ndindex(sums.shape):
        square = np.s_[b * side : (b + 1) * side, a * side : (a + 1) * side]
        terms = field[square].astype(np.float64)
        bound = terms.size * eps * np.abs(terms).sum()  # one rounding or less for each
        assert sums[b, a] == pytest.approx(terms.sum(), rel=0, abs=bound)
        there = worked_on[square]
        np.testing.assert_array_equal(added[square][there], (field[square] + out[b, a])[there])
        assert np.isnan(added[square][~there]).all()


@pytest.mark.parametrize("precision", PRECISIONS)
def test_sums_do_not_hang_on_the_number_of_threads(precision):
    rng = np.random.default_rng(5)
    inside = (rng.random((101, 203)) < 0.4).astype(precision)
    z, error, v, r = fields(rng, inside, 4)
    answers = []
    for count in (1, 2, 3):
        cells, t, change, wrong, rest = Region(inside), z.copy(), v.copy(), np.zeros_like(z), r.copy()
        with limit_threads(count):
            one = cells.run("weigh", 3, t, inside, error, v, r, ALPHA)
            two = cells.run("measure", 4, t, v, inside, error)
            lower(rest, v, ALPHA, BETA)
            largest = cells.run("advance", 1, change, rest, wrong, t, inside, ALPHA, largest=True)
        answers.append([one, two, largest, t, change, rest, wrong])
    for other in answers[1:]:
        for a, b in zip(answers[0], other, strict=True):
            np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_sums_of_single_precision_are_those_of_double(precision):
    """A million tenths: single precision would lose some percent of them one by one."""
    inside = np.ones((1000, 1000), precision)
    tenth = np.full_like(inside, 0.1)
    sums = Region(inside).run("measure", 4, tenth, inside, inside, inside)
    assert sums[3] == pytest.approx(1e6 * float(tenth[0, 0]), rel=1e-10)
    assert sums[1] == 1e6
