"""Where projected conjugate gradients begin, and what watches them; the pressure that they should come to."""

from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest

from regions import generic, on, plane
from roughcontact.solver import tuning
from roughcontact.solver.bound_constrained_cg import StepEstimate, bound_constrained_cg
from roughcontact.solver.inner_operator import FullGrid, InnerOperator

SHAPE = (20, 24)
KINDS = {"compiled": on, "generic": generic}
ESTIMATES = (
    StepEstimate(),
    StepEstimate(0.3),
    StepEstimate(3.0),
    StepEstimate(0.3, known=True),
    StepEstimate(3.0, known=True),
)
both_kinds = pytest.mark.parametrize("make", KINDS.values(), ids=KINDS)
both_controls = pytest.mark.parametrize("force_given", [False, True], ids=["depth", "force"])
both_planes = pytest.mark.parametrize("periodic", [False, True], ids=["free", "periodic"])


@cache
def matrix_of(periodic):
    return plane(SHAPE, periodic).as_matrix()


def pressed(periodic, gap, depth):
    """Return the pressure under a gap: solve, flip all that pulls or penetrates, until none does.

    Then the conditions of contact hold, and no other pressure meets them.
    """
    wanted, matrix, p = (depth - gap).ravel(), matrix_of(periodic), np.zeros(gap.size)
    inside, before = wanted > 0, None
    while before is None or (inside != before).any():
        p[...], before = 0.0, inside
        p[inside] = np.linalg.solve(matrix[np.ix_(inside, inside)], wanted[inside])
        inside = np.where(inside, p > 0, wanted - matrix @ p > 0)
    return p.reshape(gap.shape)


@cache
def touching(seed, periodic):
    """Return a gap, a depth, and the pressure under it."""
    y, x = np.indices(SHAPE)
    gap = ((y - 9.5) / 10) ** 2 + ((x - 11.5) / 12) ** 2 + 0.3 * np.random.default_rng(seed).random(SHAPE)
    depth = 0.5 if periodic else 0.8
    return gap, depth, pressed(periodic, gap, depth)


class Counted:
    """A driver that counts its products."""

    def __init__(self, driver):
        self._driver, self.count = driver, 0

    def __getattr__(self, name):
        return getattr(self._driver, name)

    def apply(self, pressure):
        self.count += 1
        return self._driver.apply(pressure)


@dataclass(frozen=True)
class Start:
    """Where a descent begins, in units of what is lacking: who is free, what all carry, what is lacking."""

    driver: InnerOperator
    kept: np.ndarray
    base: np.ndarray
    lacking: np.ndarray
    force_given: bool
    gap: np.ndarray  # in that unit, too

    @classmethod
    def near(cls, seed, periodic, force_given, *, noise=0.2, rim=0.1, strays=0.05):
        """Return a start from the right pressure, with noise: other cells are free too, and others carry some."""
        gap, depth, p = touching(seed, periodic)
        rng = np.random.default_rng(seed)
        astray = (p == 0) & (rng.random(SHAPE) < strays)
        kept = ((p > 0) | (rng.random(SHAPE) < rim)) & ~astray
        p = p * np.maximum(1 + noise * rng.standard_normal(SHAPE), 0.0) + 0.2 * p.max() * astray
        level = gap + (matrix_of(periodic) @ p.ravel()).reshape(SHAPE)
        lacking = (level[kept].mean() if force_given else depth) - level
        unit = np.abs(lacking[kept]).max()
        return cls(FullGrid(plane(SHAPE, periodic)), kept, p / unit, lacking / unit, force_given, gap / unit)

    @property
    def own(self):
        return self.driver.operator.as_matrix(np.zeros(1, np.intp))[0, 0]

    def fields(self, make=on):
        return make(self.driver, self.kept, self.lacking, self.base)

    def bound_constrained_cg(self, fields, estimate=ESTIMATES[0], *, limit, max_steps=200):
        """Return what became of a descent; where it ends is what it tells, and so are the products that it took."""
        driver = Counted(self.driver)
        found = bound_constrained_cg(
            driver,
            fields,
            estimate,
            force_given=self.force_given,
            self_influence=self.own,
            limit=limit,
            max_steps=max_steps,
        )
        if found.steps == max_steps or (
            found.residual <= limit and self.own * fields.bound_violation() <= tuning.BOUND_VIOLATION * limit
        ):
            assert found.steps == driver.count
            assert found.residual == np.abs(fields.r * fields.free).max()
        return found

    def left(self, fields):
        """Return what is lacking in truth; of what is alike in the region nothing where the force is kept."""
        left = self.lacking - self.driver.operator.apply(fields.correction.astype(np.float64))
        return left - left[fields.free > 0].mean() if self.force_given else left


def within_bounds(start, fields, limit):
    """Whether no pressure pulls, and none is left where it should not be, beyond what is allowed to be left over."""
    p, free = start.base + fields.correction, fields.free > 0
    least = tuning.BOUND_VIOLATION * limit / start.own
    assert (free <= start.kept).all()
    assert p.min() >= -least
    assert np.abs(p[~free]).max() <= least
    return p, free


class Watched:
    """Fields whose books are kept: what bounds add to the force is shared out at once, and how much is moved.

    That is what may be rounded: steps, and what is taken off them for the force, to and fro.
    """

    def __init__(self, fields, weight):
        self._fields, self._weight, self._force, self._resultant, self._shared = fields, weight, 0.0, 0.0, 0.0
        self.shared, self.moved = 0, 0.0

    def __getattr__(self, name):
        return getattr(self._fields, name)

    def constraint_direction(self):
        self._resultant = self._fields.constraint_direction()
        return self._resultant

    def project(self, beta, shift, step):
        self._shared = abs(step * shift * self._resultant)
        found = self._fields.project(beta, shift, step)
        self._force = found.force
        return found

    def redistribute(self, force):
        assert force == self._force != 0
        self._shared += abs(force)
        self._fields.redistribute(force)
        self._force, self.shared = 0.0, self.shared + 1

    def inner_products(self, v):
        assert not self._force
        return self._fields.inner_products(v)

    def advance(self, alpha, mean):
        self.moved += alpha * (np.abs(self._fields.s).sum() + self._shared / self._weight)
        return self._fields.advance(alpha, mean)
