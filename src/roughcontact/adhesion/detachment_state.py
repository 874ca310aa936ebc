"""A state of stuck surfaces on their retreat: the cells that still hold, and their force."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from roughcontact import methods
from roughcontact.adhesion.detachment import Detachment
from roughcontact.adhesion.model_limits import HighestSummit, highest_summit, notes_on_model, notes_on_status
from roughcontact.cached import cached_property
from roughcontact.contact.problem import ContactProblem
from roughcontact.contact.solution import Solution
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import exact_of
from roughcontact.labels.engineering_units import written
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.labels.variables import unit_of
from roughcontact.solver.control import Status
from roughcontact.validation import Array, Mask

__all__ = ["DetachmentState", "stuck_notes"]

# Part of the preload's contact: if more still held under the largest tension, a larger preload may bear more. On
# spheres all cells still hold if the preload was too small; if it was just large enough, some have let go by then.
HELD = 0.8
# Relative error of the pull-off force of a sphere above which a note states it. On a radius of n cells at the pull-off
# it is about 1/n, from 6 cells to 20 (docs/evidence/adhesion-evidence.md).
COARSE = 0.05


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class DetachmentState:
    """Stuck surfaces at one depth or force, from `detachment_path`; other quantities are computed on first access.

    Attributes
    ----------
    solution : Solution
        The preload: the contact whose cells are stuck.
    work : float or array, shape of the grid
        Work of adhesion [J/m^2].
    depth : float
        Approach of the bodies since first touch [m]; minus infinity once a force has pulled them off.
    pressure : array, shape of the grid
        Pressure of the stuck cells [Pa], tension negative.
    contact : array of bool, shape of the grid
        Stuck cells.
    stiffness : float
        Slope of the force with the depth while no cell lets go [N/m].
    residual : float
        Largest gap of a stuck cell, or overlap of another, as the pressure on only this cell that would close it,
        relative to the largest pressure, or to the tension at which a cell lets go if that is larger, from an exact
        product. Under a prescribed force it includes the error of the force, relative to the sum of the absolute
        pressures.
    detachments : tuple of Detachment
        Cells that let go since the state before.
    lowest_force : float
        Lowest force since the preload [N], at the states and between them: minus the largest tension.
    lowest_force_area : float
        Contact area under the lowest force [m^2]; [m] on a line.

    Examples
    --------
    >>> import math
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> pressed = rc.press(ball, 1e8, depth=2e-8)
    >>> held, off = rc.detachment_path(pressed, 10e-3, depths=[0.0, -2e-8])
    >>> f"{held.force * 1e9:.0f} nN at a depth of zero, on {held.contact.sum()} rings", held.residual < 1e-8
    ('-423 nN at a depth of zero, on 40 rings', True)
    >>> f"pull-off {off.pull_off_force / (math.pi * 10e-3 * 1e-5):.2f} pi w R", off.preload_too_small
    ('pull-off 1.55 pi w R', False)
    >>> off.to_dataset()["detachment_depth"].attrs["units"], off.to_record()["preload_too_small"]
    ('m', False)
    """

    solution: Solution
    work: float | Array
    depth: float
    pressure: Array
    contact: Mask
    stiffness: float
    residual: float
    detachments: tuple[Detachment, ...]
    lowest_force: float
    lowest_force_area: float

    @property
    def problem(self) -> ContactProblem:
        """Body, separation and tolerance."""
        return self.solution.problem

    @property
    def geometry(self) -> Geometry:
        """Geometry of the cells: those of a surface, a line, or rings."""
        return self.problem.geometry

    @property
    def status(self) -> Status:
        """Whether the certificate meets the tolerance of the solution."""
        if not self.residual <= self.problem.tolerance:
            return Status.STAGNATED
        return Status.CONVERGED if self.contact.any() else Status.NO_CONTACT

    @property
    def pull_off_force(self) -> float:
        """Largest tension since the preload [N], positive; it is the pull-off force once nothing is in contact."""
        return max(0.0, -self.lowest_force)

    @property
    def preload_too_small(self) -> bool:
        """Whether the pull-off force may be larger after a larger preload.

        It is True if Hertz's contact under the preload is smaller than the contact of Johnson, Kendall and Roberts at
        the pull-off (see `least_preload`), or if more than four fifths of the preload's contact still held under the
        largest tension, unless the preload held all measured cells. It is False as long as any cell is in contact.
        """
        if self.contact.any() or self.solution.contact.sum() == self.problem.measured.sum():
            return False
        held = self.lowest_force_area > HELD * self.solution.contact_area
        return held or self.solution.force < self.least_preload

    @property
    def least_preload(self) -> float:
        """Smallest preload [N] under which a sphere's contact is not smaller than at its pull-off; [N/m] on a line.

        By Johnson, Kendall and Roberts it equals the pull-off force: 3/2 pi w R with the radius R of the highest
        summit, or the largest tension so far if that is larger. On a line it is a third of the pull-off force.
        """
        share = 1 / 3 if self._summit.line else 1.0
        single = self._summit.least_preload if math.isfinite(self._summit.radius) else 0.0
        return max(single, share * self.pull_off_force)

    @cached_property
    def _summit(self) -> HighestSummit:
        problem = self.problem
        return highest_summit(problem.operator, problem.separation, problem.modulus, self.work)

    @property
    def directional(self) -> bool:
        """Whether the criterion of detachment depends on the angle between the edge of the contact and the rows."""
        return self.contact.ndim == 2 and min(self.contact.shape) > 1

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these numbers, in sentences; notes on wrong numbers come first."""
        return in_order((*notes_on_status([self.status], [self.residual]), *stuck_notes(self)))

    @property
    def lost(self) -> float:
        """Energy lost in the detachments since the state before [J]; infinite if a force pulled the body off."""
        return math.fsum(event.lost for event in self.detachments)

    @cached_property
    def displacement(self) -> Array:
        """Displacement of the surface [m], by an exact product."""
        return exact_of(self.problem.operator).apply(self.pressure)

    @cached_property
    def gap(self) -> Array:
        """Deformed gap [m]; infinite where nothing was measured."""
        return np.asarray(self.displacement + self.problem.separation - self.depth)

    @property
    def mean_gap(self) -> float:
        """Gap averaged over the measured cells [m]."""
        return self.problem.measure.mean(self.gap, self.problem.measured)

    @property
    def force(self) -> float:
        """Normal force [N], tension negative; [N/m] on a line."""
        return float(np.sum(self.pressure * self.problem.operator.weights))

    @property
    def contact_area(self) -> float:
        """Area of the stuck cells [m^2]; [m] on a line."""
        return float(np.sum(self.contact * self.problem.operator.weights))

    @property
    def contact_fraction(self) -> float:
        """Contact area over the nominal area."""
        return self.contact_area / self.nominal_area

    @property
    def nominal_area(self) -> float:
        """Area of all cells [m^2], missing ones included."""
        return self.problem.grid.area

    @property
    def nominal_pressure(self) -> float:
        """Force over the nominal area [Pa]."""
        return self.force / self.nominal_area

    @property
    def max_pressure(self) -> float:
        """Largest pressure of a cell [Pa]."""
        return float(self.pressure.max())

    @property
    def max_tension(self) -> float:
        """Largest tension of a cell [Pa], positive."""
        return max(0.0, -float(self.pressure.min()))

    @property
    def elastic_energy(self) -> float:
        """Elastic energy of the body [J]."""
        return 0.5 * float(np.sum(self.pressure * self.displacement * self.problem.operator.weights))

    @property
    def adhesive_energy(self) -> float:
        """Minus the work of adhesion of the stuck cells [J]."""
        return -float(np.sum(self.contact * self.work * self.problem.operator.weights))

    @property
    def energy(self) -> float:
        """Elastic and adhesive energy [J]."""
        return self.elastic_energy + self.adhesive_energy

    to_dataset = methods.detachment_state_dataset
    to_record = methods.detachment_state_record
    plot = methods.plot_state
    _repr_html_ = methods.state_html

    def __repr__(self) -> str:
        """Return the main numbers, without the fields."""
        return (
            f"DetachmentState({self.status.value}, force {self.force:.4g}, depth {self.depth:.4g} m, "
            f"{int(np.count_nonzero(self.contact))} cells in contact, residual {self.residual:.1e})"
        )


def stuck_notes(state: DetachmentState) -> Iterator[Note]:
    """Yield the notes that do not depend on the residual of this state."""
    yield from notes_on_model(state._summit)
    if not state.solution.status.converged:
        text = f"The preload missed the tolerance, residual {state.solution.residual:.1e}: "
        yield Note(Rank.WRONG, text + state.solution.status.message)
    if state.directional and not state.contact.any() and state.lowest_force_area > 0:
        cells = math.sqrt(state.lowest_force_area / (math.pi * math.prod(state.problem.grid.spacing)))
        if cells * COARSE < 1:
            yield Note(
                Rank.LIMITED,
                f"The pull-off force contains an error of the grid: the contact under the largest tension has the area "
                f"of a circle with a radius of {cells:.2g} cells. For one smooth sphere on such cells the force is too "
                f"large by about {100 / cells:.2g} %; for several spots by more. Finer cells reduce this error.",
            )
    if not state.preload_too_small:
        return
    part, force = state.lowest_force_area / state.solution.contact_area, state.solution.force
    why = f"{100 * part:.0f} % of its contact still held under the largest tension"
    if force < state.least_preload:
        body = "cylinder" if state._summit.line else "sphere"
        unit = unit_of("force", state.geometry)
        why = (
            f"under {written(force, unit)} the contact is smaller than that of Johnson, Kendall and Roberts at the "
            f"pull-off, for which a {body} needs {written(state.least_preload, unit)}"
        )
    yield Note(
        Rank.DOUBTFUL,
        f"The preload was too small: {why}. After a larger preload the pull-off force may be larger; press deeper "
        "until it stays the same.",
    )
