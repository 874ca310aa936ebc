"""What is found of a direction, and of a step along it within bounds."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["Bounded", "Measured", "Preconditioned"]


class Preconditioned(NamedTuple):
    """What there is to know of z, what is lacking after the preconditioner.

    Attributes
    ----------
    descent : float
        Its product with what is lacking.
    overlap : float
        Its product with v.
    force : float
        Its sum.
    alike : float
        The product of what is shared and v, if something is.
    """

    descent: float
    overlap: float
    force: float
    alike: float


class Measured(NamedTuple):
    """What there is to know of a direction t and of what it causes, v; sums are over the cells that are free.

    Attributes
    ----------
    curvature : float
        The product of t and v.
    answer : float
        Sum of v.
    descent : float
        The product of t and what is lacking, over all cells.
    free : float
        That over the cells that are free.
    force : float
        Sum of t.
    lack : float
        Sum of what is lacking.
    """

    curvature: float
    answer: float
    descent: float
    free: float
    force: float
    lack: float


class Bounded(NamedTuple):
    """What has become of a direction that was made a step within bounds.

    Attributes
    ----------
    lifted : float
        Sum of the sizes of what takes pressures to their bounds [Pa].
    area : float
        Of the cells that still are free.
    force : float
        What keeping to the bounds has added to the step, all told; weighted.
    """

    lifted: float
    area: float
    force: float
