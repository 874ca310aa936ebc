"""How a solve ended, in words."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution

__all__ = ["ConvergenceError", "Status"]


class Status(Enum):
    """The outcome of a solve; `message` says it in a sentence."""

    CONVERGED = "converged"
    NO_CONTACT = "no contact"
    MAX_STEPS = "step limit"
    STAGNATED = "stagnated"

    @property
    def converged(self) -> bool:
        """Whether the answer meets the tolerance that was asked for."""
        return self in (Status.CONVERGED, Status.NO_CONTACT)

    @property
    def message(self) -> str:
        """What happened and, where something is amiss, what to do."""
        return _MESSAGES[self]


_MESSAGES = {
    Status.CONVERGED: "The answer meets the tolerance.",
    Status.NO_CONTACT: "The bodies do not touch at this depth.",
    Status.MAX_STEPS: "The solver ran out of steps above the tolerance; allow it more steps.",
    Status.STAGNATED: (
        "The residual stopped falling above the tolerance. Often rounding allows no more: ask for a larger "
        "tolerance, or take a large offset out of the heights before they are stored; else try another solver."
    ),
}


class ConvergenceError(RuntimeError):
    """A solve that missed its tolerance; `solution` is the best that was reached."""

    def __init__(self, solution: Solution) -> None:
        super().__init__(solution)  # in `args`, so that the error can be pickled
        self.solution = solution

    def __str__(self) -> str:
        solution = self.solution
        return (
            f"residual {solution.residual:.1e} after {solution.steps} steps, tolerance "
            f"{solution.problem.tolerance:.1e}: {solution.status.message}"
        )
