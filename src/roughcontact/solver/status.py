"""How a solve ended, in words."""

from __future__ import annotations

from enum import Enum

__all__ = ["Status"]


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
