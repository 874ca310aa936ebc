"""The curve of a viscoelastic contact: force, depth, area, stiffness and energies against time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from roughcontact import methods
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.labels.variables import unit_of
from roughcontact.solver.control import Status
from roughcontact.validation import Array

__all__ = ["ViscoelasticCurve"]


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class ViscoelasticCurve:
    """Points of a viscoelastic contact in the order of time.

    Attributes
    ----------
    time, force, nominal_pressure, depth, mean_gap : array, shape (n,)
        [s], [N], [Pa], [m], [m]. Two equal times are a jump: before and after.
    contact_area, contact_fraction, max_pressure : array, shape (n,)
        [m^2], [1], [Pa]; `max_pressure` is the largest of a cell.
    stiffness, relaxed_stiffness : array, shape (n,)
        Against a sudden change of the depth, and after a long time [N/m]; contact region held fixed.
    work, stored_energy, dissipated_energy : array, shape (n,)
        Since the start, now, and since the start [J].
    residual, time_residual, time_error : array, shape (n,)
        Certificates, and the estimated error of time, see `ViscoelasticState`.
    products : int array, shape (n,)
        Products with the operator.
    prescribed : bool array, shape (n,)
        Whether the time is one of those that were given.
    status : tuple of Status
    geometry : Geometry
        Geometry of the cells. On a line, forces, stiffness, areas and energies are per unit length.
    measured : dict of str to array, shape (n,)
        Numbers of each state by the `measures` that were given to `viscoelastic_curve`.
    state_notes : tuple of Note
        Notes on the state with the largest contact area.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e7, 1.0)
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> curve = rc.viscoelastic_curve(ball, rubber, times=[0, 1], forces=[1e-6, 1e-6], steps=4)
    >>> curve
    ViscoelasticCurve(5 of 5 states converged, time 0 to 1 s, force up to 1e-06 N)
    >>> curve.to_dataset()["depth"].dims, len(curve.to_record()["time"])
    (('time',), 5)
    """

    time: Array
    force: Array
    nominal_pressure: Array
    depth: Array
    mean_gap: Array
    contact_area: Array
    contact_fraction: Array
    max_pressure: Array
    stiffness: Array
    relaxed_stiffness: Array
    work: Array
    stored_energy: Array
    dissipated_energy: Array
    residual: Array
    time_residual: Array
    time_error: Array
    products: npt.NDArray[np.int64]
    prescribed: npt.NDArray[np.bool_]
    status: tuple[Status, ...]
    geometry: Geometry
    measured: Mapping[str, Array] = field(default_factory=dict)
    state_notes: tuple[Note, ...] = ()

    def __len__(self) -> int:
        return len(self.time)

    @property
    def energy_leak(self) -> Array:
        """Work less stored and dissipated energy [J]: an estimate of the error of time of the energies."""
        return self.work - self.stored_energy - self.dissipated_energy

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these numbers, in sentences; notes on wrong numbers come first."""
        missed = sum(not status.converged for status in self.status)
        wrong = (Note(Rank.WRONG, f"{missed} of {len(self)} states missed the tolerance"),) if missed else ()
        return in_order((*wrong, *self.state_notes))

    def __repr__(self) -> str:
        """Return the range of the curve, without its arrays."""
        converged, unit = sum(status.converged for status in self.status), unit_of("force", self.geometry)
        return (
            f"ViscoelasticCurve({converged} of {len(self)} states converged, time {self.time[0]:.4g} to "
            f"{self.time[-1]:.4g} s, force up to {self.force.max():.4g} {unit})"
        )

    to_csv = methods.csv_of
    to_dataset = methods.viscoelastic_dataset
    to_record = methods.viscoelastic_record
    plot = methods.creep_curve
