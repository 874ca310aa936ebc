"""Fields of a solve: machine code does what arrays of any library do, and so do whole solves."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import roughcontact as rc
from libraries import Strict
from regions import close, plane, region
from roughcontact.contact import fields as fields_module
from roughcontact.contact.compiled_fields import CompiledFields
from roughcontact.contact.conjugate_gradient import relax
from roughcontact.contact.drivers import Plane, SinglePlane
from roughcontact.contact.fields import fields_on
from roughcontact.contact.measure import Measure
from roughcontact.halfspace.operator import Operator
from roughcontact.machine import loader

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

PRECISIONS = ("float32", "float64")
many = settings(max_examples=60, deadline=None, derandomize=True)


@dataclass(frozen=True)
class Bare:
    """A driver whose preconditioner is the same for both kinds of fields."""

    operator: Operator
    relief: ClassVar[float] = 0.0

    @property
    def weights(self):
        return self.operator.weights

    def apply(self, pressure):
        return self.operator.apply(pressure)

    def approximate_inverse(self, displacement):
        return self.operator.approximate_inverse(displacement)


class Seeing:
    """A driver whose preconditioner sees all cells from each: so it would what is left of an error outside."""

    weights = 0.25
    relief = 0.0

    @staticmethod
    def approximate_inverse(displacement):
        return np.full_like(displacement, displacement.sum(dtype=np.float64))


def on(driver, kept, lacking, base=None, *hardness):
    """Return the fields of a solve that begins with no change; what is lacking is not overwritten."""
    base = np.zeros_like(lacking) if base is None else base
    return fields_on(driver, Measure(driver.weights), kept, lacking.copy(order="K"), base, *hardness)


def generic(*given):
    """Return what there is without machine code."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(loader, "is_available", lambda: False)
        return on(*given)


def both_of(*given):
    one, two = on(*given), generic(*given)
    assert isinstance(one, CompiledFields)
    assert isinstance(two, fields_module._Generic)
    assert one.held is None
    assert two.held is None
    return one, two


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("begun", [False, True], ids=["from nothing", "from a direction"])
@pytest.mark.parametrize("conserve", [False, True])
def test_sums_and_fields_are_the_same(precision, begun, conserve):
    """Step by step; sums may differ by the rounding of each of their terms, of which there are some 300."""
    driver, rng = Bare(plane()), np.random.default_rng(1)
    kept = region((21, 34))
    r, t, v = rng.standard_normal((3, 21, 34)).astype(precision)
    one, two = both_of(driver, kept, r)

    def same(a, b, size=None):
        close(a, b, np.abs(b).max() if size is None else size, precision, 300)

    same(one.begin(conserve), two.begin(conserve))
    same(one.r, two.r)
    np.testing.assert_array_equal(one.inside, two.inside)
    one.r[...] = two.r
    assert one.size() == two.size() == np.abs(two.r[kept]).max()
    for fields in (one, two):
        if begun:
            fields.t[...] = kept * t
            fields.measure(v.copy())
    # Where there is no direction yet, v is what is lacking, of which all may cancel.
    same(one.measure(one.v), two.measure(two.v), None if begun else driver.weights * np.abs(r).sum())
    if conserve:
        same(one.share(), two.share())
    for beta, shift, alpha, mean in ((0.0, 0.5, 0.25, 0.0), (0.75, -0.25, 0.5, 0.125)):
        same(one.precondition(), two.precondition())
        a, b = one.turn(beta, shift), two.turn(beta, shift)
        same(a, b)
        assert (a[~kept] == 0).all()
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
    kept = region((21, 34))
    r = np.random.default_rng(3).standard_normal((21, 34)).astype(precision)
    fields = on(driver, kept, r)
    fields.size()
    if conserve:
        fields.share()
    cells = np.flatnonzero(kept)
    near, w = np.zeros((len(cells), len(cells))), driver.local_inverse.near
    # Rows follow rows in memory: the cell beyond the end of one is the first of the next.
    for dy in range(-2, 3):
        for dx in range(-2, 3):
            near[cells[:, None] - cells[None, :] == 34 * dy + dx] = w[abs(dy), abs(dx)]
    wanted = (near - driver.relief * np.diag(near.sum(axis=0))) @ r.ravel()[cells].astype(np.float64)
    descent, _, total = fields.precondition()
    error, area = r.ravel()[cells].astype(np.float64), driver.weights
    size = np.abs(near) @ np.abs(error)
    close(fields.turn(0.0, 0.0).ravel()[cells], wanted, size.max(), precision)
    close(descent, area * (error @ wanted), area * (np.abs(error) @ size), precision)
    close(total, area * wanted.sum(), area * size.sum(), precision)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_outside_nothing_changes_but_the_lack(precision):
    driver = Plane(plane())
    kept = region((21, 34), share=0.1)
    r = np.random.default_rng(2).standard_normal((21, 34)).astype(precision)
    fields = on(driver, kept, r)
    fields.size()
    fields.precondition()
    v = driver.apply(fields.turn(0.0, 0.0)).astype(precision)
    fields.measure(v)
    fields.advance(0.5, 0.25)
    assert (fields.change[~kept] == 0).all()
    assert (fields.t[~kept] == 0).all()
    np.testing.assert_array_equal(fields.inside, kept)
    wanted = r.astype(np.float64) - 0.5 * (v.astype(np.float64) - 0.25)
    close(fields.r, wanted, 4 + np.abs(v).max(), precision)


@pytest.mark.parametrize("compiled", [True, False], ids=["compiled", "generic"])
def test_what_one_solve_shared_the_next_does_not(compiled):
    """At given displacement nothing is shared, whatever was so at given force."""
    driver, kept = Bare(plane()), region((21, 34))
    r = np.random.default_rng(7).standard_normal((21, 34))
    fields = (on if compiled else generic)(driver, kept, r)
    fields.begin(True)
    fields.share()
    fields.begin(False)
    fields.size()
    fields.precondition()
    alike = fields.turn(0.0, 0.0).copy()
    np.testing.assert_array_equal(fields.turn(0.0, 0.5), alike)


def test_what_has_no_machine_code():
    """Cells of many sizes, a hardness, and other libraries."""
    ring, ones = Plane(rc.ring(rc.RadialGrid.uniform(33, 3.0), 2.0)), np.ones(33)
    kept = ones > 0
    assert isinstance(on(ring, kept, ones), fields_module._Generic)
    held = np.arange(33) == 3
    hard = on(Seeing, kept & ~held, ones, ones, held, 3.0)
    assert isinstance(hard, fields_module._Generic)
    np.testing.assert_array_equal(hard.held, held)
    there = [Strict.put(f) for f in (ones, ones)]
    elsewhere = fields_on(Seeing, Measure(0.25), there[0] > 0, *there)
    assert isinstance(elsewhere, fields_module._Generic)
    assert all(Strict.is_there(f) for f in (elsewhere.inside, elsewhere.change, elsewhere.r, elsewhere.t))
    assert isinstance(on(Seeing, kept, ones), CompiledFields)


SYSTEMS = {
    f"{'periodic' if periodic else 'free'}, {'force' if conserve else 'depth'}": (periodic, conserve)
    for periodic, conserve in ((False, False), (False, True), (True, True), (True, False))
}


@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize("seed", [0, 1])
def test_both_solve_the_same_system_to_the_same_limit(name, seed):
    periodic, conserve = SYSTEMS[name]
    operator = plane((20, 24), periodic)
    kept = region((20, 24), seed, 0.5)
    lacking = np.random.default_rng(seed).standard_normal((20, 24))
    limit = 1e-9
    matrix = operator.as_matrix(np.flatnonzero(kept))
    if conserve:  # on pressures without resultant
        apart = np.eye(len(matrix)) - 1 / len(matrix)
        matrix = apart @ matrix @ apart + 1 / len(matrix)
    wanted = np.zeros((20, 24))
    level = lacking[kept].mean() if conserve else 0.0
    wanted[kept] = np.linalg.solve(matrix, lacking[kept] - level)
    # The answer is off by no more than the inverse makes of what is lacking.
    bound = np.sqrt(kept.sum()) * limit / np.linalg.eigvalsh(matrix)[0]

    driver = Plane(operator)
    for fields in both_of(driver, kept, lacking):
        largest, steps = relax(driver, fields, conserve=conserve, limit=limit, max_steps=200)
        assert largest <= limit
        assert largest == np.abs(fields.r[kept]).max()
        assert 0 < steps < 60
        left = lacking - operator.apply(fields.change)
        left -= left[kept].mean() if conserve else 0.0
        assert np.abs(left[kept]).max() < 1.01 * limit
        carried_on = fields.r - fields.r[kept].mean() if conserve else fields.r
        np.testing.assert_allclose(carried_on, left, rtol=0, atol=1e-12)
        assert (fields.change[~kept] == 0).all()
        assert np.linalg.norm(fields.change - wanted) < bound
        if conserve:
            assert abs(fields.change.sum()) < 1e-13 * np.abs(fields.change).sum()


@pytest.mark.parametrize("conserve", [False, True])
def test_both_solve_in_single_precision(conserve):
    operator, kept = plane((40, 50)), region((40, 50), 3, 0.5)
    lacking = np.random.default_rng(3).standard_normal((40, 50)).astype(np.float32)
    driver = SinglePlane(operator)
    for fields in both_of(driver, kept, lacking):
        largest, _ = relax(driver, fields, conserve=conserve, limit=1e-3, max_steps=100)
        assert largest <= 1e-3
        assert fields.change.dtype == fields.r.dtype == fields.inside.dtype == np.float32
        left = lacking - operator.apply(fields.change.astype(np.float64))
        left -= left[kept].mean() if conserve else 0.0
        assert np.abs(left[kept]).max() < 1.1e-3


@pytest.mark.parametrize("conserve", [False, True])
def test_a_solve_goes_on_where_another_left_off(conserve):
    """On a region that has lost some cells, over which the last direction had a resultant; then on a larger one."""
    operator, kept = plane((20, 24)), region((20, 24), 4, 0.5)
    driver, lost = Plane(operator), kept & region((20, 24), 5, 0.1)
    lacking = np.random.default_rng(4).standard_normal((20, 24))
    # Whatever a change makes of it, this pulls where it is to be let go of, and nowhere else.
    base = kept * np.where(lost, -100.0, 100.0)

    def solves(fields, rest, max_steps=100):
        largest, steps = relax(driver, fields, conserve=conserve, limit=1e-9, max_steps=max_steps)
        assert steps > 0
        assert (largest <= 1e-9) == (max_steps == 100)
        np.testing.assert_array_equal(fields.inside, rest)
        assert (fields.t[~rest] == 0).all()
        left = lacking - operator.apply(fields.change)
        left -= left[rest].mean() if conserve else 0.0
        assert np.abs(left[rest]).max() == pytest.approx(largest, rel=0, abs=1e-11)
        if conserve:
            assert abs(fields.change.sum()) < 1e-13 * np.abs(fields.change).sum()

    for fields in both_of(driver, kept, lacking, base):
        solves(fields, kept, 4)
        before = fields.change.copy()
        fields.follow(operator.apply(fields.let_go(conserve)))
        rest = kept & ~lost
        solves(fields, rest)
        close((base + fields.change)[lost], 0.0, 200.0, "float64", 2)
        assert (fields.change[~kept] == 0).all()
        assert (fields.change[rest] != before[rest]).any()
        more = ~rest & (fields.r > 0.5)
        assert more.any()
        assert fields.take_in(0.5) == fields.r[more].max()
        solves(fields, rest | more)


@pytest.mark.parametrize("conserve", [False, True])
def test_a_solve_that_stops_on_its_way_takes_no_other(conserve):
    """The next direction is conjugate to the last: begun anew, the change after so few steps would be far off."""
    operator, kept = plane((20, 24)), region((20, 24), 4, 0.5)
    lacking, driver = np.random.default_rng(4).standard_normal((20, 24)), Plane(operator)
    options = {"conserve": conserve, "limit": 0.0}
    for one, two in zip(*(both_of(driver, kept, lacking) for _ in range(2)), strict=True):
        relax(driver, one, max_steps=6, **options)
        for steps in (2, 3, 1):
            relax(driver, two, max_steps=steps, **options)
        # Sums of 240 terms, in six steps.
        close(two.change, one.change, np.abs(one.change).max(), "float64", 6 * 240)
        relax(driver, one, max_steps=1, **options)
        assert np.abs(two.change - one.change).max() > 1e-6 * np.abs(one.change).max()


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("compiled", [True, False], ids=["compiled", "generic"])
@pytest.mark.parametrize("conserve", [False, True])
def test_fields_may_lie_otherwise_in_memory(order, compiled, conserve):
    operator, kept = plane((20, 24)), region((20, 24), 4, 0.5)
    lacking, driver = np.random.default_rng(4).standard_normal((20, 24)), Plane(operator)
    given = (np.array(f, order=order) for f in (kept, lacking, np.zeros((20, 24))))
    fields = (on if compiled else generic)(driver, *given)
    relax(driver, fields, conserve=conserve, limit=1e-9, max_steps=200)
    left = lacking - operator.apply(fields.change)
    left -= left[kept].mean() if conserve else 0.0
    assert np.abs(left[kept]).max() < 1.01e-9


def test_what_needs_no_change_gets_none():
    driver, kept = Plane(plane((20, 24))), region((20, 24), 4, 0.5)
    lacking = np.where(kept, 1e-3, 5.0)
    for fields in both_of(driver, kept, lacking):
        assert relax(driver, fields, conserve=False, limit=2e-3, max_steps=10) == (1e-3, 0)
        assert (fields.change == 0).all()
        assert (fields.t == 0).all()
        np.testing.assert_array_equal(fields.r, lacking)


@dataclass(frozen=True)
class Given:
    """Fields in the midst of a solve: who is free, what they carry, what changed it, what they lack, where to."""

    kept: np.ndarray
    base: np.ndarray
    change: np.ndarray
    lacking: np.ndarray
    t: np.ndarray

    @property
    def p(self):
        return self.base + self.change

    @property
    def pulls(self):
        return self.kept & (self.p < 0)

    def both(self):
        """Return both kinds of fields so far, with the error on the whole region, and what it shares, in them."""
        found = both_of(Seeing, self.kept, self.lacking, self.base)
        for fields in found:
            fields.change[...] += self.change
            fields.t[...] = self.t
            fields.size()
            fields.share()
        return found


@st.composite
def givens(draw):
    shape = draw(st.integers(1, 17)), draw(st.integers(1, 30))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    kept = rng.random(shape) < draw(st.sampled_from([0.0, 0.05, 0.6, 1.0]))
    load = draw(st.sampled_from([0.0, 0.5, 10.0]))
    base, change, lacking, t = rng.standard_normal((4, *shape)).astype(draw(st.sampled_from(PRECISIONS)))
    return Given(kept, kept * np.abs(base) * load, kept * change, lacking, kept * t)


def is_on(fields, kept):
    """Whether all that hangs on the region is that of these cells, and nothing is left of an error elsewhere."""
    np.testing.assert_array_equal(fields.inside > 0, kept)
    np.testing.assert_array_equal(fields.inside, kept)
    precision = fields.r.dtype
    assert fields.inside.dtype == precision
    assert fields.is_empty() == (not kept.any())
    assert fields.begin(False) == 0.25 * kept.sum()
    assert fields.share() == 0.25 * kept.sum() ** 2
    error = (fields.r * kept).astype(np.float64)
    assert fields.size() == np.abs(error).max()
    z, size, v = error.sum(), np.abs(error).sum(), fields.v.astype(np.float64)
    descent, overlap, total = fields.precondition()
    # Each term is rounded, and each is a rounded sum times a number: as the sums of sizes, all told.
    close(descent, 0.25 * z * z, 0.25 * size * size, precision)
    close(overlap, 0.25 * z * v[kept].sum(), 0.25 * size * np.abs(v[kept]).sum(), precision)
    close(total, 0.25 * z * kept.sum(), 0.25 * size * kept.sum(), precision)


@many
@given(givens(), st.booleans())
def test_the_same_cells_are_let_go(start, conserve):
    given_base = start.base.copy()
    one, two = start.both()
    a, b = (fields.let_go(conserve) for fields in (one, two))
    kept, pulls, p = start.kept, start.pulls, start.p
    if not pulls.any():
        assert a is None
        assert b is None
    for fields, moved in ((one, a), (two, b)):
        is_on(fields, kept & ~pulls)
        np.testing.assert_array_equal(fields.t, np.where(pulls, 0.0, start.t))
        np.testing.assert_array_equal(fields.r, start.lacking)
        if moved is None:
            np.testing.assert_array_equal(fields.change, start.change)
            continue
        assert moved.dtype == fields.change.dtype == start.base.dtype
        # Both are rounded, and so is what is in them: a pressure times a ratio.
        wanted = start.change.astype(np.float64) + moved
        close(fields.change, wanted, np.abs(start.change).max() + np.abs(moved).max(), moved.dtype, 4)
        close((start.base + fields.change)[pulls], 0.0, np.abs(start.base).max() + np.abs(p).max(), p.dtype)
        assert (moved[~kept] == 0).all()
        assert (fields.change[~kept] == 0).all()
    if a is not None:
        # Both round sums of single numbers, one of them one by one in single precision.
        close(a, b, np.abs(p).sum() if conserve else 0.0, p.dtype)
    np.testing.assert_array_equal(start.base, given_base)


@many
@given(givens())
def test_the_force_is_kept(start):
    """As far as the rest of the cells may take it, whatever they carry."""
    for fields in start.both():
        moved = fields.let_go(True)
        if moved is None or fields.is_empty():
            continue
        size = np.abs(moved.astype(np.float64)).sum() + np.abs(start.p).sum()
        close(moved.sum(dtype=np.float64), 0.0, size, moved.dtype)
        force = [(start.base.astype(np.float64) + c).sum() for c in (fields.change, start.change)]
        close(*force, size + np.abs(start.change).sum(), moved.dtype)


@many
@given(givens())
def test_cells_are_let_go_again(start):
    """What moved once moves no more, and is not in what moves next."""
    for fields in start.both():
        first = fields.let_go(False)
        before = None if first is None else first.copy()
        fields.change[...] -= start.t * fields.inside
        p = start.base + fields.change
        pulls = start.kept & ~start.pulls & (p < 0)
        moved = fields.let_go(False)
        if moved is None:
            assert not pulls.any()
        else:
            np.testing.assert_array_equal(moved, np.where(pulls, -p, 0.0))
        if first is not None:
            np.testing.assert_array_equal(first, before)
        is_on(fields, start.kept & ~start.pulls & ~pulls)


@pytest.mark.parametrize("order", ["C", "F"])
def test_bounds_may_lie_otherwise_in_memory(order):
    rng = np.random.default_rng(6)
    kept = rng.random((9, 14)) < 0.6
    base, change = (np.array(kept * f, order=order) for f in rng.standard_normal((2, 9, 14)))
    lacking, displacement = (np.array(f, order=order) for f in rng.standard_normal((2, 9, 14)))
    for fields in both_of(Seeing, np.array(kept, order=order), lacking, base):
        fields.change[...] += change
        moved = fields.let_go(False)
        rest = kept & ~(kept & (base + change < 0))
        np.testing.assert_array_equal(fields.inside > 0, rest)
        np.testing.assert_array_equal(moved, np.where(kept & ~rest, -(base + change), 0.0))
        fields.follow(displacement)
        np.testing.assert_array_equal(fields.r, lacking - displacement)
        fields.take_in(0.5)
        np.testing.assert_array_equal(fields.inside > 0, rest | (lacking - displacement > 0.5))


def test_new_cells_share_alike():
    """They carry nothing yet, so nothing tells their shares."""
    kept, base = np.ones((4, 9), bool), np.zeros((4, 9))
    change = np.where(np.arange(36).reshape(4, 9) < 6, -3.0, 0.0)
    for fields in both_of(Seeing, kept, base, base):
        fields.change[...] += change
        moved = fields.let_go(True)
        np.testing.assert_allclose(moved.ravel()[:6], 3.0)
        np.testing.assert_allclose(moved.ravel()[6:], -6 * 3.0 / 30)
        np.testing.assert_array_equal(fields.change, change + moved)


@many
@given(givens(), st.sampled_from([0.0, 0.3, 5.0]))
def test_the_same_cells_are_taken_in(start, least):
    lacking, new = start.lacking, ~start.kept & (start.lacking > least)
    for fields in start.both():
        assert fields.take_in(least) == (lacking[new].max() if new.any() else 0.0)
        is_on(fields, start.kept | new)
        np.testing.assert_array_equal(fields.t, start.t)
        np.testing.assert_array_equal(fields.change, start.change)
        np.testing.assert_array_equal(fields.r, lacking)


@many
@given(givens(), st.booleans())
def test_what_is_lacking_follows_and_is_levelled(start, conserve):
    """Everywhere, outside the region too; inside, no mean is left where the force is kept."""
    kept = start.kept
    for fields in start.both():
        if start.pulls.any():
            fields.let_go(False)
        rest = kept & ~start.pulls
        fields.follow(start.p)
        precision, size = start.p.dtype, np.abs(start.lacking).max() + np.abs(start.p).max()
        wanted = start.lacking.astype(np.float64) - start.p
        close(fields.r, wanted, size, precision, 2)
        if conserve and not rest.any():
            continue
        assert fields.begin(conserve) == 0.25 * rest.sum()
        if conserve:
            wanted -= wanted[rest].mean()
        close(fields.r, wanted, size, precision)
        is_on(fields, rest)


@many
@given(givens())
def test_letting_go_and_taking_in_by_turns(start):
    one, two = start.both()
    for turn in range(3):
        for fields in (one, two):
            # From the same numbers each time: what moved may differ in its last digit.
            fields.change[...] = start.change * turn
            fields.r[...] = start.lacking * (turn - 1)
            fields.let_go(False)
            fields.take_in(0.2)
        np.testing.assert_array_equal(one.inside, two.inside)
        for fields in (one, two):
            is_on(fields, two.inside > 0)


def test_cells_at_the_hardness():
    """They are let go of from above, hold it, share nothing, and are free again where they lack too little."""
    p = np.array([[-1.0, 1.0, 2.0, 5.0, 3.5, 0.0]])
    kept, held = np.array([[1, 1, 1, 1, 0, 0]], bool), np.array([[0, 0, 0, 0, 1, 0]], bool)
    lacking = np.array([[0.1, 0.0, 0.0, 0.2, -0.5, 0.3]])
    fields = on(Seeing, kept, lacking, np.minimum(p, 3.5), held, 3.5)
    fields.change += p - np.minimum(p, 3.5)
    fields.t[...] = kept
    # The first takes one more and the fourth 1.5 less: two cells share the half, as they carry.
    np.testing.assert_allclose(fields.let_go(True), [[1.0, 0.5 / 3, 1.0 / 3, -1.5, 0.0, 0.0]], atol=1e-15)
    np.testing.assert_allclose(np.minimum(p, 3.5) + fields.change, [[0, 3.5 / 3, 7 / 3, 3.5, 3.5, 0]])
    np.testing.assert_array_equal(fields.inside, [[0, 1, 1, 0, 0, 0]])
    np.testing.assert_array_equal(fields.t, fields.inside)
    np.testing.assert_array_equal(fields.held, [[0, 0, 0, 1, 1, 0]])
    assert fields.take_in(0.25) == 0.5
    np.testing.assert_array_equal(fields.inside, [[0, 1, 1, 0, 1, 1]])
    np.testing.assert_array_equal(fields.held, [[0, 0, 0, 1, 0, 0]])
