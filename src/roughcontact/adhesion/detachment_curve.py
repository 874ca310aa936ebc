"""Force and contact of stuck surfaces on their retreat, with the cells that let go."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from roughcontact import methods
from roughcontact.adhesion.detachment import Detachment
from roughcontact.adhesion.detachment_path import force_unit_of, states_drawn_back
from roughcontact.adhesion.detachment_state import DetachmentState, stuck_notes
from roughcontact.adhesion.model_limits import notes_on_loads, notes_on_status
from roughcontact.contact.solution import Solution
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.adhesive_columns import DETACHMENT_CURVE
from roughcontact.labels.column import stored_in
from roughcontact.labels.note import in_order
from roughcontact.labels.variables import unit_of
from roughcontact.solver.control import Status
from roughcontact.solver.loads import Loads
from roughcontact.validation import Array, numeric

__all__ = ["DetachmentCurve", "collect_detachments", "detachment_curve"]

_POINTS = (
    *("depth", "force", "contact_area", "stiffness", "mean_gap"),
    *("elastic_energy", "adhesive_energy", "lowest_force", "residual"),
)


@hinted
@dataclass(frozen=True, slots=True, eq=False, repr=False)
class DetachmentCurve:
    """Points of the retreat of stuck surfaces, and the cells that let go; made by `detachment_curve`.

    Attributes
    ----------
    depth : array, shape (n,)
        [m], falling; minus infinity once a force has pulled the bodies off.
    force : array, shape (n,)
        [N], tension negative; on a line [N/m].
    contact_area : array, shape (n,)
        Area of the stuck cells [m^2]; on a line [m].
    stiffness : array, shape (n,)
        Slope of the force with the depth while no cell lets go [N/m].
    mean_gap : array, shape (n,)
        [m], over the measured cells.
    elastic_energy, adhesive_energy : array, shape (n,)
        [J]; the adhesive energy is minus the work of adhesion of the stuck cells.
    lowest_force : array, shape (n,)
        Lowest force since the preload [N], at the points and between them.
    residual : array, shape (n,)
        The certificate of each state, see `DetachmentState`.
    status : tuple of Status
    detachments : tuple of Detachment
        Every event, in order.
    detached_at : tuple of int
        For each event the point, counted from 0, that follows it.
    preload_too_small : bool
        Whether the pull-off force may be larger after a larger preload, see `DetachmentState`.
    notes : tuple of str
        Limits of these numbers; notes on wrong numbers come first.
    control : {"depth", "force"}
        The prescribed quantity.
    work : float or array, shape of the grid
        Work of adhesion [J/m^2].
    modulus : float
        Reduced modulus E* [Pa].
    tolerance : float
        Tolerance of each state.
    lengths, spacing, periodic : tuple
        Sides of the grid and of a cell [m], y first; whether the surface is periodic along each axis.
    nominal_area, rms : float
        Area of all cells [m^2], and root mean square height of the surface [m].
    geometry : Geometry
        Geometry of the cells.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> pressed = rc.press(ball, 1e8, depth=2e-8)
    >>> curve = rc.detachment_curve(pressed, 10e-3, depths=[1e-8, 0.0, -1e-8, -2e-8])
    >>> f"pulled off at {curve.pull_off_force * 1e9:.0f} nN, {curve.lost * 1e18:.0f} aJ are lost", curve.converged
    ('pulled off at 487 nN, 310 aJ are lost', True)
    >>> curve.plot().get_xlabel(), curve.to_dataset()["detachment_lost"].attrs["units"], curve.to_record()["control"]
    ('depth [nm]', 'J', 'depth')
    """

    depth: Array
    force: Array
    contact_area: Array
    stiffness: Array
    mean_gap: Array
    elastic_energy: Array
    adhesive_energy: Array
    lowest_force: Array
    residual: Array
    status: tuple[Status, ...]
    detachments: tuple[Detachment, ...]
    detached_at: tuple[int, ...]
    preload_too_small: bool
    notes: tuple[str, ...]
    control: Literal["depth", "force"]
    work: float | Array
    modulus: float
    tolerance: float
    lengths: tuple[float, ...]
    spacing: tuple[float, ...]
    periodic: tuple[bool, ...]
    nominal_area: float
    rms: float
    geometry: Geometry

    def __len__(self) -> int:
        return len(self.force)

    @property
    def pull_off_force(self) -> float:
        """Largest tension [N], positive, at the points and between them; 0 if there is no tension."""
        return max(0.0, -float(self.lowest_force[-1]))

    @property
    def lost(self) -> float:
        """Energy lost in all detachments [J]; infinite if a force pulled the body off."""
        return math.fsum(event.lost for event in self.detachments)

    @property
    def converged(self) -> bool:
        """Whether every state met the tolerance."""
        return all(status.converged for status in self.status)

    @property
    def energy(self) -> Array:
        """Elastic and adhesive energy [J], shape (n,)."""
        return self.elastic_energy + self.adhesive_energy

    @property
    def nominal_pressure(self) -> Array:
        """Force over the nominal area [Pa], tension negative, shape (n,)."""
        return self.force / self.nominal_area

    @property
    def contact_fraction(self) -> Array:
        """Contact area over the nominal area, shape (n,)."""
        return self.contact_area / self.nominal_area

    def __repr__(self) -> str:
        """Return the range of the curve, without its arrays."""
        unit = unit_of("force", self.geometry)
        return (
            f"DetachmentCurve({len(self)} points, {len(self.detachments)} detachments, "
            f"force {self.force.min():.4g} to {self.force.max():.4g} {unit})"
        )

    to_csv = methods.csv_of
    to_dataset = methods.detachment_curve_dataset
    to_record = methods.detachment_curve_record
    plot = methods.detachment_force
    _repr_html_ = methods.detachment_html


CURVE_POINTS = stored_in(DetachmentCurve, DETACHMENT_CURVE[("load",)])
"""The columns that a curve takes from each state; the other columns follow from them."""


@numeric(work="J/m^2", depths="m", forces=force_unit_of, pressures="Pa")
def detachment_curve(
    solution: Solution,
    work: float | Array,
    *,
    depths: Sequence[float] | Array | None = None,
    forces: Sequence[float] | Array | None = None,
    pressures: Sequence[float] | Array | None = None,
) -> DetachmentCurve:
    """Return force, contact and more of surfaces that stick where they were pressed, on their retreat.

    Parameters
    ----------
    solution : Solution
        The preload: an elastic contact that is larger than the contact at the pull-off.
    work : float or array, shape of the grid
        Work of adhesion w [J/m^2]: the work to separate a unit area.
    depths, forces, pressures : array, shape (n,)
        At most one: falling depths [m], forces [N] or nominal pressures [Pa], the first at most that of the solution.
        Without any, three points: the preload, the largest tension, and the point at which the last cell has let go.

    Returns
    -------
    DetachmentCurve
        One point for each load, and every detachment; fields are not kept, see `detachment_path`.

    Raises
    ------
    ValueError
        As for `detachment_path`.

    Examples
    --------
    >>> import math
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> curve = rc.detachment_curve(rc.press(ball, 1e8, depth=2e-8), 10e-3)
    >>> f"{curve.pull_off_force / (math.pi * 10e-3 * 1e-5):.2f} pi w R", curve.notes
    ('1.55 pi w R', ())
    """
    loads = Loads.given(depths=depths, forces=forces, pressures=pressures)
    return collect_detachments(states_drawn_back(solution, work, loads), loads)


def collect_detachments(states: Iterable[DetachmentState], loads: Loads | None) -> DetachmentCurve:
    """Drain a path along `loads`, with at least one state, into its points; fields are not kept."""
    rows: list[tuple[float, ...]] = []
    events: list[Detachment] = []
    detached_at: list[int] = []
    status: list[Status] = []
    for state in states:
        detached_at += [len(rows)] * len(state.detachments)
        rows.append(tuple(float(getattr(state, name)) for name in _POINTS))
        events += state.detachments
        status.append(state.status)
    problem = state.problem
    control: Literal["depth", "force"] = "depth" if loads is None or loads.kind == "depth" else "force"
    points = dict(zip(_POINTS, np.array(rows).T, strict=True))
    notes = [*notes_on_status(status, points["residual"]), *stuck_notes(state)]
    if state.contact.any():
        unit = unit_of("force", state.geometry)
        lowest, last = state.lowest_force, state.force
        notes += notes_on_loads(lowest=lowest, first=math.inf, last=last, unit=unit, control=control)
    grid, surface = problem.grid, problem.surface
    return DetachmentCurve(
        **points,
        status=tuple(status),
        detachments=tuple(events),
        detached_at=tuple(detached_at),
        preload_too_small=state.preload_too_small,
        notes=in_order(notes),
        control=control,
        work=state.work,
        modulus=problem.modulus,
        tolerance=problem.tolerance,
        lengths=tuple(grid.lengths),
        spacing=tuple(grid.spacing),
        periodic=tuple(grid.periodic),
        nominal_area=float(grid.area),
        rms=math.nan if surface is None else surface.rms,
        geometry=state.geometry,
    )
