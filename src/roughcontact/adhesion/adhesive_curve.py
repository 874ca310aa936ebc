"""Loading curves of surfaces that stick: points of approach and retreat, with the jumps between them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from operator import index
from typing import Literal

import numpy as np
import numpy.typing as npt

from roughcontact import methods
from roughcontact.adhesion.adhesive_state import AdhesiveState
from roughcontact.adhesion.attraction import Adhesion
from roughcontact.adhesion.control_form import ForceControl
from roughcontact.adhesion.model_limits import (
    HighestSummit,
    notes_on_loads,
    notes_on_model,
    notes_on_range,
    notes_on_status,
)
from roughcontact.adhesion.quasi_static import Jump
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.adhesive_columns import ADHESIVE_CURVE
from roughcontact.labels.column import stored_in
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.labels.records import records
from roughcontact.labels.variables import unit_of
from roughcontact.solver.control import Status
from roughcontact.solver.loads import Loads
from roughcontact.validation import Array, Mask

__all__ = ["AdhesiveCurve", "AdhesivePoint", "approaches", "collect_states"]

_POINTS = (
    *("depth", "force", "contact_area", "energy", "residual"),
    *("stiffness", "contact_stiffness", "mean_gap", "elastic_energy", "lowest_force", "lowest_force_depth"),
)


@dataclass(frozen=True, slots=True)
class AdhesivePoint:
    """One point of an adhesive curve: ``curve[i]``, or an element of a loop over the curve.

    Attributes
    ----------
    branch : {"approach", "retreat"}
        Whether the prescribed depth or force was growing or falling.
    nominal_pressure : float
        [Pa]
    depth, force, contact_area, mean_gap : float
        [m], [N], [m^2], [m]; tension is negative. As in `AdhesiveCurve`, per unit length on a line.
    contact_fraction : float
        Contact area over the nominal area.
    stiffness, contact_stiffness : float
        Slope of the force along the branch, and at fixed contact and attraction [N/m].
    elastic_energy, adhesive_energy, energy : float
        [J]; the last is their sum.
    lowest_force : float
        Lowest force since the begin of the retreat [N].
    lowest_force_depth : float
        Depth at this force [m].
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
    nominal_pressure: float
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
    lowest_force_depth: float
    residual: float
    status: Status


@hinted
@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AdhesiveCurve:
    """Points of a path of surfaces that stick, and its jumps; made by `adhesive_curve` and `adhesive_loop`.

    Attributes
    ----------
    depth : array, shape (n,)
        [m], in the order of the path; minus infinity once a force has pulled the bodies off.
    force : array, shape (n,)
        [N], tension negative; on a line [N/m].
    contact_area : array, shape (n,)
        [m^2]; on a line [m].
    energy : array, shape (n,)
        Elastic and adhesive energy [J].
    residual : array, shape (n,)
        The certificate of each state.
    approach : array of bool, shape (n,)
        Whether the prescribed depth or force was growing. The first point belongs to an approach; the later of two
        equal loads has the direction of the earlier.
    jumps : tuple of Jump
        Every instability, in order.
    jumped : tuple of int
        For each jump the point, counted from 0, that follows it.
    unresolved : bool
        Whether the attraction varies from cell to cell, so that the grid traps the states.
    stiffness, contact_stiffness : array, shape (n,)
        Slope of the force with the depth along the branch, and at fixed contact and attraction [N/m].
    mean_gap, elastic_energy : array, shape (n,)
        [m], over the measured cells; [J].
    lowest_force : array, shape (n,)
        Lowest force since the begin of the retreat [N], including values between the points and in jumps; on an
        approach, the force of the point. See `AdhesiveState`.
    lowest_force_depth : array, shape (n,)
        Depth at the lowest force [m].
    status : tuple of Status
    control : {"depth", "force"}
        The prescribed quantity.
    adhesion : Adhesion
    modulus : float
        Reduced modulus E* [Pa].
    tolerance : float
        Tolerance of each state.
    lengths, spacing, periodic : tuple
        Sides of the grid and of a cell [m], y first; whether the surface is periodic along each axis.
    nominal_area, rms : float
        Area of all cells [m^2], and root mean square height of the surface [m].
    summit_radius : float
        Radius of the body at its highest summit [m], see `AdhesiveState`.
    geometry : Geometry
        Geometry of the cells.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> loop = rc.adhesive_loop(ball, 1e8, rc.Adhesion(work=10e-3, range=2.5e-9), depth=10e-9)
    >>> f"pulled off at {loop.pull_off_force * 1e9:.0f} nN, {loop.lost * 1e18:.0f} aJ are lost", loop.ambiguous
    ('pulled off at 499 nN, 478 aJ are lost', False)
    >>> loop.plot().get_xlabel(), loop.to_dataset()["jump_lost"].attrs["units"], loop.to_record()["law"]
    ('depth [nm]', 'J', 'exponential')
    """

    depth: Array
    force: Array
    contact_area: Array
    energy: Array
    residual: Array
    approach: Mask
    jumps: tuple[Jump, ...]
    jumped: tuple[int, ...]
    unresolved: bool
    stiffness: Array
    contact_stiffness: Array
    mean_gap: Array
    elastic_energy: Array
    lowest_force: Array
    lowest_force_depth: Array
    status: tuple[Status, ...]
    control: Literal["depth", "force"]
    adhesion: Adhesion
    modulus: float
    tolerance: float
    lengths: tuple[float, ...]
    spacing: tuple[float, ...]
    periodic: tuple[bool, ...]
    nominal_area: float
    rms: float
    summit_radius: float
    geometry: Geometry

    def __len__(self) -> int:
        return len(self.force)

    def __getitem__(self, place: int) -> AdhesivePoint:
        """Return one point as a record; negative places count from the end."""
        return tuple(self)[index(place)]

    def __iter__(self) -> Iterator[AdhesivePoint]:
        """Yield the points in the order of the path, each as a record."""
        return records(AdhesivePoint, self)

    @property
    def branch(self) -> npt.NDArray[np.str_]:
        """``"approach"`` or ``"retreat"`` for each point."""
        return np.where(self.approach, "approach", "retreat")

    @property
    def pull_off_force(self) -> float:
        """Largest tension of the retreat [N], positive; 0 if there is no tension.

        It is the extremum of the force along the path and does not depend on the points. Its relative precision is 1e-6
        under prescribed depths; under prescribed forces it is that of the jump that pulls the body off.
        """
        return float(max(0.0, *-self.lowest_force[~self.approach], 0.0))

    @property
    def pull_off_point(self) -> int | None:
        """The first point at or after the largest tension of the retreat; None if there is no tension.

        ``lowest_force_depth`` of this point is the depth of the pull-off force.
        """
        return (
            int(np.argmax(~self.approach & (-self.lowest_force == self.pull_off_force)))
            if self.pull_off_force
            else None
        )

    @property
    def jump_in_force(self) -> float:
        """Tension at the first jump of the approach [N]; negative if the body was pressed, NaN without a jump."""
        return next((-jump.force_before for jump in self.jumps if jump.approach), math.nan)

    @property
    def lost(self) -> float:
        """Energy lost in all `jumps` [J]: the area of the loop, if it is closed."""
        return math.fsum(jump.lost for jump in self.jumps)

    @property
    def ambiguous(self) -> bool:
        """Whether two integrations of the flow after a jump ended in different states."""
        return any(jump.ambiguous for jump in self.jumps)

    @property
    def converged(self) -> bool:
        """Whether every state met the tolerance."""
        return all(status.converged for status in self.status)

    @property
    def adhesive_energy(self) -> Array:
        """Energy of the attraction [J], negative, shape (n,)."""
        return self.energy - self.elastic_energy

    @property
    def nominal_pressure(self) -> Array:
        """Force over the nominal area [Pa], tension negative, shape (n,)."""
        return self.force / self.nominal_area

    @property
    def contact_fraction(self) -> Array:
        """Contact area over the nominal area, shape (n,)."""
        return self.contact_area / self.nominal_area

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these numbers, in sentences; notes on wrong numbers come first."""
        return in_order(self._notes())

    def _notes(self) -> Iterator[Note]:
        line = self.geometry is Geometry.LINE
        summit = HighestSummit(self.summit_radius, self.modulus, float(np.max(self.adhesion.work)), line)
        yield from notes_on_status(self.status, self.residual)
        yield from notes_on_model(summit, self.unresolved)
        if not self.approach.all():
            retreat = np.flatnonzero(~self.approach)
            deepest = int(retreat[np.argmin(self.lowest_force[retreat])])
            begin = int(np.flatnonzero(self.approach[:deepest])[-1])
            yield from notes_on_loads(
                lowest=float(self.lowest_force[deepest]),
                first=float(self.force[begin]),
                last=float(self.force[deepest]),
                unit=unit_of("force", self.geometry),
                control=self.control,
            )
            yield from notes_on_range(summit, self.adhesion)
        if self.ambiguous:
            yield Note(
                Rank.DOUBTFUL,
                "A jump is ambiguous: two integrations of the gradient flow after it ended in different states. One of "
                "them is reported.",
            )

    def __repr__(self) -> str:
        """Return the range of the path, without its arrays."""
        unit = unit_of("force", self.geometry)
        return (
            f"AdhesiveCurve({len(self)} points, {len(self.jumps)} jumps, "
            f"force {self.force.min():.4g} to {self.force.max():.4g} {unit})"
        )

    to_csv = methods.csv_of
    to_dataset = methods.adhesive_curve_dataset
    to_record = methods.adhesive_curve_record
    plot = methods.jump_loop
    _repr_html_ = methods.adhesive_curve_html


CURVE_POINTS = stored_in(AdhesiveCurve, ADHESIVE_CURVE[("load",)])
"""The columns that a path takes from each state; the other columns follow from them."""


def collect_states(states: Iterable[AdhesiveState], loads: Loads) -> AdhesiveCurve:
    """Drain a path into its points; fields are not kept.

    Parameters
    ----------
    states : iterable of AdhesiveState
        At least one.
    loads : Loads
        The loads of the path, which may end before them.
    """
    rows: list[tuple[float, ...]] = []
    jumps: list[Jump] = []
    jumped: list[int] = []
    status: list[Status] = []
    for state in states:
        jumped += [len(rows)] * len(state.jumps)
        rows.append(tuple(float(getattr(state, name)) for name in _POINTS))
        jumps += state.jumps
        status.append(state.status)
    problem, points = state.problem, np.array(rows).T
    grid, surface = problem.operator.grid, problem.surface
    return AdhesiveCurve(
        **dict(zip(_POINTS, points, strict=True)),
        approach=approaches(loads.approach)[: len(rows)],
        jumps=tuple(jumps),
        jumped=tuple(jumped),
        unresolved=state.unresolved,
        status=tuple(status),
        control="force" if isinstance(problem.control, ForceControl) else "depth",
        adhesion=problem.adhesion,
        modulus=problem.modulus,
        tolerance=problem.tolerance,
        lengths=tuple(grid.lengths),
        spacing=tuple(grid.spacing),
        periodic=tuple(grid.periodic),
        nominal_area=float(grid.area),
        rms=math.nan if surface is None else surface.rms,
        summit_radius=state.summit_radius,
        geometry=state.geometry,
    )


def approaches(loads: Array) -> Mask:
    """Return whether loads grow; the later of equal loads is like the earlier, and the first is an approach."""
    steps = np.sign(np.diff(loads, prepend=-np.inf))
    latest = np.maximum.accumulate(np.where(steps != 0, np.arange(steps.size), 0))
    return np.asarray(steps[latest] > 0)
