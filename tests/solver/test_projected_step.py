"""What keeps pressures within bounds: machine code and the library of the arrays do it alike, and as it is defined."""

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from regions import PRECISIONS, Seeing, both_of, close, eighths, generic, on
from roughcontact.kernels import loader
from roughcontact.kernels.constants import ROUNDINGS
from roughcontact.solver import tuning
from roughcontact.solver.inner_product import Projected

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

many = settings(max_examples=60, deadline=None, derandomize=True)
BETA, SHIFT, STEP = 0.75, 0.25, 0.5  # of eighths they make numbers that need no rounding


@dataclass(frozen=True)
class Given:
    """Fields in the midst of a solve, of eighths: who is free, what they carry, what changed it, the lack, where to."""

    kept: np.ndarray
    base: np.ndarray
    correction: np.ndarray
    lacking: np.ndarray
    t: np.ndarray

    @property
    def p(self):
        return self.base + self.correction

    @property
    def step(self):
        """How far cells would go if nothing bounded them: what sees all of an error, and shares alike, is at work."""
        z, alike = (Seeing.part * f[self.kept].sum(dtype=np.float64) for f in (self.lacking, self.kept))
        return (STEP * self.kept * (BETA * self.t + z - SHIFT * alike)).astype(self.p.dtype)

    @property
    def stays(self):
        return self.kept & (self.p + self.step >= 0)

    @property
    def bounded(self):
        return np.where(self.stays, self.step, np.where(self.kept | (self.p != 0), -self.p, 0))

    def found(self):
        """Return what there is to know of the step, once it is bounded."""
        bound_correction = self.bounded[~self.stays].astype(np.float64)
        force = (self.bounded.astype(np.float64) - self.step).sum()
        return Projected(np.abs(bound_correction).sum(), 0.25 * self.stays.sum(), 0.25 * force)

    def both(self):
        """Return both kinds of fields so far, about to take the step."""
        found = both_of(Seeing, self.kept, self.lacking, self.base)
        for fields in found:
            fields.correction[...] += self.correction
            fields.s[...] = self.t
            fields.restart()
            fields.residual_max()
            fields.constraint_direction()
            fields.precondition()
        return found


@st.composite
def givens(draw):
    shape = draw(st.integers(1, 17)), draw(st.integers(1, 30))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    kept = rng.random(shape) < draw(st.sampled_from([0.0, 0.05, 0.6, 1.0]))
    load, strays = draw(st.sampled_from([0.0, 1.0, 10.0])), draw(st.sampled_from([0.0, 0.02, 0.5]))
    precision = draw(st.sampled_from(PRECISIONS))
    base, change, lacking, t = (eighths(rng, shape, precision) for _ in range(4))
    pressed = kept | (rng.random(shape) < strays)
    return Given(kept, pressed * np.abs(base) * load, pressed * change, lacking, kept * t)


def is_on(fields, kept):
    """Whether all that hangs on the region is that of these cells, and nothing is left of an error elsewhere."""
    np.testing.assert_array_equal(fields.free > 0, kept)
    np.testing.assert_array_equal(fields.free, kept)
    precision = fields.r.dtype
    assert fields.free.dtype == precision
    assert fields.restart() == 0.25 * kept.sum()
    # What is shared may be that of a few more cells, which have been lost since.
    alike = fields.constraint_direction() / (0.25 * Seeing.part * max(1, kept.sum()))
    assert kept.sum() <= alike <= (1 + tuning.STALE_CONSTRAINT_DIRECTION) * kept.sum()
    error = (fields.r * kept).astype(np.float64)
    assert fields.residual_max() == np.abs(error).max()
    z, size, v = Seeing.part * error.sum(), Seeing.part * np.abs(error).sum(), fields.q.astype(np.float64)
    descent, overlap, total, shared = fields.precondition()
    # Each term is rounded, and each is a rounded sum times a number: as the sums of sizes, all told.
    close(descent, 0.25 * z * error.sum(), 0.25 * size * np.abs(error).sum(), precision)
    close(overlap, 0.25 * z * v[kept].sum(), 0.25 * size * np.abs(v[kept]).sum(), precision)
    close(total, 0.25 * z * kept.sum(), 0.25 * size * kept.sum(), precision)
    alike *= 0.25 * Seeing.part
    close(shared, alike * v[kept].sum(), alike * np.abs(v[kept]).sum(), precision)


@many
@given(givens())
def test_the_same_cells_are_let_go(start):
    """Those that would pull; they go to nothing, and so do others that press: no number is rounded."""
    given_base = start.base.copy()
    for fields in start.both():
        assert fields.project(BETA, SHIFT, STEP) == start.found()
        np.testing.assert_array_equal(fields.s, start.bounded)
        np.testing.assert_array_equal(fields.correction, start.correction)
        np.testing.assert_array_equal(fields.r, start.lacking)
        assert fields.s.dtype == fields.correction.dtype == start.base.dtype
        is_on(fields, start.stays)
    np.testing.assert_array_equal(start.base, given_base)


@many
@given(givens())
def test_how_far_pressures_are_out_of_bounds(start):
    for fields in start.both():
        out = np.where(start.kept, np.maximum(-start.p, 0), np.abs(start.p))
        assert fields.bound_violation() == out.max()
        fields.project(BETA, SHIFT, STEP)
        fields.inner_products(np.zeros_like(start.lacking))
        fields.advance(1.0, 0.0)
        assert fields.bound_violation() == 0


@many
@given(givens())
def test_the_force_is_kept(start):
    """What keeping to the bounds adds to it is shared by the rest of the cells, as they carry it."""
    stays, step, bounded = start.stays, start.step, start.bounded.astype(np.float64)
    total = float(bounded.sum())
    p = (start.p + bounded) * stays
    wanted = bounded - total * (p / p.sum() if p.sum() > 0 else stays / max(1, stays.sum()))
    for fields in start.both():
        fields.project(BETA, SHIFT, STEP)
        if not stays.any():
            continue
        fields.redistribute(0.25 * total)
        # A share is a ratio of sums, of which one kind rounds each term, times what cells carry.
        size = np.abs(bounded).sum() + np.abs(step).sum() + np.abs(total)
        assert fields.s.dtype == start.base.dtype
        close(fields.s, wanted, size, fields.s.dtype)
        close(fields.s.sum(dtype=np.float64), 0.0, size, fields.s.dtype)
        np.testing.assert_array_equal(fields.s[~stays], bounded[~stays])
        np.testing.assert_array_equal(fields.free, stays)


@many
@given(givens())
def test_steps_are_taken_again_and_again(start):
    """On what is left each time: what went to nothing moves no more, and is in no sum."""
    for fields in start.both():
        first = fields.project(BETA, SHIFT, STEP)
        fields.inner_products(np.zeros_like(start.lacking))
        fields.advance(1.0, 0.0)
        p, stays = start.p + start.bounded, start.stays
        fields.residual_max()
        fields.precondition()
        second = fields.project(-2.0, 0.0, 1.0)
        z = Seeing.part * (start.lacking * stays).sum(dtype=np.float64)
        step = np.where(stays, -2.0 * start.bounded + z, 0.0).astype(p.dtype)
        rest = stays & (p + step >= 0)
        wanted = np.where(rest, step, np.where(stays, -p, 0))
        np.testing.assert_array_equal(fields.s, wanted)
        assert second.area == 0.25 * rest.sum() <= first.area
        assert second.bound_correction == p[stays & ~rest].sum(dtype=np.float64)
        is_on(fields, rest)


@many
@given(givens())
def test_a_step_is_taken(start):
    """All the way or in part; what it causes is taken off everywhere, outside the region too."""
    v = start.lacking[::-1].copy()
    for fields in start.both():
        fields.project(BETA, SHIFT, STEP)
        fields.inner_products(v)
        largest = fields.advance(0.5, 0.25)
        np.testing.assert_array_equal(fields.correction, start.correction + start.bounded / 2)
        wanted = start.lacking - (v - v.dtype.type(0.25)) / 2
        np.testing.assert_array_equal(fields.r, wanted)
        assert largest == np.abs(wanted * start.stays).max()
        is_on(fields, start.stays)


@many
@given(givens(), st.sampled_from([0.0, 10.0]))
def test_what_is_listed_no_more_leaves_no_direction_behind(start, least):
    """A step takes pressures to nothing, outside too; cells that are taken in afterwards go on from no direction."""
    for fields in start.both():
        fields.project(BETA, SHIFT, STEP)
        fields.inner_products(np.zeros_like(start.lacking))
        fields.advance(1.0, 0.0)
        new = ~start.stays & (start.lacking > least)
        assert fields.free_violated(least) == (start.lacking[new].max() if new.any() else 0.0)
        np.testing.assert_array_equal(fields.s, np.where(start.stays, start.step, 0))
        is_on(fields, start.stays | new)


@pytest.mark.parametrize(
    "make",
    [
        on,
        generic,
    ],
    ids=["compiled", "generic"],
)
def test_a_step_that_is_not_taken_leaves_no_direction_behind(make):
    """As where no cell is left to take the force."""
    kept, ones = np.arange(36).reshape(4, 9) % 2 == 0, np.ones((4, 9))
    fields = make(Seeing, kept, ones, 3.0 * ones)
    fields.restart()
    fields.residual_max()
    fields.precondition()
    fields.s[...] = -4.0 * kept
    assert fields.project(1.0, 0.0, 1.0).area == 0
    assert fields.free_violated(0.5) == 1.0
    assert fields.free.all()
    assert not fields.s.any()


@pytest.mark.parametrize("precision", PRECISIONS)
def test_pressure_that_is_but_rounding_is_none(precision):
    """Inside and outside, as left over by steps that took it to nothing: see `ROUNDINGS`."""
    unit = 2 * np.finfo(precision).eps
    units = np.array([[-ROUNDINGS - 1, -ROUNDINGS, -1, 0, 1, ROUNDINGS, ROUNDINGS + 1]])
    base, zeros = np.full((1, 7), 2.0, precision), np.zeros((1, 7), precision)
    left = np.where(np.abs(units) > ROUNDINGS, units * unit, 0.0)
    for kept in (zeros > 0, zeros == 0):
        for fields in both_of(Seeing, kept, zeros, base):
            fields.correction[...] = units * unit - base
            assert fields.bound_violation() == (ROUNDINGS + 1) * unit
            fields.restart()
            fields.precondition()
            fields.s[...] = -1.0
            assert fields.project(1.0, 0.0, 1.0).bound_correction == np.abs(left).sum()
            np.testing.assert_array_equal(fields.s, -left)
            assert not fields.free.any()


@pytest.mark.parametrize("order", ["C", "F"])
def test_bounds_may_lie_otherwise_in_memory(order):
    rng = np.random.default_rng(6)
    kept = rng.random((9, 14)) < 0.6
    p, lacking, displacement, t = (np.array(eighths(rng, (9, 14), "float64"), order=order) for _ in range(4))
    for fields in both_of(Seeing, np.array(kept, order=order), lacking, np.abs(p)):
        fields.restart()
        fields.residual_max()
        fields.precondition()
        fields.s[...] = t
        fields.project(1.0, 0.0, 0.5)
        z = Seeing.part * lacking[kept].sum()
        rest = kept & (np.abs(p) + (t + z) / 2 >= 0)
        np.testing.assert_array_equal(fields.free > 0, rest)
        np.testing.assert_array_equal(fields.s, np.where(rest, (t + z) / 2, -np.abs(p)))
        fields.inner_products(displacement)
        fields.advance(1.0, 0.0)
        np.testing.assert_array_equal(fields.r, lacking - displacement)
        fields.free_violated(0.5)
        np.testing.assert_array_equal(fields.free > 0, rest | (lacking - displacement > 0.5))


def test_new_cells_share_alike():
    """They carry nothing yet, so nothing tells their shares."""
    kept, base = np.ones((4, 9), bool), np.where(np.arange(36).reshape(4, 9) < 6, 3.0, 0.0)
    for fields in both_of(Seeing, kept, np.zeros((4, 9)), base):
        fields.restart()
        fields.residual_max()
        fields.precondition()
        fields.s[...] = -4.0 * (base > 0)
        assert fields.project(1.0, 0.0, 1.0) == Projected(18.0, 0.25 * 30, 0.25 * 6)
        fields.redistribute(0.25 * -18.0)
        np.testing.assert_allclose(fields.s.ravel()[:6], -3.0)
        np.testing.assert_allclose(fields.s.ravel()[6:], 18.0 / 30)
        assert not fields.correction.any()


@pytest.mark.parametrize(
    "make",
    [
        on,
        generic,
    ],
    ids=["compiled", "generic"],
)
def test_new_cells_share_whatever_others_have_left(make):
    """Numbers that are rounded: what the new ones carry together is nothing, or next to nothing."""
    for seed in range(20):
        base = np.random.default_rng(seed).random((4, 9)) * (np.arange(36).reshape(4, 9) < 6)
        fields = make(Seeing, np.ones((4, 9), bool), np.zeros((4, 9)), base)
        fields.restart()
        fields.residual_max()
        fields.precondition()
        fields.s[...] = -4.0 * (base > 0)
        fields.project(1.0, 0.0, 1.0)
        fields.redistribute(0.25 * fields.s.sum())
        np.testing.assert_allclose(fields.s.ravel()[6:], base.sum() / 30, rtol=1e-13)


@many
@given(givens(), st.sampled_from([0.0, 0.3, 5.0]))
def test_the_same_cells_are_taken_in(start, least):
    lacking, new = start.lacking, ~start.kept & (start.lacking > least)
    for fields in start.both():
        assert fields.free_violated(least) == (lacking[new].max() if new.any() else 0.0)
        is_on(fields, start.kept | new)
        np.testing.assert_array_equal(fields.s, start.t)
        np.testing.assert_array_equal(fields.correction, start.correction)
        np.testing.assert_array_equal(fields.r, lacking)


@many
@given(givens())
def test_letting_go_and_taking_in_by_turns(start):
    """Three times, from the same pressures: each cell is where it would be by the rules alone."""
    kept = start.kept
    one, two = start.both()
    for turn in range(3):
        p, r = start.base + start.correction * turn, start.lacking * (turn - 1)
        for fields in (one, two):
            fields.correction[...] = start.correction * turn
            fields.r[...] = r
            fields.restart()
            fields.constraint_direction()
            fields.s[...] = start.t * fields.free
            fields.residual_max()
            fields.precondition()
            fields.project(1.0, 0.0, 1.0)
            fields.inner_products(np.zeros_like(r))
            fields.advance(0.0, 0.0)
            fields.free_violated(0.2)
        z = Seeing.part * (r * kept).sum(dtype=np.float64)
        kept = kept & (p + (start.t + z).astype(p.dtype) >= 0)
        kept = kept | (r > 0.2)
        for fields in (one, two):
            is_on(fields, kept)


def test_cells_at_the_hardness():
    """They are let go of from above, hold it, share nothing, and are free again where they lack too little."""
    p = np.array([[1.0, 1.0, 2.0, 3.0, 3.5, 0.0, 0.5]])
    kept, held = np.array([[1, 1, 1, 1, 0, 0, 0]], bool), np.array([[0, 0, 0, 0, 1, 0, 0]], bool)
    lacking = np.array([[0.1, 0.0, 0.0, 0.2, -0.5, 0.3, 0.0]])
    fields = on(Seeing, kept, lacking, p, held, 3.5)
    assert fields.bound_violation() == 0.5
    fields.restart()
    fields.residual_max()
    fields.precondition()
    z = Seeing.part * 0.3
    fields.s[...] = np.array([[-2.0, 0.0, 0.0, 2.0, 5.0, 5.0, 5.0]]) - z
    found = fields.project(1.0, 0.0, 1.0)
    # The first goes to nothing, and so does the last, which is not free; the fourth goes to the hardness.
    np.testing.assert_allclose(fields.s, [[-1.0, 0.0, 0.0, 0.5, 0.0, 0.0, -0.5]], rtol=0, atol=1e-15)
    np.testing.assert_allclose(found, [1.0 + 0.5 + 0.5, 0.25 * 2, 0.25 * (1.0 - 1.5 - 0.5)], atol=1e-15)
    np.testing.assert_array_equal(fields.free, [[0, 1, 1, 0, 0, 0, 0]])
    np.testing.assert_array_equal(fields.upper, [[0, 0, 0, 1, 1, 0, 0]])
    # Two cells share what is missing, as they carry.
    fields.redistribute(0.25 * -1.0)
    np.testing.assert_allclose(fields.s, [[-1.0, 1 / 3, 2 / 3, 0.5, 0.0, 0.0, -0.5]], rtol=0, atol=1e-15)
    fields.inner_products(np.zeros_like(p))
    fields.advance(1.0, 0.0)
    np.testing.assert_allclose(p + fields.correction, [[0, 4 / 3, 8 / 3, 3.5, 3.5, 0, 0]], rtol=0, atol=1e-15)
    assert fields.bound_violation() == 0
    assert not fields.s[~(fields.free > 0)].any()
    assert fields.free_violated(0.25) == 0.5
    np.testing.assert_array_equal(fields.free, [[0, 1, 1, 0, 1, 1, 0]])
    np.testing.assert_array_equal(fields.upper, [[0, 0, 0, 1, 0, 0, 0]])


def test_how_far_pressures_are_from_the_hardness():
    """Inside above it, and of cells at it on either side; what is but rounding is none."""
    zeros, unit = np.zeros((1, 3)), 4 * np.finfo(np.float64).eps  # of a hardness of four
    held = np.array([[False, True, False]])
    for at, by, wanted in (
        (0, -1.0, 0.0),
        (0, 1.0, 1.0),
        (0, -4.5, 0.5),
        (0, ROUNDINGS * unit, 0.0),
        (0, (ROUNDINGS + 2) * unit, (ROUNDINGS + 2) * unit),
        (1, 0.25, 0.25),
        (1, -0.25, 0.25),
        (1, -ROUNDINGS * unit, 0.0),
        (1, -(ROUNDINGS + 2) * unit, (ROUNDINGS + 2) * unit),
        (2, -3.75, 0.25),
        (2, -4.0, 0.0),
    ):
        base = np.where(np.arange(3) == 2, 0.0, 4.0).reshape(1, 3)
        fields = on(Seeing, np.array([[True, False, False]]), zeros, base, held, 4.0)
        base[0, 2] = 4.0 if at == 2 else 0.0
        fields.correction[0, at] = by
        assert fields.bound_violation() == wanted
