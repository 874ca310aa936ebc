"""One step of tangential loading: what is asked, and how far an answer is from it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.contact.optimality import UNITS
from roughcontact.contact.status import Status
from roughcontact.contact.tangential.coulomb import lengths, under_force, violations, within
from roughcontact.contact.tangential.interface import Interface
from roughcontact.contact.tangential.multiplier import common_displacement

__all__ = ["Slipped", "Step"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Step:
    """One step of tangential loading, from a state of rest to another.

    Parameters
    ----------
    interface : Interface
    limit : array, shape (n,)
        Largest traction of each cell [Pa].
    traction, slip : array, shape (k, n)
        Where the step starts [Pa], and how far the cells have slipped until then [m].
    force, shift : array, shape (k,), or None
        One of them: the force [N] or the displacement of the bodies [m] at the end of the step.
    scale : float
        Largest displacement of a cell at the start [m].
    tolerance : float
        Largest residual.
    """

    interface: Interface
    limit: Array
    traction: Array
    slip: Array
    force: Array | None
    shift: Array | None
    scale: float
    tolerance: float

    def admitted(self, traction: Array) -> Array:
        """Return the nearest traction that friction can hold, under the force if one is given."""
        if self.force is None:
            return within(traction, self.limit)
        return under_force(traction, self.limit, self.force / self.interface.area)

    def shift_of(self, displacement: Array, normal: Array) -> Array:
        """Return the displacement of the bodies [m]: the one that is given, or that belongs to a traction.

        `normal` are unit vectors of the traction in the cells at their limit, zero elsewhere.
        """
        if self.shift is not None:
            return self.shift
        level = displacement - self.slip
        return common_displacement(level, normal, self.limit, self.interface.self_influence)

    def slipped(self, displacement: Array, shift: Array) -> Array:
        """Return the slip of the step [m]."""
        return displacement - shift[:, None] - self.slip

    def residual(self, traction: Array, displacement: Array, shift: Array) -> float:
        """Return the largest violation of Coulomb's law relative to the largest displacement of the step.

        What is rounding of what the largest traction does in its own cell counts as no more: uniform traction on all
        cells of a period moves nothing, and there all is rounding.
        """
        violation = float(violations(traction, self.limit, self.slipped(displacement, shift)).max())
        if violation == 0:
            return 0.0
        scale = max(self.scale, float(lengths(displacement).max()))
        relative = violation / scale if scale > 0 else np.inf
        rounding = UNITS * self.interface.self_influence * float(lengths(traction).max())
        return min(relative, UNITS) if violation <= rounding else relative


@dataclass(frozen=True, slots=True, eq=False)
class Slipped:
    """The end of a step: traction [Pa], its displacement [m] on the cells, that of the bodies [m], and how good."""

    traction: Array
    displacement: Array
    shift: Array
    residual: float
    steps: int
    status: Status
