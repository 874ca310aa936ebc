"""A contact linearised on its fixed region, with the depth counted from a fixed level.

On the elastic cells c in contact, ``A_cc p_c = D + h_c`` with the depth D from a level and the heights h. All cells
carry the weights w, under which A is symmetric; t is the tangent, ``A_cc t_c = 1``, and the stiffness ``k = sum w t``.
Labels G1 to G11 are the lines of the algorithm in docs/concepts/method-derivatives.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact.arrays import as_like, max_abs
from roughcontact.cached import cached_property
from roughcontact.contact.solution import Solution
from roughcontact.contact.stiffness import TOLERANCE, FrozenContact, elastic_contact, frozen_contact
from roughcontact.errors import InputError, about
from roughcontact.halfspace.operators.operator import exact_of
from roughcontact.solver.control import Tangent
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.prescribed import prescribed_displacement
from roughcontact.validation import Array, Mask, number, shown

__all__ = ["LinearisedContact", "no_second_derivative"]

DIGITS = 10  # the tangent is at most this many times less accurate than the load


@dataclass(frozen=True, eq=False, repr=False)
class LinearisedContact:
    """The derivatives of a load at a depth from a fixed level; each is computed on first access.

    Attributes
    ----------
    solution : Solution
        With contact.
    """

    solution: Solution

    @cached_property
    def frozen(self) -> FrozenContact:
        """The response of the region to a unit displacement, about as accurate as the load."""
        known = self.solution.frozen  # G1
        if known.residual <= self.tolerance or math.isinf(known.stiffness):
            return known
        begun, operator = Tangent(known.tangent, known.residual), self.solution.problem.operator
        return frozen_contact(operator, self.region, tangent=begun, tolerance=self.tolerance)

    @property
    def tolerance(self) -> float:
        """The tolerance of the linear problems on the region."""
        return min(TOLERANCE, DIGITS * self.solution.problem.tolerance)

    @property
    def full(self) -> bool:
        """Whether all cells of a periodic surface are in contact."""
        return math.isinf(self.frozen.stiffness)

    @property
    def region(self) -> Mask:
        """The elastic cells in contact."""
        return elastic_contact(self.solution.pressure, self.solution.problem.hardness)

    @property
    def finite_stiffness(self) -> float:
        """The stiffness [N/m], if it is finite."""
        self.require_finite_stiffness()
        return self.frozen.stiffness

    def require_finite_stiffness(self) -> None:
        """Raise an error in full contact of a periodic surface."""
        if self.full:
            raise InputError(
                "in full contact of a periodic surface the stiffness is infinite, so that at a given depth there is "
                "no derivative",
                "take the derivatives at a given force",
            )

    @cached_property
    def share(self) -> Array:
        """Part of a further load that each cell takes, ``w t / k`` [1]."""
        if self.full:  # G2: a load is spread evenly
            return self._of_measured
        # G2
        return self.weighted(self.frozen.tangent) / self.frozen.stiffness

    @property
    def forces(self) -> Array:
        """Force on each cell, ``w p`` [N]: the derivative of the elastic energy with respect to its height."""
        return self.weighted(self.solution.pressure)

    @cached_property
    def closing(self) -> float:
        """Mean displacement of the measured cells per unit depth [1]."""
        return (
            0.0
            if self._moves_no_mean
            else self._measure.dot(self.frozen.tangent, self.solution.problem.mean_response)
        )

    @cached_property
    def mean_gap(self) -> Array:
        """Derivative of the mean gap with respect to the heights at a depth from the level [1]."""
        if self._moves_no_mean:
            return -self._of_measured
        mean_response = self.solution.problem.mean_response
        # G5
        return self.weighted(self._pressure_under(mean_response)) - self._of_measured

    def weighted(self, field: Array) -> Array:
        """Return a field times the weights of its cells."""
        weights = self.solution.problem.operator.weights
        return (as_like(weights, field) if isinstance(weights, np.ndarray) else weights) * field

    def pullback(
        self, pressure: Array | None, displacement: Array | None, gap: Array | None
    ) -> tuple[Array, float]:
        """Return the derivatives of a scalar with respect to heights and depth, from those to the given fields."""
        problem, xp = self.solution.problem, self._measure.xp
        none = xp.zeros_like(self.solution.pressure)
        total = none if pressure is None else self.checked(pressure, "pressure")
        moved = 0.0 if displacement is None else self.checked(displacement, "displacement")
        opened = None if gap is None else self.checked(gap, "gap")
        lifted = moved if opened is None else moved + opened
        if not isinstance(lifted, float):  # G7: by symmetry, displacements follow from pressures
            total = total + self.weighted(exact_of(problem.operator).apply(self._unweighted(lifted)))
        heights = self.weighted(self._pressure_under(self._unweighted(total)))
        depth = float(xp.sum(heights))  # G9
        return (heights, depth) if opened is None else (heights - opened, depth - float(xp.sum(opened)))

    def _pressure_under(self, displacement: Array) -> Array:
        """Return the pressure on the region that displaces it as given."""
        inside = self._measure.xp.where(self.region, displacement, 0.0)  # G8
        if not max_abs(inside):
            return inside  # type: ignore[no-any-return]
        operator = exact_of(self.solution.problem.operator)
        tolerance = max(self.frozen.residual, self.tolerance)
        return prescribed_displacement(self.region, inside, operator=operator, tolerance=tolerance).pressure

    def checked(self, given: Array, name: str) -> Array:
        """Return a given field, zero for missing cells; raise a ValueError if it does not fit."""
        problem, xp, pressure = self.solution.problem, self._measure.xp, self.solution.pressure
        if self._measure.on_host:
            given = number(given, name)
        elif not isinstance(given, type(pressure)):
            raise about(name, f"must be a {type(pressure).__name__} like the heights, not {shown(given)}")
        if tuple(given.shape) != problem.grid.shape:
            raise about(name, f"has the shape {tuple(given.shape)}, the grid {problem.grid.shape}")
        field: Array = xp.where(problem.measured, given, 0.0)
        if not bool(xp.all(xp.isfinite(field))):
            raise about(name, "must be finite for every measured cell")
        return field

    def _unweighted(self, field: Array) -> Array:
        weights = self.solution.problem.operator.weights
        return field / (as_like(weights, field) if isinstance(weights, np.ndarray) else weights)

    @property
    def _of_measured(self) -> Array:
        """Part of the measured area that each cell has."""
        measured = self.solution.problem.measured
        area = self.weighted(self._measure.xp.astype(measured, self.solution.pressure.dtype))
        return area / self._measure.total(measured)

    @property
    def _moves_no_mean(self) -> bool:
        return self.solution.problem.semidefinite and not self.solution.missing

    @property
    def _measure(self) -> Measure:
        return self.solution.problem.measure


def no_second_derivative() -> InputError:
    """Return the error for derivatives of derivatives."""
    return InputError(
        "second derivatives with respect to heights are zero, except where a cell starts to touch: there the first "
        "derivatives jump",
        "use a method that needs only first derivatives",
    )
