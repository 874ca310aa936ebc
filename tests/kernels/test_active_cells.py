"""What machine code does to the cells of a region, against plain NumPy; and that it leaves the others alone."""

import ctypes

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from regions import PRECISIONS, eighths
from roughcontact.kernels import active_cells as region, loader, planes
from roughcontact.kernels.active_cells import (
    ActiveCells,
    add_blocks,
    mask_above,
    subtract_shifted,
    sum_blocks,
    sum_stencil,
    with_margins,
)
from roughcontact.kernels.constants import REACH, ROUNDINGS, WIDTH
from roughcontact.threads import limit_threads

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

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
    before = region.PART, planes.CELLS
    region.PART, planes.CELLS = request.param, planes.CELLS if request.param == region.PART else 2 * WIDTH
    with limit_threads(2):
        yield
    region.PART, planes.CELLS = before


many = settings(max_examples=60, deadline=None, derandomize=True)


def carry_anything(rng, inside):
    return (eighths(rng, inside.shape, inside.dtype) for _ in range(2))


def carry_little(rng, inside):
    """Those inside press, and few others; of some nothing is left."""
    base, change = carry_anything(rng, inside)
    few = rng.random(inside.shape) < 0.03
    base = np.abs(base) * np.maximum(inside, few)
    return base, np.where(rng.random(inside.shape) < 0.3, -base, change * (base > 0))


def carry_inside(rng, inside):
    return (field * inside for field in carry_anything(rng, inside))


pressures = st.sampled_from([carry_anything, carry_little, carry_inside])


def fields(rng, inside, count):
    return list(rng.standard_normal((count, *inside.shape)).astype(inside.dtype))


def reached(inside, base=0.0, change=0.0):
    """Return the cells that are worked on: groups with one inside or under pressure, and the single ones at the end."""
    lanes, flat = WIDTH // inside.itemsize, ((inside != 0) | (base + change != 0)).ravel()
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
def test_correct_and_dot(given_region):
    inside, rng = given_region
    z, error, v, constant = fields(rng, inside, 4)
    taken = error * constant * inside.dtype.type(ALPHA)
    wanted, size = (z - taken) * inside, np.abs(z) + np.abs(taken)
    hidden(inside, z, error, v, constant)
    sums = ActiveCells(inside).run("correct_and_dot", 4, z, inside, error, v, constant, ALPHA)
    same(z, wanted, inside, size)
    there = inside > 0
    z, error, v, constant = (f[there].astype(np.float64) for f in (z, error, v, constant))
    for found, terms in zip(sums, (error * z, z * v, z, constant * v), strict=True):
        close(found, terms.sum(), terms, inside.dtype)


@many
@given(regions())
def test_xpay(given_region):
    inside, rng = given_region
    t, z = fields(rng, inside, 2)
    wanted, size = t.astype(np.float64) * BETA + z, np.abs(t) + np.abs(z)
    hidden(inside, t, z)
    assert ActiveCells(inside).run("xpay", 0, t, z, BETA) == []
    same(t, wanted, inside, size)


@many
@given(regions())
def test_dot_products(given_region):
    """A direction may have something outside: of its products that counts, of its sum it does not."""
    inside, rng = given_region
    t, v, r = fields(rng, inside, 3)
    a, b, c = (f.astype(np.float64) * reached(inside) for f in (t, v, r))
    terms = [a * b, inside * b, c * a, inside * c * a, inside * a, inside * c]
    hidden(inside, t, v, r)
    sums = ActiveCells(inside).run("dot_products", 6, t, v, inside, r)
    for found, one in zip(sums, terms, strict=True):
        close(found, one.sum(), one, inside.dtype)


@many
@given(regions())
def test_axpy_and_max(given_region):
    inside, rng = given_region
    change, r, error, t = fields(rng, inside, 4)
    wanted = change + t.astype(np.float64) * ALPHA
    size, lack, before = np.abs(change) + np.abs(t), r * inside, r.copy()
    hidden(inside, change, r, error, t)
    largest = ActiveCells(inside).run("axpy_and_max", 1, change, r, error, t, inside, ALPHA, largest=True)[0]
    same(change, wanted, inside, size)
    same(error, lack, inside, 0)
    assert largest == np.abs(lack).max()
    np.testing.assert_array_equal(r[inside > 0], before[inside > 0])


@many
@given(regions(), pressures)
def test_what_carries_something_is_listed(given_region, carrying):
    """As whatever is inside; where others are listed with them, they can be forgotten."""
    inside, rng = given_region
    base, change = carrying(rng, inside)
    t, cells = np.full_like(inside, 7.0), ActiveCells(inside, (base, change))
    cells.run("xpay", 0, t, np.ones_like(t), 0.0)
    there = reached(inside, base, change)
    np.testing.assert_array_equal(t, np.where(there, 1.0, 7.0))
    assert cells.run("multiply", 0, t, inside) == []
    np.testing.assert_array_equal(t, np.where(there, inside, 7.0))


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("cells", [1, WIDTH], ids=["one cell", "lanes"])
@pytest.mark.parametrize("units", [-16, -9, -8, 0, 1, 8, 9, 16])
@pytest.mark.parametrize("start", [2.0, -2.0])
def test_what_is_left_of_a_pressure_may_be_rounding(precision, cells, units, start):
    """Up to eight units in the last place of what it was, of either sign: it is not looked at, nor taken away."""
    unit = 2 * np.finfo(precision).eps
    base = np.full(cells, start, precision)
    change, zeros, t = units * unit - base, np.zeros_like(base), np.ones_like(base)
    left = 0.0 if abs(units) <= ROUNDINGS else units * unit
    others = ActiveCells(zeros, (base, change))
    assert others.run("max_violation", 1, base, change, zeros, largest=True) == [abs(left)]
    sums = others.run("project_step", 4, base, change, zeros.copy(), t, zeros, zeros, 0.0, 0.0, 1.0)
    assert sums == [0, cells * abs(left), cells * -left, 0]
    # Lanes of which nothing is left are not listed; a single cell always is.
    np.testing.assert_array_equal(t, 1.0 if cells > 1 and not left else -left)
    inside = np.ones_like(base)
    pulling = -64 * unit * inside
    sums = ActiveCells(inside).run("project_step", 4, base, change, inside, t, pulling, zeros, 0.0, 0.0, 1.0)
    assert sums == [cells, cells * abs(left), cells * (64 * unit - left), 0]
    np.testing.assert_array_equal(t, -left)


@many
@given(regions(), pressures)
def test_project_step(given_region, carrying):
    """Of eighths, so that nothing is rounded: all is as it should be, or not."""
    inside, rng = given_region
    was, (base, change) = inside > 0, carrying(rng, inside)
    t, z, uniform = (eighths(rng, inside.shape, inside.dtype) for _ in range(3))
    p, there = base + change, reached(inside, base, change)
    step = (t * BETA + z - uniform * SHIFT) * inside * ALPHA
    stays = was & (p + step >= 0)
    lifted = np.where(stays, 0.0, -p)
    wanted, gone = np.where(stays, step, lifted), was & ~stays
    cells = ActiveCells(inside, (base, change))
    for field in (t, z, uniform, base, change):
        field[~there] = np.nan
    given_base, given_change = base.copy(), change.copy()
    sums = cells.run("project_step", 4, base, change, inside, t, z, uniform, BETA, SHIFT, ALPHA)
    np.testing.assert_array_equal(inside, stays)
    np.testing.assert_array_equal(t[there], wanted[there])
    assert np.isnan(t[~there]).all()
    assert sums == [gone.sum(), np.abs(lifted).sum(), (wanted - step).sum(), uniform[gone].sum()]
    np.testing.assert_array_equal(base, given_base)
    np.testing.assert_array_equal(change, given_change)


@many
@given(regions())
def test_subtract_affine(given_region):
    inside, rng = given_region
    base, change, t = (eighths(rng, inside.shape, inside.dtype) for _ in range(3))
    wanted = t - inside * ((base + change + t) * 0.375 + 0.75)
    hidden(inside, base, change, t)
    assert ActiveCells(inside).run("subtract_affine", 0, base, change, inside, t, 0.375, 0.75) == []
    same(t, wanted, inside, 0)


@many
@given(regions(), pressures)
def test_what_all_cells_carry_and_how_far_that_is_out_of_bounds(given_region, carrying):
    """Of the cells inside what pulls is too much, of others all, whatever the sign; nothing of eighths is rounded."""
    inside, rng = given_region
    base, change = carrying(rng, inside)
    lacking = (rng.integers(-40, 40, inside.shape) / 8).astype(inside.dtype)
    p, there, cells = base + change, reached(inside, base, change), ActiveCells(inside, (base, change))
    out = np.where(inside > 0, np.maximum(-p, 0.0), np.abs(p)).max()
    lack = (lacking * inside).sum(dtype=np.float64)
    for field in (base, change, lacking):
        field[~there] = np.nan
    assert cells.run("max_violation", 1, base, change, inside, largest=True) == [out]
    wanted = [p.sum(dtype=np.float64), inside.sum(dtype=np.float64), lack]
    assert cells.run("masked_sums", 3, base, change, inside, lacking) == wanted


@many
@given(regions(), st.sampled_from([0.0, 0.5, 10.0]))
def test_mask_above(given_region, least):
    inside, rng = given_region
    lacking = fields(rng, inside, 1)[0]
    kept = inside > 0
    added = ~kept & (lacking > least)
    worst = mask_above(inside, lacking, least)
    np.testing.assert_array_equal(inside, kept | added)
    assert worst == (lacking[added].max() if added.any() else 0.0)


def test_what_is_never_touched_is_not_taken_in():
    inside = np.zeros((3, 7), np.float32)
    inside[0] = 1.0
    lacking = np.full((3, 7), -1e30, np.float32)
    assert mask_above(inside, lacking, 0.0) == 0.0
    lacking[1, 5] = lacking[0, 0] = 2.0
    assert mask_above(inside, np.asfortranarray(lacking), 0.0) == 2.0
    assert inside.sum() == 8
    assert inside[1, 5] == 1


@many
@given(regions())
def test_subtract_shifted(given_region):
    inside, rng = given_region
    r, v = fields(rng, inside, 2)
    wanted = r - (v.astype(np.float64) - BETA) * ALPHA
    subtract_shifted(r, v, ALPHA, BETA)
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
def test_sum_stencil(given_region):
    """A sum over cells near each in one long row, in which each row follows the one before."""
    inside, rng = given_region
    field = with_margins(fields(rng, inside, 1)[0])
    weights = rng.standard_normal((REACH + 1, REACH + 1)).astype(inside.dtype)
    found = sum_stencil(ActiveCells(inside), field, weights)
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
@given(regions(), st.integers(1, 8), st.booleans(), st.booleans())
def test_blocks(few, given_region, side, fits, apart):
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
    cells, (ny, nx) = ActiveCells(inside), field.shape
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(region, "FEW", few)
        if apart:  # each row of blocks, on several threads
            patch.setattr(region, "CELLS", 1)
            patch.setattr(region, "SEVERAL", 2)
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
        cells, t, change, wrong, rest = ActiveCells(inside), z.copy(), v.copy(), np.zeros_like(z), r.copy()
        kept, pressed = inside.copy(), ActiveCells(inside, (z, v))
        with limit_threads(count):
            many_sums = [
                pressed.run("project_step", 4, z, v, kept, rest, error, r, BETA, SHIFT, ALPHA),
                pressed.run("masked_sums", 3, z, v, kept, rest),
                pressed.run("max_violation", 1, z, v, kept, largest=True),
            ]
            pressed.run("subtract_affine", 0, z, v, kept, rest, ALPHA, BETA)
            one = cells.run("correct_and_dot", 4, t, inside, error, v, r, ALPHA)
            two = cells.run("dot_products", 6, t, v, inside, error)
            subtract_shifted(rest, v, ALPHA, BETA)
            largest = cells.run("axpy_and_max", 1, change, rest, wrong, t, inside, ALPHA, largest=True)
        answers.append([*many_sums, kept, one, two, largest, t, change, rest, wrong])
    for other in answers[1:]:
        for a, b in zip(answers[0], other, strict=True):
            np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_sums_of_single_precision_are_those_of_double(precision):
    """A million tenths: single precision would lose some percent of them one by one."""
    inside = np.ones((1000, 1000), precision)
    tenth = np.full_like(inside, 0.1)
    sums = ActiveCells(inside).run("dot_products", 6, tenth, inside, inside, inside)
    assert sums[4] == pytest.approx(1e6 * float(tenth[0, 0]), rel=1e-10)
    assert sums[1] == 1e6
