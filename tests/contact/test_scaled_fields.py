"""Fields of a solve for what is lacking of a depth: how they begin, and the pressure that they end as."""

from dataclasses import dataclass
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from regions import close, plane, region
from roughcontact.kernels import loader
from roughcontact.kernels.constants import NEVER
from roughcontact.solver.compiled_vectors import CompiledVectors
from roughcontact.solver.control import Depth, Force, Specification
from roughcontact.solver.inner_operator import FullGrid
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.optimality import Iterate
from roughcontact.solver.vectors import ArrayVectors, scaled_vectors

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

many = settings(max_examples=60, deadline=None, derandomize=True)


@dataclass(frozen=True)
class Asked:
    """What a solve is asked to begin with: a driver, what is asked, who is free, and what there is so far."""

    driver: FullGrid
    spec: Specification
    kept: np.ndarray
    start: np.ndarray
    separation: np.ndarray
    displacement: np.ndarray
    otherwise: float = 1e-3

    @property
    def precision(self):
        return self.driver.scaled(np.empty(0)).dtype

    @property
    def depth(self):
        return (
            (self.separation + self.displacement)[self.kept].mean()
            if self.spec.depth is None
            else self.spec.depth
        )

    def fields(self):
        measure = Measure(self.driver.weights)
        trial = Iterate(self.start, self.displacement, self.separation)
        return scaled_vectors(self.driver, measure, self.spec, self.kept, trial, otherwise=self.otherwise)

    def both(self):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(loader, "is_available", lambda: False)
            two = self.fields()
        one = self.fields()
        assert isinstance(one[0], CompiledVectors)
        assert isinstance(two[0], ArrayVectors)
        return one, two


@st.composite
def asked(draw):
    shape = draw(st.integers(1, 17)), draw(st.integers(1, 30))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    there = rng.random(shape) >= draw(st.sampled_from([0.0, 0.2]))
    kept = there & (rng.random(shape) < draw(st.sampled_from([0.05, 0.6, 1.0])))
    kept.ravel()[0] = there.ravel()[0] = True
    carries = there & (rng.random(shape) < draw(st.sampled_from([0.0, 0.05, 0.7])))
    start = carries * np.abs(rng.standard_normal(shape)) * draw(st.sampled_from([1e-9, 1.0, 1e9]))
    separation = np.where(there, np.abs(rng.standard_normal(shape)), np.inf)
    driver = draw(st.sampled_from([FullGrid, partial(FullGrid, single=True)]))(plane(shape))
    spec = Specification(draw(st.sampled_from([Force(1.0), Depth(0.3)])))
    return Asked(driver, spec, kept, start, separation, rng.standard_normal(shape))


@many
@given(asked())
def test_scaled_fields(start):
    """The largest lack inside is one, a missing cell never lacks any, and pressures are in the same unit."""
    level, kept, precision = start.separation + start.displacement, start.kept, start.precision
    given_fields = [f.copy() for f in (kept, start.start, start.separation, start.displacement)]
    size = np.abs(level[kept]).max() + abs(start.depth)
    error = level.size * np.finfo(np.float64).eps * size  # of a mean
    there, finite = np.isfinite(start.separation), np.where(np.isfinite(level), level, 0.0)
    for fields, unit in start.both():
        lacking = start.depth - level[kept]
        largest = np.abs(lacking).max()
        assert unit == pytest.approx(largest or start.otherwise, rel=0, abs=error)
        if largest < 2 * error:  # nothing but rounding
            continue
        assert fields.free.dtype == fields.r.dtype == fields.correction.dtype == precision
        np.testing.assert_array_equal(fields.free, kept)
        assert not fields.correction.any()
        assert fields.upper is None
        assert (fields.r[~there] == np.array(NEVER, precision)).all()
        # Each number is rounded in its precision, beside what is off in double precision, in a unit.
        wanted = (start.depth - finite) / unit
        bound = (
            np.finfo(precision).eps * np.abs(wanted) + 4 * (error + np.finfo(np.float64).eps * size) / unit
        )
        assert (np.abs(fields.r - wanted)[there] <= bound[there] * (1 + np.abs(wanted[there]))).all()
        assert fields.residual_max() == pytest.approx(1.0, rel=0, abs=float(2 * np.finfo(precision).eps))
        fields.correction[...] = 0.0
        close(fields.pressure(start.start, unit), start.start * kept, start.start.max(), "float64", 0)
    for one, other in zip(
        given_fields, (kept, start.start, start.separation, start.displacement), strict=True
    ):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("kind", [FullGrid, partial(FullGrid, single=True)])
@pytest.mark.parametrize(("otherwise", "wanted"), [(0.0, 1.0), (1e-3, 1e-3)])
@pytest.mark.parametrize("spec", [Specification(Force(1.0)), Specification(Depth(0.25))])
def test_the_unit_where_nothing_is_lacking(kind, otherwise, wanted, spec):
    """Cells outside lack some, or what they have too much."""
    kept = region((5, 9))
    level, start = np.where(kept, 0.25, 3.0), np.full((5, 9), 0.75)
    given = kind(plane((5, 9))), spec, kept, start, level, np.zeros((5, 9)), otherwise
    for fields, unit in Asked(*given).both():
        assert unit == wanted
        assert fields.residual_max() == 0.0
        close(fields.r, np.where(kept, 0.0, -2.75 / wanted), 3 / wanted, fields.r.dtype, 2)
        assert fields.bound_violation() == pytest.approx(0.75 / wanted)
        whole = fields.restart()
        fields.precondition()
        bound_correction, area, force = fields.project(0.0, 0.0, 1.0)
        assert fields.s[~kept] == pytest.approx(-0.75 / wanted)
        assert not fields.s[kept].any()
        assert bound_correction == pytest.approx(0.75 / wanted * (~kept).sum())
        assert force == pytest.approx(-bound_correction * given[0].weights)
        assert area == whole == pytest.approx(kept.sum() * given[0].weights)


def lifted_alone(fields, force_given):
    """Return a step that only takes pressures to their bounds; those inside share what that takes of the force."""
    fields.restart()
    found = fields.project(0.0, 0.0, 0.0)
    if force_given and found.bound_correction:
        fields.redistribute(found.force)
    return fields.s


@many
@given(asked(), st.booleans())
def test_the_same_pressure_is_left(start, force_given):
    """By cells outside, where they have some; where the force is kept those inside share it as they carry, or alike."""
    (one, unit), (two, other) = start.both()
    kept, precision = start.kept, start.precision
    if unit < 1e-6:  # nothing but rounding
        return
    leaves = ~kept & (start.start > 0)
    for fields, by in ((one, unit), (two, other)):
        base = (start.start / by).astype(precision).astype(np.float64)
        assert fields.bound_violation() == pytest.approx(
            base[~kept].max(initial=0.0), rel=float(2 * np.finfo(precision).eps)
        )
        moved = lifted_alone(fields, force_given)
        np.testing.assert_array_equal(fields.free, kept)
        assert moved.dtype == precision
        lost, carried = base[leaves].sum(), base[kept].sum()
        shares = kept * (base / carried if carried > 0 else 1 / kept.sum())
        wanted = np.where(leaves, -base, shares * lost * force_given)
        # One in single precision sums one by one; a unit is turned over, or not.
        size = base + shares * lost
        assert (np.abs(moved - wanted) <= (20 + base.size / 8) * np.finfo(precision).eps * size).all()
        assert (moved[~kept & ~leaves] == 0).all()
        assert not fields.correction.any()
        lacking = fields.r.copy()
        fields.inner_products(np.zeros_like(lacking))
        fields.advance(1.0, 0.0)
        np.testing.assert_array_equal(fields.r, lacking)
        assert fields.bound_violation() == 0
        is_left = fields.pressure(start.start, by)
        assert (is_left[~kept] == 0).all()
        if not force_given:
            np.testing.assert_array_equal(is_left[kept], start.start[kept])


@many
@given(asked())
def test_the_same_pressure_comes_out(start):
    """In double precision, with the change, nowhere negative, and none outside."""
    kept, unit = start.kept, 0.3
    change = np.random.default_rng(kept.size).standard_normal(kept.shape).astype(start.precision)
    wanted = np.where(kept, np.maximum(start.start + unit * change.astype(np.float64), 0.0), 0.0)
    for fields, _ in start.both():
        fields.correction[...] = change
        found = fields.pressure(start.start, unit)
        assert found.dtype == np.float64
        size = start.start + unit * np.abs(change)
        assert (np.abs(found - wanted) <= 2 * np.finfo(np.float64).eps * size).all()
        assert (found >= 0).all()
        assert (found[~kept] == 0).all()
        np.testing.assert_array_equal(fields.correction, change)


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("kind", [FullGrid, partial(FullGrid, single=True)])
def test_what_scaled_fields_are_made_of_may_lie_otherwise(order, kind):
    rng = np.random.default_rng(8)
    kept, (start, separation, displacement) = rng.random((9, 14)) < 0.5, rng.random((3, 9, 14))
    answers = []
    for lay in ("C", order):
        given = (np.array(f, order=lay) for f in (kept, start, separation, displacement))
        fields, unit = Asked(kind(plane((9, 14))), Specification(Force(1.0)), *given).fields()
        moved = lifted_alone(fields, True)
        answers.append((unit, fields.r, moved, fields.pressure(np.array(start, order=lay), unit)))
    for one, other in zip(*answers, strict=True):
        np.testing.assert_array_equal(one, other)
