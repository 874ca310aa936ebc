"""How far a study is."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Summary"]


@dataclass(frozen=True, slots=True)
class Summary:
    """How far a study is.

    Parameters
    ----------
    done, failed, left : int
        Cases.
    seconds : float
        Time that the run has taken.
    """

    done: int
    failed: int
    left: int
    seconds: float = 0.0

    @property
    def total(self) -> int:
        """Number of cases of the study."""
        return self.done + self.failed + self.left

    def after(self, *, failed: bool, seconds: float) -> Summary:
        """Return how far it is with one case more."""
        return Summary(self.done + (not failed), self.failed + failed, self.left - 1, seconds)

    def with_failed_left(self) -> Summary:
        """Return the same with the failed cases among those that are left, to be tried again."""
        return Summary(self.done, 0, self.left + self.failed, self.seconds)
