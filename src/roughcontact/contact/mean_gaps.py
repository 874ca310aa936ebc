"""Mean gaps, which only bodies that stick are brought to."""

from __future__ import annotations

__all__ = ["refuse_gaps"]


def refuse_gaps(mean_gaps: object) -> None:
    """Refuse mean gaps of bodies that do not stick, which have depths for it.

    Raises
    ------
    ValueError
        If any are given.
    """
    if mean_gaps is not None:
        raise ValueError(
            "mean gaps are prescribed with adhesion alone: give depths, on a whole periodic grid the mean separation "
            "less the gap"
        )
