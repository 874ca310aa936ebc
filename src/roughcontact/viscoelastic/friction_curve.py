"""Hysteretic friction against sliding speed."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from roughcontact import methods
from roughcontact.errors import about
from roughcontact.guesses import hinted
from roughcontact.labels.note import Note, in_order
from roughcontact.progress.events import tracked
from roughcontact.solver.control import Status
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, number, numeric
from roughcontact.viscoelastic.prony_series import Viscoelastic
from roughcontact.viscoelastic.steady_sliding import SlidingContact, at_rest, limits_of, moving, unit_vector

__all__ = ["FrictionCurve", "along_speeds", "collect_speeds", "friction_curve"]

# Attributes of a state that become columns of the curve.
_COLUMNS = (
    *("speed", "friction", "friction_coefficient", "friction_across", "friction_error", "dissipation"),
    *("contact_fraction", "max_pressure", "mean_gap", "depth", "residual", "solves"),
)


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class FrictionCurve:
    """Steady sliding at several speeds, in increasing order; see `SlidingContact`.

    Attributes
    ----------
    speed : array, shape (n,)
        [m/s]
    friction : array, shape (n, 2)
        Mean traction (x, y) by which the surface drags the half-space [Pa].
    friction_coefficient, friction_error : array, shape (n,)
        Friction along the direction over the nominal pressure, and the estimate of its error by the grid [-].
    friction_across : array, shape (n,)
        Friction across the direction, to the left, over the nominal pressure [-].
    dissipation : array, shape (n,)
        Power per nominal area [W/m^2].
    contact_fraction : array, shape (n,)
        Relative real contact area [-].
    max_pressure : array, shape (n,)
        [Pa]
    mean_gap, depth : array, shape (n,)
        [m]
    residual, solves : array, shape (n,)
        Violation of the conditions of contact, and the number of solves.
    status : tuple of Status
    nominal_pressure : float
        [Pa]
    direction : array, shape (2,)
        Unit vector (x, y) along which the surface slides.
    state_notes : tuple of Note
        Notes on the states, each with the number of its speeds and the first of them.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e8, 1e-3)
    >>> surface = rc.shapes.wave(rc.Grid((16, 64), 1e-5, periodic=True), 1e-5, 6.4e-4)
    >>> curve = rc.friction_curve(surface, rubber, speeds=[0.01, 0.1, 1.0], pressure=1e5)
    >>> curve.to_dataset()["friction_traction"].dims, len(curve)
    (('sliding_speed', 'component'), 3)
    """

    speed: Array
    friction: Array
    friction_coefficient: Array
    friction_across: Array
    friction_error: Array
    dissipation: Array
    contact_fraction: Array
    max_pressure: Array
    mean_gap: Array
    depth: Array
    residual: Array
    solves: Array
    status: tuple[Status, ...]
    nominal_pressure: float
    direction: Array
    state_notes: tuple[Note, ...] = ()

    def __len__(self) -> int:
        return len(self.speed)

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these numbers, in sentences."""
        return in_order(self.state_notes)

    def __repr__(self) -> str:
        """Return the range of the curve, not its numbers."""
        converged = sum(status.converged for status in self.status)
        return (
            f"FrictionCurve({converged} of {len(self)} speeds converged, {self.speed[0]:.4g} to {self.speed[-1]:.4g} "
            f"m/s, friction coefficients up to {self.friction_coefficient.max():.4g})"
        )

    plot = methods.friction_speeds
    to_dataset = methods.friction_dataset
    to_record = methods.friction_record


@numeric(speeds="m/s", pressure="Pa", force="N")
def friction_curve(
    surface: Surface,
    material: Viscoelastic,
    *,
    speeds: Sequence[float] | Array,
    direction: Sequence[float] = (1.0, 0.0),
    pressure: float | None = None,
    force: float | None = None,
    tolerance: float = 1e-8,
) -> FrictionCurve:
    """Return hysteretic friction and contact against speed; each starts from the last converged one below it.

    Parameters
    ----------
    surface : Surface
        Heights [m], periodic along both axes, see `steady_sliding`.
    material : Viscoelastic
        Of the half-space, with a relaxed modulus.
    speeds : array, shape (n,)
        Speeds, 0 or more, in any order [m/s].
    direction : pair of floats
        Direction (x, y) in which the surface slides.
    pressure, force : float
        Exactly one: nominal pressure [Pa], or normal force on the map [N].
    tolerance : float
        Largest residual.

    Returns
    -------
    FrictionCurve
        In increasing order of speed; maps are not kept. A speed that missed the tolerance states this in `status`.

    Raises
    ------
    ValueError
        If the input is invalid.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e8, 1e-3)
    >>> surface = rc.shapes.wave(rc.Grid((16, 64), 1e-5, periodic=True), 1e-5, 6.4e-4)
    >>> curve = rc.friction_curve(surface, rubber, speeds=[1e-3, 0.1, 10.0], pressure=1e5)
    >>> bool(curve.contact_fraction[0] > curve.contact_fraction[-1])  # faster, stiffer
    True
    """
    states = along_speeds(
        surface, material, speeds, direction, pressure=pressure, force=force, tolerance=tolerance
    )
    return collect_speeds(states)


def along_speeds(
    surface: Surface,
    material: Viscoelastic,
    speeds: Sequence[float] | Array,
    direction: Sequence[float] = (1.0, 0.0),
    *,
    pressure: float | None = None,
    force: float | None = None,
    tolerance: float = 1e-8,
) -> Iterator[SlidingContact]:
    """Return the states of `friction_curve` one after the other, from the lowest speed; refuse what cannot slide."""
    values = np.sort(np.asarray(number(speeds, "speeds [m/s]")).ravel())
    if not values.size:
        raise about("speeds", "must hold at least one speed [m/s]")
    if not (values[0] >= 0 and values[-1] < math.inf):
        raise about("speeds", f"must be 0 or more and finite [m/s], not {values[0 if values[0] < 0 else -1]}")
    rest, along = at_rest(surface, material, pressure, force, tolerance), unit_vector(direction)

    def states() -> Iterator[SlidingContact]:
        start = None
        for speed in tracked(values.tolist(), "Sliding", "speeds"):
            state = moving(rest, material, speed, along, start)
            start = state if state.status.converged else start
            yield state

    return states()


def collect_speeds(states: Iterable[SlidingContact]) -> FrictionCurve:
    """Return the curve of states, whose maps are not kept."""
    rows, status, limits = [], [], []
    for state in states:
        rows.append([getattr(state, name) for name in _COLUMNS])
        status.append(state.status)
        limits += [(kind, state.speed, note) for kind, note in enumerate(limits_of(state)) if note]
    counts, first = Counter(kind for kind, *_ in limits), {each[0]: each for each in reversed(limits)}
    notes = (
        Note(note.rank, f"At {counts[kind]} of {len(rows)} speeds, first at {speed:.3g} m/s: {note.text}")
        for kind, speed, note in first.values()
    )
    columns = {name: np.array(each) for name, each in zip(_COLUMNS, zip(*rows, strict=True), strict=True)}
    return FrictionCurve(
        **columns,
        status=tuple(status),
        nominal_pressure=state.nominal_pressure,
        direction=state.direction,
        state_notes=tuple(notes),
    )
