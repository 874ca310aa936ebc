"""Optimality (KKT) conditions of contact: their residual, which certifies all solvers, and the active set.

The conditions are ``g >= 0, p >= 0, p g = 0`` without a hardness, with the gap ``g = A p + f - d``; under a hardness H
``p <= H``, and ``g <= 0`` where ``p = H``. See docs/concepts/method.md, section 1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

import numpy as np

from roughcontact.arrays import max_abs, namespace
from roughcontact.halfspace.operators.operator import Operator, self_influence
from roughcontact.kernels.planes import Extremes
from roughcontact.slabs.passes import Passes, passes_over
from roughcontact.solver import tuning
from roughcontact.solver.control import Force, Specification
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.projection import force_multiplier
from roughcontact.validation import Array, Mask

__all__ = ["ROUNDING_FLOOR", "Evaluation", "Iterate", "Optimality", "PredictedSet", "Quality"]


# A pressure is stored to half a unit in its last place, and so is its displacement. So at given force the gap can be no
# better than some units in the last place of what the largest pressure does in its own cell. Where uniform pressure
# moves next to nothing, on a nearly flat periodic surface, this is more than the tolerance.
ROUNDING_FLOOR = 16 * float(np.finfo(np.float64).eps)


class Iterate(NamedTuple):
    """A pressure, nowhere negative, with its displacement and the separation of the bodies.

    Attributes
    ----------
    pressure : array
        p [Pa].
    displacement : array
        u = A p [m].
    separation : array
        f, the undeformed gap [m]; infinite where a cell never touches.
    """

    pressure: Array
    displacement: Array
    separation: Array


class Evaluation(NamedTuple):
    """The residual of an iterate, and the depth at which it was found.

    Attributes
    ----------
    depth : float
        The given depth, or the multiplier of the force: the mean of u + f over the cells between the bounds [m].
    residual : float
        See `Optimality.residual`.
    scale : float
        What that is relative to: the largest displacement [m].
    extremes : Extremes, optional
        What a pass in machine code found.
    """

    depth: float
    residual: float
    scale: float
    extremes: Extremes | None = None


class Quality(Enum):
    """How good a predicted free set can be expected to be (docs/concepts/method.md, "The first prediction")."""

    GOOD = "predicted by an outer step or from a similar load, or of few cells"
    GUESSED = "predicted from a pressure on less than half as many cells, as of summits"
    BAD = "more than one cell in a hundred was left out"


@dataclass(frozen=True, slots=True, eq=False)
class PredictedSet:
    """A prediction of the free set F from an iterate.

    Attributes
    ----------
    free : bool array
        The cells of F.
    count : int
        How many they are.
    dropped : int
        How many with pressure or penetration were left out, since a projected step of one cell leaves them none.
    support : bool array
        F and all cells with pressure.
    quality : Quality
        Of the first prediction of a run; those of its own iterates are good.
    """

    free: Mask
    count: int
    dropped: int
    support: Mask
    quality: Quality = Quality.GOOD


@dataclass(frozen=True, slots=True)
class Optimality:
    """The conditions of one problem, and the residual of an iterate.

    Parameters
    ----------
    spec : Specification
    measure : Measure
        It carries the array library.
    self_influence : float
        A_ii: displacement of a cell per unit pressure on itself [m/Pa].
    passes : Passes, optional
        Over the fields, in machine code: without a hardness, for cells of one size only.
    """

    spec: Specification
    measure: Measure
    self_influence: float
    passes: Passes | None = None

    @classmethod
    def of(cls, operator: Operator, spec: Specification, separation: Array) -> Optimality:
        """Return the conditions for an operator and what is asked, on fields like the separation of the bodies."""
        measure = Measure(operator.weights, namespace(separation))
        passes = None if spec.plastic or measure.varies else passes_over(separation)
        return cls(spec, measure, self_influence(operator), passes)

    def feasible_start(self, separation: Array, initial: Array) -> Array:
        """Return `initial` without tension and without pressure on missing cells, scaled to the force (A1).

        Where nothing is left the cells of the lowest separation carry the force, or each has the pressure that by
        itself displaces it by the depth.
        """
        measure, passes, control = self.measure, self.passes, self.spec.control
        if passes is not None and passes.fit(initial, separation):
            total = float(measure.weights) * passes.positive_total(initial, separation)
            if total > 0:
                scale = control.value / total if isinstance(control, Force) else 1.0
                return passes.positive_part(initial, separation, scale)
        xp = measure.xp
        p = xp.where(xp.isfinite(separation) & (initial > 0), initial, 0.0)
        if not bool(xp.any(p > 0)):
            lowest = separation == xp.min(separation)
            lone = 1.0 if isinstance(control, Force) else control.value / self.self_influence
            p = xp.where(lowest, lone, p)
        if isinstance(control, Force):
            p *= control.value / measure.total(p)
        return p  # type: ignore[no-any-return]

    def evaluate(self, iterate: Iterate) -> Evaluation:
        """Return depth and residual of an iterate (A3, A4): in one pass in machine code where there is one."""
        spec, measure, passes = self.spec, self.measure, self.passes
        if passes is not None and passes.fit(*iterate):
            return self._evaluate_in_one_pass(iterate, passes)
        pressure, displacement, separation = iterate
        gap = displacement + separation
        between = (pressure > 0) & (pressure < spec.hardness)
        depth = force_multiplier(measure, gap, pressure, between) if spec.depth is None else spec.depth  # A3
        gap -= depth
        scale = max_abs(displacement) if math.prod(displacement.shape) else 0.0
        return Evaluation(depth, self.residual(pressure, displacement, gap), scale)  # A4

    def residual(self, pressure: Array, displacement: Array, gap: Array) -> float:
        """Return the largest violation of the conditions, relative to the largest displacement.

        That is the largest of ``|g|`` where ``0 < p < H``, of ``-g`` where ``p = 0``, and of ``g`` where ``p = H``. It
        is infinite for a pressure that is negative, beyond the hardness, infinite or NaN. It measures the error of
        the algebra, not that of the grid.
        """
        xp, hardness = self.measure.xp, self.spec.hardness
        # One of these comparisons is false for a pressure that is out of bounds, infinite or NaN.
        strongest = float(xp.max(pressure))
        limited = bool(xp.all(pressure <= hardness))
        if not (float(xp.min(pressure)) >= 0 and limited and strongest < math.inf):
            return math.inf
        open_under_pressure = float(xp.max(xp.where(pressure > 0, gap, -math.inf)))
        lowest = float(xp.min(xp.where(pressure == hardness, 0.0, gap) if self.spec.plastic else gap))
        scale = max_abs(displacement) if math.prod(displacement.shape) else 0.0
        return self.relative(max(-lowest, open_under_pressure), scale, strongest)

    def relative(self, violation: float, scale: float, strongest: float) -> float:
        """Return the residual of the largest violation [m], given the largest displacement [m] and pressure [Pa].

        At given force a violation within the rounding floor counts as that floor at most. At given depth the pressure
        has no given size, and one that diverges would raise its own floor: there is none.
        """
        if not (math.isfinite(violation) and math.isfinite(scale)):
            return math.inf
        if violation <= 0:
            return 0.0
        relative = violation / scale if scale > 0 else math.inf
        under_force = isinstance(self.spec.control, Force)
        floor = ROUNDING_FLOOR * self.self_influence * strongest if under_force else 0.0
        return min(relative, ROUNDING_FLOOR) if violation <= floor else relative

    def predict_free_set(
        self, iterate: Iterate, *, depth: float, allowed: float, first: bool = False
    ) -> PredictedSet:
        """Return the cells with pressure or with penetration beyond what is allowed [m] (A6).

        Cells at the hardness are free where their gap is more than is allowed. The `first` prediction comes from
        another grid or load: cells with ``A_ii p < g`` are left out, since one projected step of only that cell
        leaves no pressure on it.
        """
        (pressure, displacement, separation), spec = iterate, self.spec
        a_ii, passes = self.self_influence if first else math.inf, self.passes
        if passes is not None and passes.fit(*iterate):
            free, count, dropped = passes.predict_active(*iterate, depth=depth, least=-allowed, a_ii=a_ii)
            support = free | (pressure > 0) if dropped else free
        else:
            xp, carrying = self.measure.xp, pressure > 0
            gap = displacement + separation - depth
            free, dropped = carrying | (gap < -allowed), 0
            if spec.plastic:
                upper = pressure >= spec.hardness
                free = (free & ~upper) | (upper & (gap > allowed))
            if first:
                tensile = free & (pressure * a_ii < gap)
                free, dropped = free & ~tensile, int(xp.count_nonzero(tensile))
            count, support = int(xp.count_nonzero(free)), free | carrying
        quality = self._quality(count, dropped, pressure) if first else Quality.GOOD
        return PredictedSet(free, count, dropped, support, quality)

    def _quality(self, count: int, dropped: int, pressure: Array) -> Quality:
        if count <= tuning.SCREENING_CELLS:
            return Quality.GOOD
        if dropped > count / 100 and not self.measure.varies:
            return Quality.BAD
        few = self.measure.on_host and 2 * int(np.count_nonzero(pressure)) < count
        return Quality.GUESSED if few else Quality.GOOD

    def _evaluate_in_one_pass(self, iterate: Iterate, passes: Passes) -> Evaluation:
        extremes, depth = passes.extremes(*iterate), self.spec.depth
        if extremes is None or (not extremes.count and depth is None):
            return Evaluation(math.nan if depth is None else depth, math.inf, math.nan)
        if depth is None:
            depth = extremes.level / extremes.count  # A3: the mean of u + f over the cells under pressure
        residual = math.inf  # A4
        if extremes.weakest >= 0:
            violation = max(depth - extremes.lowest, extremes.highest - depth)
            residual = self.relative(violation, extremes.displacement, extremes.strongest)
        return Evaluation(depth, residual, extremes.displacement, extremes)
