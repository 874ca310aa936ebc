"""Fields between products: machine code does what arrays of any library do, and so do whole solves."""

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import roughcontact as rc
from roughcontact.contact import free_cells as free_cells_module
from roughcontact.contact import passes as passes_module
from roughcontact.contact.conjugate_gradient import relax
from roughcontact.contact.drivers import Plane, SinglePlane
from roughcontact.contact.free_cells import free_cells
from roughcontact.contact.measure import Measure
from roughcontact.contact.passes import passes_for
from roughcontact.halfspace.operator import Operator
from roughcontact.machine import loader

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

PRECISIONS = ("float32", "float64")
many = settings(max_examples=60, deadline=None, derandomize=True)


@dataclass(frozen=True)
class Bare:
    """A driver whose preconditioner is the same for both kinds of passes."""

    operator: Operator

    @property
    def weights(self):
        return self.operator.weights

    def apply(self, pressure):
        return self.operator.apply(pressure)

    def approximate_inverse(self, displacement):
        return self.operator.approximate_inverse(displacement)


def generic(make, *given):
    """Return what there is without machine code."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(loader, "is_available", lambda: False)
        return make(*given)


def plane(shape=(21, 34), periodic=False):
    return rc.half_space(rc.Grid(shape, (0.3, 0.2), periodic), 2.0)


def region(shape, seed=0, share=0.4):
    return np.random.default_rng(seed).random(shape) < share


def close(found, wanted, size, precision, rounding=20):
    """Equal up to some roundings of numbers of a size."""
    np.testing.assert_allclose(found, wanted, rtol=0, atol=rounding * np.finfo(precision).eps * size)


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("begun", [False, True], ids=["from nothing", "from a direction"])
@pytest.mark.parametrize("conserve", [False, True])
def test_sums_and_fields_are_the_same(precision, begun, conserve):
    """Step by step; sums may differ by the rounding of each of their terms, of which there are some 300."""
    driver, rng = Bare(plane()), np.random.default_rng(1)
    inside = region((21, 34)).astype(precision)
    r, *last = rng.standard_normal((3, 21, 34)).astype(precision)
    t, v = last if begun else (None, None)
    measure = Measure(driver.weights)

    def given():
        return driver, measure, inside.copy(), r.copy(), t, v

    one, two = passes_for(*given()), generic(passes_for, *given())
    assert isinstance(one, passes_module._Compiled)
    assert isinstance(two, passes_module._Generic)
    kept = inside > 0

    def same(a, b):
        size = float(np.max(np.abs(b)))
        close(a, b, size, precision, 300)

    assert one.size() == two.size()
    same(one.measure(one.v), two.measure(two.v))
    if conserve:
        same(one.share(), two.share())
    for beta, shift, alpha, mean in ((0.0, 0.5, 0.25, 0.0), (0.75, -0.25, 0.5, 0.125)):
        same(one.precondition(), two.precondition())
        a, b = one.turn(beta, shift), two.turn(beta, shift)
        same(a[kept], b[kept])
        direction = np.array(b)
        a[...], b[...] = direction, direction
        answer = driver.apply(direction)
        same(one.measure(answer), two.measure(answer.copy()))
        same(one.advance(alpha, mean), two.advance(alpha, mean))
        same(one.change, two.change)
        same(one.r, two.r)


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("conserve", [False, True])
def test_relief_is_taken_off_the_diagonal(precision, conserve):
    """Of what the inverse answers, by what it answers to a constant; sums go over some 300 terms."""
    driver = Plane(plane())
    inside = region((21, 34)).astype(precision)
    r = np.random.default_rng(3).standard_normal((21, 34)).astype(precision)
    passes = passes_for(driver, Measure(driver.weights), inside, r.copy(), None, None)
    passes.size()
    if conserve:
        passes.share()
    cells = np.flatnonzero(inside)
    near, w = np.zeros((len(cells), len(cells))), driver.local_inverse.near
    # Rows follow rows in memory: the cell beyond the end of one is the first of the next.
    for dy in range(-2, 3):
        for dx in range(-2, 3):
            near[cells[:, None] - cells[None, :] == 34 * dy + dx] = w[abs(dy), abs(dx)]
    wanted = (near - driver.relief * np.diag(near.sum(axis=0))) @ r.ravel()[cells].astype(np.float64)
    descent, _, total = passes.precondition()
    error, area = r.ravel()[cells].astype(np.float64), driver.weights
    size = np.abs(near) @ np.abs(error)
    close(passes.turn(0.0, 0.0).ravel()[cells], wanted, size.max(), precision)
    close(descent, area * (error @ wanted), area * (np.abs(error) @ size), precision)
    close(total, area * wanted.sum(), area * size.sum(), precision)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_outside_nothing_changes_but_the_lack(precision):
    driver = Plane(plane())
    inside = region((21, 34), share=0.1).astype(precision)
    r = np.random.default_rng(2).standard_normal((21, 34)).astype(precision)
    passes = passes_for(driver, Measure(driver.weights), inside, r.copy(), None, None)
    passes.size()
    passes.precondition()
    v = driver.apply(passes.turn(0.0, 0.0)).astype(precision)
    passes.measure(v)
    passes.advance(0.5, 0.25)
    outside = inside == 0
    assert (passes.change[outside] == 0).all()
    assert (passes.t[outside] == 0).all()
    wanted = r.astype(np.float64) - 0.5 * (v.astype(np.float64) - 0.25)
    close(passes.r, wanted, 4 + np.abs(v).max(), precision)


def test_cells_of_many_sizes_and_other_libraries_have_no_machine_code():
    ring = Plane(rc.ring(rc.RadialGrid.uniform(33, 3.0), 2.0))
    ones = np.ones(33)
    passes = passes_for(ring, Measure(ring.weights), ones, ones.copy(), None, None)
    assert isinstance(passes, passes_module._Generic)
    cells = free_cells(ones > 0, ones < 0, np.inf, Measure(ring.weights), ones)
    assert isinstance(cells, free_cells_module._Generic)
    hard = free_cells(ones > 0, ones < 0, 3.0, Measure(1.0), ones)
    assert isinstance(hard, free_cells_module._Generic)
    whole = free_cells(ones > 0, ones < 0, np.inf, Measure(1.0), ones)
    assert isinstance(whole, free_cells_module._Compiled)


SYSTEMS = {
    f"{'periodic' if periodic else 'free'}, {'force' if conserve else 'depth'}": (periodic, conserve)
    for periodic, conserve in ((False, False), (False, True), (True, True), (True, False))
}


@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize("seed", [0, 1])
def test_both_solve_the_same_system_to_the_same_limit(name, seed):
    periodic, conserve = SYSTEMS[name]
    operator = plane((20, 24), periodic)
    inside = region((20, 24), seed, 0.5)
    lacking = np.random.default_rng(seed).standard_normal((20, 24))
    before, limit = lacking.copy(), 1e-9
    options = {"conserve": conserve, "limit": limit, "max_steps": 200}
    matrix = operator.as_matrix(np.flatnonzero(inside))
    if conserve:  # on pressures without resultant
        apart = np.eye(len(matrix)) - 1 / len(matrix)
        matrix = apart @ matrix @ apart + 1 / len(matrix)
    wanted = np.zeros((20, 24))
    level = lacking[inside].mean() if conserve else 0.0
    wanted[inside] = np.linalg.solve(matrix, lacking[inside] - level)
    # The answer is off by no more than the inverse makes of what is lacking.
    bound = np.sqrt(inside.sum()) * limit / np.linalg.eigvalsh(matrix)[0]

    for found in (
        relax(Plane(operator), inside.astype(float), lacking, **options),
        generic(lambda: relax(Plane(operator), inside.astype(float), lacking, **options)),
    ):
        assert found.largest <= limit
        assert 0 < found.steps < 60
        left = lacking - operator.apply(found.change)
        left -= left[inside].mean() if conserve else 0.0
        assert np.abs(left[inside]).max() < 1.01 * limit
        carried_on = found.lacking - found.lacking[inside].mean() if conserve else found.lacking
        np.testing.assert_allclose(carried_on, left, rtol=0, atol=1e-12)
        assert (found.change[~inside] == 0).all()
        assert np.linalg.norm(found.change - wanted) < bound
        if conserve:
            assert abs(found.change.sum()) < 1e-13 * np.abs(found.change).sum()
        np.testing.assert_array_equal(lacking, before)


@pytest.mark.parametrize("conserve", [False, True])
def test_both_solve_in_single_precision(conserve):
    operator, inside = plane((40, 50)), region((40, 50), 3, 0.5)
    lacking = np.random.default_rng(3).standard_normal((40, 50)).astype(np.float32)
    options = {"conserve": conserve, "limit": 1e-3, "max_steps": 100}
    weights = inside.astype(np.float32)
    for found in (
        relax(SinglePlane(operator), weights, lacking, **options),
        generic(lambda: relax(SinglePlane(operator), weights, lacking, **options)),
    ):
        assert found.largest <= 1e-3
        assert found.change.dtype == found.lacking.dtype == np.float32
        left = lacking - operator.apply(found.change.astype(np.float64))
        left -= left[inside].mean() if conserve else 0.0
        assert np.abs(left[inside]).max() < 1.1e-3


@pytest.mark.parametrize("conserve", [False, True])
def test_a_solve_goes_on_where_another_left_off(conserve):
    """On a region that has lost some cells, over which the last direction had a resultant."""
    operator, inside = plane((20, 24)), region((20, 24), 4, 0.5)
    left_over = inside & ~region((20, 24), 5, 0.1)
    lacking = np.random.default_rng(4).standard_normal((20, 24))

    def twice():
        options = {"conserve": conserve, "limit": 1e-9}
        first = relax(Plane(operator), inside.astype(float), lacking, max_steps=4, **options)
        return first.change, relax(
            Plane(operator), left_over.astype(float), first.lacking, max_steps=100, last=first.last, **options
        )

    for first, second in (twice(), generic(twice)):
        assert second.largest <= 1e-9
        assert (second.change[~left_over] == 0).all()
        left = lacking - operator.apply(first + second.change)
        left -= left[left_over].mean() if conserve else 0.0
        assert np.abs(left[left_over]).max() < 1.01e-9
        if conserve:
            assert abs(second.change.sum()) < 1e-13 * np.abs(second.change).sum()


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("compiled", [True, False], ids=["compiled", "generic"])
@pytest.mark.parametrize("conserve", [False, True])
def test_fields_may_lie_otherwise_in_memory(order, compiled, conserve):
    operator, inside = plane((20, 24)), region((20, 24), 4, 0.5)
    lacking = np.random.default_rng(4).standard_normal((20, 24))

    def solve():
        given = (np.array(f, order=order) for f in (inside.astype(float), lacking))
        return relax(Plane(operator), *given, conserve=conserve, limit=1e-9, max_steps=200)

    found = solve() if compiled else generic(solve)
    left = lacking - operator.apply(found.change)
    left -= left[inside].mean() if conserve else 0.0
    assert np.abs(left[inside]).max() < 1.01e-9


def test_what_needs_no_change_gets_none():
    driver, inside = Plane(plane((20, 24))), region((20, 24), 4, 0.5).astype(float)
    lacking = np.where(inside > 0, 1e-3, 5.0)
    for solve in (relax, lambda *given, **options: generic(lambda: relax(*given, **options))):
        found = solve(driver, inside, lacking, conserve=False, limit=2e-3, max_steps=10)
        assert found.steps == 0
        assert (found.change == 0).all()
        assert found.largest == 1e-3
        assert found.last is None
        np.testing.assert_array_equal(found.lacking, lacking)


@st.composite
def cells(draw):
    """Return random fields of a solve: who is free, what they carry, what moves them, what they lack."""
    shape = draw(st.integers(1, 17)), draw(st.integers(1, 30))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    kept = rng.random(shape) < draw(st.sampled_from([0.0, 0.05, 0.6, 1.0]))
    load = draw(st.sampled_from([0.0, 0.5, 10.0]))
    base, change, lacking = rng.standard_normal((3, *shape)).astype(draw(st.sampled_from(PRECISIONS)))
    return kept, kept * np.abs(base) * load, kept * change, lacking


def both_of(kept, like):
    measure = Measure(0.25)
    given = kept, np.zeros_like(kept), np.inf, measure, like
    one, two = free_cells(*given), generic(free_cells, *given)
    assert isinstance(one, free_cells_module._Compiled)
    assert isinstance(two, free_cells_module._Generic)
    assert one.held is None
    assert two.held is None
    return one, two


@many
@given(cells(), st.booleans())
def test_the_same_cells_are_let_go(fields, conserve):
    kept, base, change, _ = fields
    one, two = both_of(kept, base)
    a, b = (free.let_go(base, change, conserve) for free in (one, two))
    np.testing.assert_array_equal(one.inside, two.inside)
    pulls = kept & (base + change < 0)
    np.testing.assert_array_equal(one.inside > 0, kept & ~pulls)
    assert one.inside.dtype == base.dtype
    if not pulls.any():
        assert a is None
        assert b is None
        return
    # Both round sums of single numbers, one of them one by one in single precision.
    size = np.abs(base + change).sum() if conserve else 0.0
    close(a, b, size, base.dtype)
    after = base.astype(np.float64) + change + a
    close(after[pulls], 0.0, np.abs(base + change).max(), base.dtype)
    assert (a[~kept] == 0).all()


@many
@given(cells())
def test_the_force_is_kept(fields):
    """As far as the rest of the cells may take it, whatever they carry."""
    kept, base, change, _ = fields
    for free in both_of(kept, base):
        moved = free.let_go(base, change, True)
        if moved is None or not free.inside.any():
            continue
        size = np.abs(moved.astype(np.float64)).sum() + np.abs(base + change).sum()
        close(moved.sum(dtype=np.float64), 0.0, size, base.dtype)


@pytest.mark.parametrize("order", ["C", "F"])
def test_bounds_may_lie_otherwise_in_memory(order):
    rng = np.random.default_rng(6)
    kept = rng.random((9, 14)) < 0.6
    base, change = (np.array(kept * f, order=order) for f in rng.standard_normal((2, 9, 14)))
    lacking = np.array(rng.standard_normal((9, 14)), order=order)
    for free in both_of(np.array(kept, order=order), base):
        moved = free.let_go(base, change, False)
        pulls = kept & (base + change < 0)
        np.testing.assert_array_equal(free.inside > 0, kept & ~pulls)
        np.testing.assert_array_equal(moved, np.where(pulls, -(base + change), 0.0))
        free.take_in(lacking, 0.5)
        np.testing.assert_array_equal(free.inside > 0, (kept & ~pulls) | (lacking > 0.5))


def test_new_cells_share_alike():
    """They carry nothing yet, so nothing tells their shares."""
    kept = np.ones((4, 9), bool)
    base = np.zeros((4, 9))
    change = np.where(np.arange(36).reshape(4, 9) < 6, -3.0, 0.0)
    for free in both_of(kept, base):
        moved = free.let_go(base, change, True)
        np.testing.assert_allclose(moved.ravel()[:6], 3.0)
        np.testing.assert_allclose(moved.ravel()[6:], -6 * 3.0 / 30)


@many
@given(cells(), st.sampled_from([0.0, 0.3, 5.0]))
def test_the_same_cells_are_taken_in(fields, least):
    kept, base, _, lacking = fields
    one, two = both_of(kept, base)
    assert one.take_in(lacking, least) == two.take_in(lacking, least)
    np.testing.assert_array_equal(one.inside, two.inside)
    np.testing.assert_array_equal(one.inside > 0, kept | (lacking > least))


@many
@given(cells())
def test_letting_go_and_taking_in_by_turns(fields):
    kept, base, change, lacking = fields
    one, two = both_of(kept, base)
    for turn in range(3):
        for free in (one, two):
            free.let_go(base, change * turn, False)
            free.take_in(lacking * (turn - 1), 0.2)
        np.testing.assert_array_equal(one.inside, two.inside)
