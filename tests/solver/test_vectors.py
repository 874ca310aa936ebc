"""Fields of a solve: machine code does what arrays of any library do, and so do whole solves."""

import numpy as np
import pytest

import roughcontact as rc
from libraries import Strict
from regions import PRECISIONS, Bare, Seeing, both_of, close, eighths, generic, on, plane, region
from roughcontact.arrays import namespace
from roughcontact.kernels import loader
from roughcontact.solver import tuning
from roughcontact.solver.compiled_vectors import CompiledVectors
from roughcontact.solver.conjugate_gradients import conjugate_gradients
from roughcontact.solver.inner_operator import FullGrid
from roughcontact.solver.inner_product import Measure, Products, Projected
from roughcontact.solver.vectors import ArrayVectors, vectors_on

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("begun", [False, True], ids=["from nothing", "from a direction"])
@pytest.mark.parametrize("force_given", [False, True])
def test_sums_and_fields_are_the_same(precision, begun, force_given):
    """Step by step; sums may differ by the rounding of each of their terms, of which there are some 300."""
    driver, rng = Bare(plane()), np.random.default_rng(1)
    kept = region((21, 34))
    r, t, v = rng.standard_normal((3, 21, 34)).astype(precision)
    one, two = both_of(driver, kept, r, kept * np.array(1e6, precision))  # no cell comes near to a bound

    def same(a, b, size=None):
        close(a, b, np.abs(b).max() if size is None else size, precision, 300)

    area = one.restart()
    assert area == two.restart() == pytest.approx(driver.weights * kept.sum())
    np.testing.assert_array_equal(one.r, r)
    np.testing.assert_array_equal(two.r, r)
    np.testing.assert_array_equal(one.free, two.free)
    assert one.residual_max() == two.residual_max() == np.abs(two.r[kept]).max()
    for fields in (one, two):
        if begun:
            fields.s[...] = kept * t
            fields.inner_products(v.copy())
    # Where there is no direction yet, v is what is lacking, of which all may cancel.
    same(one.inner_products(one.q), two.inner_products(two.q), driver.weights * np.abs(r).sum())
    if force_given:
        same(one.constraint_direction(), two.constraint_direction())
    for beta, shift, step, alpha, mean in ((0.0, 0.5, 0.75, 0.25, 0.0), (0.75, -0.25, 1.5, 0.5, 0.125)):
        a, b = one.precondition(), two.precondition()
        same(a[:3], b[:3])
        if force_given:
            same(
                a.wq,
                b.wq,
                driver.weights * np.abs(two.q).sum() * np.abs(a.z_sum / one.constraint_direction()),
            )
        found = one.project(beta, shift, step), two.project(beta, shift, step)
        assert found[0] == found[1] == Projected(0.0, area, 0.0)
        same(one.s, two.s)
        assert (one.s[~kept] == 0).all()
        direction = np.array(two.s)
        one.s[...] = two.s[...] = direction
        answer = driver.apply(direction)
        same(one.inner_products(answer), two.inner_products(answer.copy()))
        same(one.advance(alpha, mean), two.advance(alpha, mean))
        same(one.correction, two.correction)
        same(one.r, two.r)


@pytest.mark.parametrize("compiled", [True, False], ids=["compiled", "generic"])
@pytest.mark.parametrize("precision", PRECISIONS)
def test_what_is_measured(compiled, precision):
    """Sums over the free cells; a direction that has something outside counts in its products alone."""
    kept, rng = region((9, 14)), np.random.default_rng(9)
    r, t, v, strays = (eighths(rng, (9, 14), precision) for _ in range(4))
    # Where cells are under pressure, they are looked at.
    fields = (on if compiled else generic)(Seeing, kept, r, np.abs(strays))
    fields.restart()
    fields.s[...] = t * (kept | (strays != 0))
    t, inside = fields.s.astype(np.float64), kept.astype(np.float64)
    pairs = (t, v), (inside, v), (t, r), (inside * t, r), (inside, t), (inside, r)
    wanted = [(a * b).sum() / 4 for a, b in pairs]
    assert fields.inner_products(v) == Products(*wanted)
    np.testing.assert_array_equal(fields.q, v)


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("force_given", [False, True])
def test_relief_is_taken_off_the_diagonal(precision, force_given):
    """Of what the inverse answers, by what it answers to a constant; sums go over some 300 terms."""
    driver = FullGrid(plane())
    kept = region((21, 34))
    r = np.random.default_rng(3).standard_normal((21, 34)).astype(precision)
    fields = on(driver, kept, r)
    fields.residual_max()
    if force_given:
        fields.constraint_direction()
    cells = np.flatnonzero(kept)
    near, w = np.zeros((len(cells), len(cells))), driver.local_inverse.near
    # Rows follow rows in memory: the cell beyond the end of one is the first of the next.
    for dy in range(-2, 3):
        for dx in range(-2, 3):
            near[cells[:, None] - cells[None, :] == 34 * dy + dx] = w[abs(dy), abs(dx)]
    wanted = (near - driver.diagonal_correction * np.diag(near.sum(axis=0))) @ r.ravel()[cells].astype(
        np.float64
    )
    descent, _, total, _ = fields.precondition()
    error, area = r.ravel()[cells].astype(np.float64), driver.weights
    size = np.abs(near) @ np.abs(error)
    close(fields.update_direction(0.0).ravel()[cells], wanted, size.max(), precision)
    close(descent, area * (error @ wanted), area * (np.abs(error) @ size), precision)
    close(total, area * wanted.sum(), area * size.sum(), precision)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_outside_nothing_changes_but_the_lack(precision):
    driver = FullGrid(plane())
    kept = region((21, 34), share=0.1)
    r = np.random.default_rng(2).standard_normal((21, 34)).astype(precision)
    fields = on(driver, kept, r)
    fields.residual_max()
    fields.precondition()
    v = driver.apply(fields.update_direction(0.0)).astype(precision)
    fields.inner_products(v)
    fields.advance(0.5, 0.25)
    assert (fields.correction[~kept] == 0).all()
    assert (fields.s[~kept] == 0).all()
    np.testing.assert_array_equal(fields.free, kept)
    wanted = r.astype(np.float64) - 0.5 * (v.astype(np.float64) - 0.25)
    close(fields.r, wanted, 4 + np.abs(v).max(), precision)


@pytest.mark.parametrize("compiled", [True, False], ids=["compiled", "generic"])
def test_what_one_solve_shared_the_next_does_not(compiled):
    """At given displacement nothing is shared, whatever was so at given force."""
    driver, kept = Bare(plane()), region((21, 34))
    r = np.random.default_rng(7).standard_normal((21, 34))
    fields = (on if compiled else generic)(driver, kept, r, 1e6 * kept)
    fields.restart()
    fields.constraint_direction()
    fields.restart()
    fields.residual_max()
    fields.precondition()
    alike = fields.update_direction(0.0).copy()
    fields.project(0.0, 0.5, 1.0)
    np.testing.assert_array_equal(fields.s, alike)


def test_what_is_shared_is_remembered(monkeypatch):
    """As long as hardly a cell is lost, and none is taken in; its sum is that over the cells that are left."""
    monkeypatch.setattr(tuning, "STALE_CONSTRAINT_DIRECTION", 0.01)
    asked = [0]

    class Counting(Seeing):
        @classmethod
        def approximate_inverse(cls, displacement):
            asked[0] += 1
            return cls.part * np.arange(400.0).reshape(displacement.shape) * displacement

    def lose(count):
        """Lose so many cells, in order; return what is shared on the rest, all told, and how often that was asked."""
        fields.constraint_direction()
        fields.s[...] = 0.0
        fields.s.ravel()[np.flatnonzero(fields.free)[:count]] = -2.0
        fields.project(1.0, 0.0, 1.0)
        before = asked[0]
        total = fields.constraint_direction()
        return total, asked[0] - before

    def shared_now():
        """Return what the cells share, by what a step takes off."""
        fields.s[...] = 0.0
        fields.project(0.0, -8.0, 1.0)
        return 0.25 * (fields.s * fields.free).sum() / 8

    fields = on(Counting, np.ones((20, 20), bool), np.zeros((20, 20)), np.ones((20, 20)))
    whole = 0.25 * Seeing.part * np.arange(400.0)
    fields.restart()
    fields.residual_max()
    fields.precondition()
    assert fields.constraint_direction() == shared_now() == whole.sum()
    assert lose(0) == (whole.sum(), 0)
    assert lose(1) == (whole[1:].sum(), 0)
    assert shared_now() == whole[1:].sum()
    assert fields.restart() == 0.25 * 399
    assert lose(2) == (whole[3:].sum(), 0)  # three of 397 are less than a hundredth
    assert shared_now() == whole[3:].sum()
    assert lose(1) == (whole[4:].sum(), 1)
    assert shared_now() == whole[4:].sum()
    assert lose(1) == (whole[5:].sum(), 0)
    assert lose(100) == (whole[105:].sum(), 1)
    fields.r[0, 0] = 1.0
    assert fields.free_violated(0.5) == 1.0
    before = asked[0]
    assert fields.constraint_direction() == whole[105:].sum() + whole[0]
    assert asked[0] == before + 1


def test_what_is_shared_is_remembered_while_nothing_is():
    kept, zeros = np.ones((20, 20), bool), np.zeros((20, 20))
    fields = on(Seeing, kept, zeros, zeros)
    fields.restart()
    assert fields.constraint_direction() == 0.25 * Seeing.part * 400 * 400
    fields.restart()
    fields.residual_max()
    fields.precondition()
    fields.s[0, 0] = -1.0
    fields.project(1.0, 0.0, 1.0)
    assert fields.constraint_direction() == 0.25 * Seeing.part * 400 * 399


def test_without_machine_code_it_is_remembered_until_many_cells_are_lost():
    asked = []

    class Counting(Seeing):
        @classmethod
        def approximate_inverse(cls, displacement):
            asked.append(displacement.sum())
            return super().approximate_inverse(displacement)

    def after_losing(count):
        """Lose so many cells; return the sum that is shared on the rest, over that of one cell."""
        fields.s[...] = 0.0
        fields.s.ravel()[np.flatnonzero(fields.free)[:count]] = -2.0
        fields.project(1.0, 0.0, 1.0)
        return fields.constraint_direction() / (0.25 * Seeing.part)

    fields = generic(Counting, np.ones((20, 20), bool), np.zeros((20, 20)), np.ones((20, 20)))
    fields.restart()
    fields.constraint_direction()
    fields.residual_max()
    fields.precondition()
    assert asked.pop(0) == 400
    asked.clear()
    assert after_losing(12) == 400 * 388  # three of a hundred are few enough
    assert asked == []
    assert after_losing(1) == 387 * 387
    assert asked == [387]


def test_what_has_no_machine_code():
    """Cells of many sizes, a hardness, and other libraries."""
    ring, ones = FullGrid(rc.ring(rc.RadialGrid.uniform(33, 3.0), 2.0)), np.ones(33)
    kept = ones > 0
    assert isinstance(on(ring, kept, ones), ArrayVectors)
    held = np.arange(33) == 3
    hard = on(Seeing, kept & ~held, ones, ones, held, 3.0)
    assert isinstance(hard, ArrayVectors)
    np.testing.assert_array_equal(hard.upper, held)
    there = [Strict.put(f) for f in (ones, ones)]
    elsewhere = vectors_on(Seeing, Measure(0.25, namespace(there[0])), there[0] > 0, *there)
    assert isinstance(elsewhere, ArrayVectors)
    assert all(Strict.is_there(f) for f in (elsewhere.free, elsewhere.correction, elsewhere.r, elsewhere.s))
    assert isinstance(on(Seeing, kept, ones), CompiledVectors)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("seed", [0, 1])
def test_both_solve_the_same_system_to_the_same_limit(periodic, seed):
    """Whatever the sign of the pressure."""
    operator = plane((20, 24), periodic)
    kept = region((20, 24), seed, 0.5)
    lacking = np.random.default_rng(seed).standard_normal((20, 24))
    limit = 1e-9
    matrix = operator.as_matrix(np.flatnonzero(kept))
    wanted = np.zeros((20, 24))
    wanted[kept] = np.linalg.solve(matrix, lacking[kept])
    # The answer is off by no more than the inverse makes of what is lacking.
    bound = np.sqrt(kept.sum()) * limit / np.linalg.eigvalsh(matrix)[0]

    driver = FullGrid(operator)
    for fields in both_of(driver, kept, lacking):
        largest, steps = conjugate_gradients(driver, fields, limit=limit, max_steps=200)
        assert largest <= limit
        assert largest == np.abs(fields.r[kept]).max()
        assert 0 < steps < 60
        left = lacking - operator.apply(fields.correction)
        assert np.abs(left[kept]).max() < 1.01 * limit
        np.testing.assert_allclose(fields.r, left, rtol=0, atol=1e-12)
        assert (fields.correction[~kept] == 0).all()
        assert np.linalg.norm(fields.correction - wanted) < bound


def test_both_solve_in_single_precision():
    operator, kept = plane((40, 50)), region((40, 50), 3, 0.5)
    lacking = np.random.default_rng(3).standard_normal((40, 50)).astype(np.float32)
    driver = FullGrid(operator, single=True)
    for fields in both_of(driver, kept, lacking):
        largest, _ = conjugate_gradients(driver, fields, limit=1e-3, max_steps=100)
        assert largest <= 1e-3
        assert fields.correction.dtype == fields.r.dtype == fields.free.dtype == np.float32
        left = lacking - operator.apply(fields.correction.astype(np.float64))
        assert np.abs(left[kept]).max() < 1.1e-3


def test_a_solve_that_stops_on_its_way_takes_no_other():
    """The next direction is conjugate to the last: begun anew, the change after so few steps would be far off."""
    operator, kept = plane((20, 24)), region((20, 24), 4, 0.5)
    lacking, driver = np.random.default_rng(4).standard_normal((20, 24)), FullGrid(operator)
    for one, two in zip(*(both_of(driver, kept, lacking) for _ in range(2)), strict=True):
        conjugate_gradients(driver, one, limit=0.0, max_steps=6)
        for steps in (2, 3, 1):
            conjugate_gradients(driver, two, limit=0.0, max_steps=steps)
        # Sums of 240 terms, in six steps.
        close(two.correction, one.correction, np.abs(one.correction).max(), "float64", 6 * 240)
        conjugate_gradients(driver, one, limit=0.0, max_steps=1)
        assert np.abs(two.correction - one.correction).max() > 1e-6 * np.abs(one.correction).max()


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("compiled", [True, False], ids=["compiled", "generic"])
def test_fields_may_lie_otherwise_in_memory(order, compiled):
    operator, kept = plane((20, 24)), region((20, 24), 4, 0.5)
    lacking, driver = np.random.default_rng(4).standard_normal((20, 24)), FullGrid(operator)
    given = (np.array(f, order=order) for f in (kept, lacking, np.zeros((20, 24))))
    fields = (on if compiled else generic)(driver, *given)
    conjugate_gradients(driver, fields, limit=1e-9, max_steps=200)
    left = lacking - operator.apply(fields.correction)
    assert np.abs(left[kept]).max() < 1.01e-9


def test_what_needs_no_change_gets_none():
    driver, kept = FullGrid(plane((20, 24))), region((20, 24), 4, 0.5)
    lacking = np.where(kept, 1e-3, 5.0)
    for fields in both_of(driver, kept, lacking):
        assert conjugate_gradients(driver, fields, limit=2e-3, max_steps=10) == (1e-3, 0)
        assert (fields.correction == 0).all()
        assert (fields.s == 0).all()
        np.testing.assert_array_equal(fields.r, lacking)
