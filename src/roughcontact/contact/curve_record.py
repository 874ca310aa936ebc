"""One load of a loading curve."""

from __future__ import annotations

from dataclasses import dataclass

from roughcontact.solver.control import Status

__all__ = ["CurvePoint"]


@dataclass(frozen=True, slots=True)
class CurvePoint:
    """One load of a loading curve: ``curve[i]``, or an element of a loop over the curve.

    Attributes
    ----------
    force, depth, stiffness, interfacial_stiffness, contact_area, mean_gap, elastic_energy : float
        [N], [m], [N/m], [N/m], [m^2], [m], [J]; as in `Curve`, per unit length on a line.
    nominal_pressure, max_pressure, mean_pressure : float
        Mean over all cells, largest of a cell, and mean over the contact area [Pa].
    contact_fraction : float
        Relative real contact area A/A0.
    interfacial_stiffness_per_area : float
        K/A0 [Pa/m].
    spots : int
        Number of contact spots.
    dimensionless_force, dimensionless_stiffness : float
        Force over E* h L, and stiffness over E* L.
    residual, stiffness_residual : float
        Certificates of the pressure and of the stiffness.
    resolved : bool
        Whether the contact is larger than the one-cell artefact, below full contact, and solved to its tolerance.
    status : Status
        How the solve ended.
    plastic_area, flow_volume, flow_energy, unloading_stiffness, unloading_interfacial_stiffness : float or None
        [m^2], [m^3], [J], [N/m], [N/m]; None without a hardness. See `FlowCurve`.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> curve = rc.loading_curve(ball, 1e9, forces=[1e-2, 2e-2])
    >>> for point in curve:
    ...     print(f"{point.force:.2f} N, {point.depth * 1e9:.0f} nm, {point.status.value}")
    0.01 N, 823 nm, converged
    0.02 N, 1308 nm, converged
    """

    force: float
    nominal_pressure: float
    max_pressure: float
    mean_pressure: float
    depth: float
    stiffness: float
    interfacial_stiffness: float
    contact_area: float
    contact_fraction: float
    interfacial_stiffness_per_area: float
    spots: int
    mean_gap: float
    elastic_energy: float
    dimensionless_force: float
    dimensionless_stiffness: float
    residual: float
    stiffness_residual: float
    resolved: bool
    status: Status
    plastic_area: float | None = None
    flow_volume: float | None = None
    flow_energy: float | None = None
    unloading_stiffness: float | None = None
    unloading_interfacial_stiffness: float | None = None
