"""What a solver takes and returns: control, tolerance and hardness; pressure, residual and status."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING, Any, Protocol

from roughcontact.arrays import max_abs
from roughcontact.errors import InputError, about, joined
from roughcontact.validation import Array, require_numbers, scalar

if TYPE_CHECKING:
    from roughcontact.halfspace.operators.operator import Operator
    from roughcontact.kernels.planes import Extremes

__all__ = [
    *("Control", "Depth", "Force", "Solver", "Start", "State", "Status", "Tangent", "Specification"),
    "checked_tolerance",
]


@dataclass(frozen=True, slots=True)
class Force:
    """A prescribed normal force.

    Parameters
    ----------
    value : float
        Force that the contact carries [N], positive; on a line per unit length [N/m].

    Raises
    ------
    ValueError
        If the force is not positive and finite.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.Force(1.5)
    Force(value=1.5)
    """

    value: float

    def __post_init__(self) -> None:
        require_numbers(self, value="N")
        if not 0 < self.value < math.inf:
            raise about("the force", f"must be positive and finite [N], not {self.value}")


@dataclass(frozen=True, slots=True)
class Depth:
    """A prescribed indentation depth: the approach of the bodies since first touch.

    Parameters
    ----------
    value : float
        Depth [m], 0 or more.

    Raises
    ------
    ValueError
        If the depth is negative or not finite.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.Depth(1e-6)
    Depth(value=1e-06)
    """

    value: float

    def __post_init__(self) -> None:
        require_numbers(self, value="m")
        if not 0 <= self.value < math.inf:
            raise InputError(
                f"the depth counts from first touch: at least 0 and finite [m], not {self.value}",
                place="value",
            )


Control = Force | Depth


@dataclass(frozen=True, slots=True)
class Specification:
    """What is asked of a solver, whatever the bodies.

    Parameters
    ----------
    control : Force or Depth
        What is prescribed.
    tolerance : float
        Largest residual of a solution, see ``roughcontact.solver.optimality``.
    hardness : float or array, shape of the cells
        Pressure that no cell exceeds [Pa]; a cell that reaches it is perfectly plastic.

    Attributes
    ----------
    depth : float or None
        The prescribed depth [m]; None under a prescribed force.
    plastic : bool
        Whether there is an upper bound of the pressure.
    """

    control: Control
    tolerance: float = 1e-8
    hardness: float | Array = math.inf
    depth: float | None = field(init=False)
    plastic: bool = field(init=False)

    def __post_init__(self) -> None:
        depth = None if isinstance(self.control, Force) else self.control.value
        object.__setattr__(self, "depth", depth)
        limited = not isinstance(self.hardness, int | float) or self.hardness < math.inf
        object.__setattr__(self, "plastic", limited)

    @property
    def largest_hardness(self) -> float:
        """The hardness of the hardest cell [Pa]."""
        return self.hardness if isinstance(self.hardness, int | float) else max_abs(self.hardness)


def checked_tolerance(tolerance: Any) -> float:
    """Return a tolerance that double precision can meet and that is still small enough to mean something.

    Raises
    ------
    ValueError
        If it is outside these limits.
    """
    value = scalar(tolerance, "tolerance")
    if not 1e-14 < value < 1e-2:
        raise about("the tolerance", f"must lie between 1e-14 and 1e-2, not {value}")
    return value


class Status(Enum):
    """The outcome of a solve; `message` is a sentence about it.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.Status.CONVERGED.converged, rc.Status.MAX_STEPS.converged
    (True, False)
    >>> rc.Status.MAX_STEPS.message
    'The solver ran out of steps above the tolerance: allow it more steps.'
    """

    CONVERGED = "converged"
    NO_CONTACT = "no contact"
    MAX_STEPS = "step limit"
    STAGNATED = "stagnated"
    UNSETTLED = "unsettled"
    AFTER_MISSED = "after a missed load"

    @property
    def converged(self) -> bool:
        """Whether the answer meets the tolerance that was asked for."""
        return self in (Status.CONVERGED, Status.NO_CONTACT)

    @property
    def message(self) -> str:
        """What happened and, where something is amiss, what to do."""
        return joined(self.outcome, self.remedy) + "."

    @property
    def outcome(self) -> str:
        """What happened."""
        return _OUTCOMES[self][0]

    @property
    def remedy(self) -> str | None:
        """What to do about it; None where nothing is amiss."""
        return _OUTCOMES[self][1]


_OUTCOMES = {
    Status.CONVERGED: ("The answer meets the tolerance", None),
    Status.NO_CONTACT: ("The bodies do not touch at this depth", None),
    Status.MAX_STEPS: ("The solver ran out of steps above the tolerance", "allow it more steps"),
    Status.STAGNATED: (
        "The residual stopped falling above the tolerance: often rounding allows no more",
        "ask for a larger tolerance, or take a large offset out of the heights before they are stored; "
        "otherwise try another solver",
    ),
    Status.UNSETTLED: (
        "The hardness of the spots and the spots under that hardness did not settle on each other",
        "take a hardness that falls as spots grow, or change the load a little",
    ),
    Status.AFTER_MISSED: (
        "This load meets the tolerance on the surface that a larger load before it flattened, and that load missed "
        "the tolerance",
        "repeat the loads with a solver that is allowed more steps, or change the larger load a little",
    ),
}


@dataclass(slots=True, eq=False)
class Start:
    """Where a solve begins: a pressure [Pa] and a depth [m]; it owns the pressure until that is moved to the solve.

    Fields are large: no name keeps one that has been replaced, so that its memory is free.
    """

    pressure: Any  # an array; None once it is moved
    depth: float

    def move(self) -> Array:
        """Return the pressure, which the caller owns from now on."""
        moved: Array
        moved, self.pressure = self.pressure, None
        return moved


@dataclass(frozen=True, slots=True, eq=False)
class Tangent:
    """Pressure per unit depth [Pa/m] of the cells in contact, zero elsewhere, and its largest error inside."""

    pressure: Array
    error: float


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The end of a solver's run over the cells of its operator.

    `tangent`, `displacement` and `extremes` of the pressure are there where the solver found them on the way.
    """

    pressure: Array
    depth: float
    residual: float
    steps: int
    status: Status
    tangent: Tangent | None = None
    displacement: Array | None = None
    extremes: Extremes | None = None


class Solver(Protocol):
    """Frozen settings with one method; everything that changes during a run stays inside the run."""

    def run(self, operator: Operator, separation: Array, spec: Specification, initial: Array) -> State:
        """Solve for the pressure from an `initial` one, on the given spec."""
        ...
