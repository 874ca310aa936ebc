"""What is prescribed, and what is asked of a solver."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from roughcontact.validation import scalar

__all__ = ["Control", "Depth", "Force", "Terms", "checked_tolerance"]


@dataclass(frozen=True, slots=True)
class Force:
    """Press until the contact carries `value` [N] (per unit length on a line [N/m])."""

    value: float

    def __post_init__(self) -> None:
        if not 0 < scalar(self.value, "force") < math.inf:
            raise ValueError(f"the force must be positive and finite [N], not {self.value}")


@dataclass(frozen=True, slots=True)
class Depth:
    """Press until the bodies have approached by `value` [m] since first touch."""

    value: float

    def __post_init__(self) -> None:
        if not 0 <= scalar(self.value, "depth") < math.inf:
            raise ValueError(
                f"the depth counts from first touch: at least 0 and finite [m], not {self.value}"
            )


Control = Force | Depth


@dataclass(frozen=True, slots=True)
class Terms:
    """What is asked of a solver, whatever the bodies.

    Parameters
    ----------
    control : Force or Depth
        What is prescribed.
    tolerance : float
        Largest residual of a solution, see `roughcontact.solver.optimality`.
    hardness : float
        Pressure that no cell exceeds [Pa]; a cell that reaches it gives way instead.
    """

    control: Control
    tolerance: float = 1e-8
    hardness: float = math.inf

    @property
    def depth(self) -> float | None:
        """The prescribed depth [m]; None under a prescribed force."""
        return None if isinstance(self.control, Force) else self.control.value


def checked_tolerance(tolerance: Any) -> float:
    """Return a tolerance that double precision can meet and that still says something.

    Raises
    ------
    ValueError
        If it is none.
    """
    value = scalar(tolerance, "tolerance")
    if not 1e-14 < value < 1e-2:
        raise ValueError(f"the tolerance must lie between 1e-14 and 1e-2, not {value}")
    return value
