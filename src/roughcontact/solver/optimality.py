"""The certificate: one dimensionless residual for all solvers and all operators."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import largest, namespace
from roughcontact.halfspace.operators.operator import Operator, self_influence
from roughcontact.solver.control import Force, Terms

__all__ = ["Judge"]

Array = npt.NDArray[np.float64]

# A pressure is stored to half a unit in its last place, and so is its displacement: at given force the gap
# can be no better than some units in the last place of what the largest pressure does in its own cell. Where
# uniform pressure moves next to nothing, on a nearly flat periodic surface, this is more than the tolerance.
UNITS = 16 * float(np.finfo(np.float64).eps)


@dataclass(frozen=True, slots=True)
class Judge:
    """Measures by how much a pressure violates the conditions of contact.

    Parameters
    ----------
    self_influence : float
        Displacement of a cell per unit pressure on itself [m/Pa].
    allowance : float
        Part of a cell's own displacement that is rounding.
    hardness : float
        Pressure that no cell may exceed [Pa].
    """

    self_influence: float
    allowance: float
    hardness: float = math.inf

    @classmethod
    def of(cls, operator: Operator, terms: Terms) -> Judge:
        """Return the judge of an operator and what is asked.

        At given depth nothing is allowed for rounding: the pressure has no given size there, and one that
        has run away could excuse itself.
        """
        allowance = UNITS if isinstance(terms.control, Force) else 0.0
        return cls(self_influence(operator), allowance, terms.hardness)

    def scale(self, displacement: Array) -> float:
        """Return what residuals are relative to [m]: the largest displacement."""
        return largest(displacement) if math.prod(displacement.shape) else 0.0

    def residual(self, pressure: Array, displacement: Array, gap: Array) -> float:
        """Return the largest violation of the conditions of contact, relative to the largest displacement.

        That is the largest of ``|gap|`` where there is pressure and of ``-gap`` where there is none; under the
        hardness, where the body gives way, of ``gap``. It is infinite for a negative pressure or one beyond the
        hardness, or for numbers that are none. It speaks of the algebra, not of the grid.
        """
        xp = namespace(pressure)
        # Negative or beyond the hardness, infinite or no number: one of these comparisons is false.
        strongest = float(xp.max(pressure))
        if not (float(xp.min(pressure)) >= 0 and strongest <= self.hardness and strongest < math.inf):
            return math.inf
        # Nowhere may it be negative; where there is pressure, not positive either.
        lifted = float(xp.max(xp.where(pressure > 0, gap, -math.inf)))
        yielding = self.hardness < math.inf
        lowest = float(xp.min(xp.where(pressure == self.hardness, 0.0, gap) if yielding else gap))
        return self.relative(max(-lowest, lifted), self.scale(displacement), strongest)

    def relative(self, violation: float, scale: float, strongest: float) -> float:
        """Return the residual of the largest violation [m], beside the largest displacement [m] and pressure [Pa]."""
        if not (math.isfinite(violation) and math.isfinite(scale)):
            return math.inf
        if violation <= 0:
            return 0.0
        relative = violation / scale if scale > 0 else math.inf
        rounding = self.allowance * self.self_influence * strongest
        return min(relative, UNITS) if violation <= rounding else relative
