"""Plastic flow along a loading curve, and the stiffness of unloading from each of its loads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from roughcontact.contact.solution import Solution
from roughcontact.validation import Array

__all__ = ["FlowCurve", "flow_curve", "flow_point"]


@dataclass(frozen=True, slots=True, eq=False)
class FlowCurve:
    """Plastic flow at each load of a curve; on unloading and reloading it stays as it is.

    Attributes
    ----------
    plastic_area : array, shape (n,)
        Area of the cells that flow at this load: those whose pressure is the hardness [m^2].
    flow_volume : array, shape (n,)
        Volume that has flowed [m^3].
    flow_energy : array, shape (n,)
        Work that first loading spent on flow [J], see `Flow`.
    unloading_stiffness, unloading_interfacial_stiffness : array, shape (n,)
        ``stiffness`` and ``interfacial_stiffness`` of `Curve` as the load is reduced, to which all cells in contact
        contribute [N/m].

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> curve = rc.loading_curve(ball, 1e11, forces=[0.05, 0.1, 0.2], hardness=2e9)
    >>> (curve.flow.flow_volume * 1e18).round(2).tolist()  # [um^3]
    [0.0, 0.38, 3.27]
    >>> bool((curve.flow.unloading_stiffness >= curve.stiffness).all())
    True
    """

    plastic_area: Array
    flow_volume: Array
    flow_energy: Array
    unloading_stiffness: Array
    unloading_interfacial_stiffness: Array


def flow_point(solution: Solution) -> tuple[float, ...]:
    """Return the numbers of one load, in the order of the fields; empty without a hardness."""
    flow = solution.flow
    if flow is None:
        return ()
    flattened = solution.flattened
    area = solution.problem.measure.total(solution.plastic)
    return area, flow.volume, flow.energy, flattened.stiffness, flattened.interfacial_stiffness


def flow_curve(points: Sequence[tuple[float, ...]]) -> FlowCurve | None:
    """Return the numbers of all loads; None without a hardness."""
    return FlowCurve(*np.array(points).T) if points and points[0] else None
