"""One point of a path of surfaces that stick."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roughcontact.solver.control import Status

__all__ = ["AdhesivePoint"]


@dataclass(frozen=True, slots=True)
class AdhesivePoint:
    """One point of an adhesive curve: ``curve[i]``, and what a loop over the curve yields.

    Attributes
    ----------
    branch : {"approach", "retreat"}
        Whether what is prescribed brought the bodies together.
    depth, force, contact_area, mean_gap : float
        [m], [N], [m^2], [m]; tension is negative. As in `AdhesiveCurve`, on a line per unit length.
    contact_fraction : float
        Contact area over the nominal area.
    stiffness, contact_stiffness : float
        Slope of the force along the branch, and at fixed contact and attraction [N/m].
    elastic_energy, adhesive_energy, energy : float
        [J]; the last is their sum.
    lowest_force : float
        Lowest force since the body is drawn back [N].
    residual : float
        The certificate of the state.
    status : Status
        How the solve ended.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> loop = rc.adhesive_loop(ball, 1e8, rc.Adhesion(work=10e-3, range=4e-9), depth=10e-9)
    >>> loop[0].branch, loop[-1].branch, sum(point.force < 0 for point in loop) > 10
    ('approach', 'retreat', True)
    """

    branch: Literal["approach", "retreat"]
    depth: float
    force: float
    contact_area: float
    contact_fraction: float
    stiffness: float
    contact_stiffness: float
    mean_gap: float
    elastic_energy: float
    adhesive_energy: float
    energy: float
    lowest_force: float
    residual: float
    status: Status
