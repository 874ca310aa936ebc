"""What solvers pass on: a pressure, what it does, and how good it is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from roughcontact.halfspace.operators.operator import Operator
from roughcontact.solver.control import Terms
from roughcontact.solver.status import Status

__all__ = ["Solver", "State", "Tangent"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Tangent:
    """Pressure per unit depth [Pa/m] of the cells in contact, zero elsewhere, and its largest error inside."""

    pressure: Array
    error: float


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The end of a solver's run over the cells of its operator.

    `tangent` and `displacement`, that of the pressure, are there where the solver found them on the way.
    """

    pressure: Array
    depth: float
    residual: float
    steps: int
    status: Status
    tangent: Tangent | None = None
    displacement: Array | None = None


class Solver(Protocol):
    """Frozen settings with one method; everything that changes during a run stays inside the run."""

    def run(self, operator: Operator, separation: Array, terms: Terms, initial: Array) -> State:
        """Solve for the pressure from an `initial` one, on the given terms."""
        ...
