"""A state of an adhesive contact, with its certificate, energies, stiffness and stability."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact import methods
from roughcontact.adhesion.attraction import Adhesion, Attraction
from roughcontact.adhesion.control_form import DepthControl, ForceControl
from roughcontact.adhesion.elastic_form import ElasticForm
from roughcontact.adhesion.gap_energy import GapEnergy, Point
from roughcontact.adhesion.gradient_flow import detached
from roughcontact.adhesion.model_limits import HighestSummit, highest_summit, notes_on_model, notes_on_status
from roughcontact.adhesion.quasi_static import Jump, PathPoint
from roughcontact.adhesion.reduced_hessian import smallest_ratio, solved_bound
from roughcontact.adhesion.tangent import force_slope
from roughcontact.adhesion.truncated_newton import Counter
from roughcontact.cached import cached_property
from roughcontact.grid import AnyGrid
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import Operator, exact_of, geometry_of
from roughcontact.labels.note import in_order
from roughcontact.solver.control import Status
from roughcontact.surface.radial import RadialProfile
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, Mask

__all__ = ["AdhesiveProblem", "AdhesiveState", "state_of"]

WEAK = 1e-6  # of the largest traction: a smaller reaction of the wall may be rounding


@dataclass(frozen=True, slots=True, eq=False)
class AdhesiveProblem:
    """The problem of an adhesive contact, shared by the states of one path.

    Attributes
    ----------
    operator : Operator
        The body.
    separation : array, shape of the grid
        Undeformed gap at first touch [m]; infinite where nothing was measured.
    adhesion : Adhesion
        The attraction between the bodies.
    modulus : float
        Reduced modulus E* [Pa].
    surface : Surface or RadialProfile, optional
        The surface that the separation comes from.
    form : ElasticForm
        Its elastic form.
    control : DepthControl or ForceControl
        The prescribed quantity, as an energy.
    tolerance : float
        Largest residual.
    resolved : bool
        Whether the attraction varies over at least a cell and a half.
    """

    operator: Operator
    separation: Array
    adhesion: Adhesion
    modulus: float
    surface: Surface | RadialProfile | None
    form: ElasticForm
    control: DepthControl | ForceControl
    tolerance: float
    resolved: bool

    @property
    def grid(self) -> AnyGrid:
        """The grid of the operator."""
        return self.operator.grid

    @property
    def measured(self) -> Mask:
        """Cells that hold a height."""
        return np.isfinite(self.separation)


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class AdhesiveState:
    """An equilibrium of an adhesive contact; other quantities are computed once, on first access.

    Attributes
    ----------
    problem : AdhesiveProblem
        Body, separation and tolerance.
    attraction : Attraction
        The law on the cells.
    depth : float
        Approach of the bodies since first touch [m]; negative if the undeformed surfaces are apart, minus infinity once
        a force has pulled the bodies off, which then carry no force.
    pressure : array, shape of the grid
        Reaction of the wall minus the attraction [Pa]: negative under tension.
    contact : array of bool, shape of the grid
        Cells at the wall.
    residual : float
        Largest violation of the conditions of equilibrium as a traction, relative to the law's largest attraction or
        the largest pressure if that is larger, from an exact product with the pressure. A gap in contact counts by the
        pressure on only its cell that would close it. Under a prescribed force it includes the error of the force,
        relative to the sum of the absolute tractions.
    jumps : tuple of Jump
        Instabilities since the state before.
    products : int
        Products with the stiffness or the compliance of the body since the state before.
    lowest_force : float
        Lowest force since the begin of the retreat [N], including values between states and in jumps: minus the largest
        tension, to 1e-6 of it (under prescribed forces, to the bracket of the last jump). After an approach, the force
        of the state.
    lowest_force_depth : float
        Depth at the lowest force [m].

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> state = rc.adhesive_state(ball, 1e8, rc.Adhesion(work=10e-3, range=4e-9), depth=0.0)
    >>> f"{state.force * 1e9:.0f} nN at a depth of zero, on {state.contact.sum()} rings"
    '-440 nN at a depth of zero, on 34 rings'
    >>> state.residual < 1e-8, state.stability > 0
    (True, True)
    >>> f"{float(state.to_dataset()['adhesive_energy']) * 1e15:.1f} fJ of adhesion", state.to_record()["law"]
    ('-5.7 fJ of adhesion', 'exponential')
    """

    problem: AdhesiveProblem
    attraction: Attraction
    depth: float
    pressure: Array
    contact: Mask
    residual: float
    jumps: tuple[Jump, ...]
    products: int
    lowest_force: float
    lowest_force_depth: float

    @property
    def missing(self) -> int:
        """Number of cells without a height; they never touch."""
        return int(np.count_nonzero(~self.problem.measured))

    @property
    def status(self) -> Status:
        """Whether the certificate meets the tolerance."""
        if not self.residual <= self.problem.tolerance:
            return Status.STAGNATED
        return Status.CONVERGED if self.contact.any() else Status.NO_CONTACT

    @property
    def unresolved(self) -> bool:
        """Whether the attraction varies from cell to cell: the state then depends on the grid."""
        return not self.problem.resolved

    @cached_property
    def _summit(self) -> HighestSummit:
        problem = self.problem
        return highest_summit(problem.operator, problem.separation, problem.modulus, problem.adhesion.work)

    @property
    def summit_radius(self) -> float:
        """Radius of the body at its highest summit [m]: that of a paraboloid fitted over the contact without load.

        The contact is that of Johnson, Kendall and Roberts for this radius. Roughness that is much smaller has no
        effect.
        """
        return self._summit.radius

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these numbers, in sentences; notes on wrong numbers come first."""
        of_status = notes_on_status([self.status], [self.residual])
        return in_order((*of_status, *notes_on_model(self._summit, self.unresolved)))

    @cached_property
    def displacement(self) -> Array:
        """Displacement of the surface [m], by an exact product."""
        return exact_of(self.problem.operator).apply(self.pressure)

    @cached_property
    def gap(self) -> Array:
        """Deformed gap [m]; infinite where nothing was measured."""
        return np.asarray(self.displacement + self.problem.separation - self.depth)

    @cached_property
    def reaction(self) -> Array:
        """Pressure of the wall [Pa]: zero outside contact."""
        reaction = self.pressure + self.attraction.traction(np.maximum(self.gap, 0.0))
        return np.where(self.contact, reaction, 0.0)

    @property
    def attracted(self) -> Mask:
        """Cells outside contact whose gap is at most the range of the attraction."""
        return np.asarray(~self.contact & (self.gap <= self.attraction.range))

    @property
    def geometry(self) -> Geometry:
        """Geometry of the cells: those of a surface, a line, or rings."""
        return geometry_of(self.problem.operator)

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
    def mean_gap(self) -> float:
        """Gap averaged over the measured cells [m]."""
        there = self.problem.measured
        areas = np.broadcast_to(np.asarray(self._weights, np.float64), there.shape)[there]
        return float(np.average(self.gap[there], weights=areas))

    @property
    def force(self) -> float:
        """Normal force [N], tension negative; [N/m] on a line."""
        return float(np.sum(self.pressure * self._weights))

    @property
    def contact_area(self) -> float:
        """Area of the cells at the wall [m^2]; [m] on a line."""
        return float(np.sum(self.contact * self._weights))

    @property
    def contact_fraction(self) -> float:
        """Contact area over the nominal area."""
        return self.contact_area / self.nominal_area

    @property
    def elastic_energy(self) -> float:
        """Elastic energy of the body [J]."""
        return 0.5 * float(np.sum(self.pressure * self.displacement * self._weights))

    @property
    def adhesive_energy(self) -> float:
        """Energy of the attraction over all cells [J], negative."""
        gap = np.where(self.contact, 0.0, np.maximum(self.gap, 0.0))
        return float(np.sum(self.attraction.energy(gap) * self._weights))

    @property
    def energy(self) -> float:
        """Elastic and adhesive energy [J]; its slope with the depth is the force."""
        return self.elastic_energy + self.adhesive_energy

    @cached_property
    def stiffness(self) -> float:
        """Slope of the force with the depth along the branch [N/m], including the change of the attraction."""
        return self._slope(self._energy.attraction.curvature(self._point.gap))

    @cached_property
    def contact_stiffness(self) -> float:
        """Slope of the force with the depth at fixed contact and fixed attraction [N/m]."""
        return self._slope(np.zeros(self.problem.form.shape)) if self.contact.any() else 0.0

    @property
    def stability(self) -> float:
        """Smallest eigenvalue found of the Hessian on the free cells, relative to the elastic Hessian.

        It holds at a prescribed depth, or under a prescribed force with the depth free. It is 1 without attraction, and
        0 where the branch ends. The smallest eigenvalue is at most this value; two searches from different starts may
        both miss a smaller one. Cells whose reaction is almost zero count as free.
        """
        return self._ritz[0]

    @property
    def stability_residual(self) -> float:
        """Residual of the eigenvector of `stability`: an eigenvalue, not always the smallest, lies within it."""
        return self._ritz[1]

    @cached_property
    def weakly_active(self) -> Mask:
        """Cells in contact whose reaction is almost zero."""
        scale = self._energy.scale(self._point)
        return np.asarray(self.contact & (self.reaction <= WEAK * scale))

    to_dataset = methods.state_dataset
    to_record = methods.state_record
    plot = methods.plot_state
    _repr_html_ = methods.state_html

    def __repr__(self) -> str:
        """Return the main numbers, without the fields."""
        return (
            f"AdhesiveState({self.status.value}, force {self.force:.4g}, depth {self.depth:.4g} m, "
            f"{int(np.count_nonzero(self.contact))} cells in contact, residual {self.residual:.1e})"
        )

    @cached_property
    def _ritz(self) -> tuple[float, float]:
        free = self._free_cells(self.contact & ~self.weakly_active)
        form = self.problem.control.form
        curvature = self._energy.attraction.curvature(self._point.gap)
        found = [smallest_ratio(form, free, curvature, Counter(), seed=seed) for seed in (0, 1)]
        least = min(found, key=lambda ritz: ritz.value)
        return least.value, least.bound if form is self.problem.form else solved_bound(form, free, least)

    @cached_property
    def _energy(self) -> GapEnergy:
        obstacle = self.problem.form.extended(self.depth - self.problem.separation, -np.inf)
        return GapEnergy(self.problem.form, self.problem.control.attraction, obstacle)

    @cached_property
    def _point(self) -> Point:
        """The state on the cells of the computation; cells beyond the grid only need to have no wall."""
        gap = self.problem.form.extended(np.where(self.contact, 0.0, np.maximum(self.gap, 0.0)), np.inf)
        pressure = self.problem.form.extended(self.pressure, 0.0)
        return Point(gap, pressure, gap, pressure, 0.0)

    def _free_cells(self, at_wall: Mask) -> Mask:
        """Return the cells of the computation that may move."""
        free = np.ones(self.problem.form.shape, bool)
        free[self.problem.form.inside] = ~at_wall
        return free

    def _slope(self, curvature: Array) -> float:
        free = self._free_cells(self.contact)
        return force_slope(self.problem.form, free, np.where(free, curvature, 0.0), Counter())

    @property
    def _weights(self) -> float | Array:
        return self.problem.operator.weights


def state_of(problem: AdhesiveProblem, reached: PathPoint, products: int) -> AdhesiveState:
    """Return the state at a point of a path, certified by an exact product."""
    control, point, value = problem.control, reached.point, reached.value
    energy = control.energy_at(value)
    inside = energy.form.inside
    law = energy.attraction.on(inside)
    if detached(energy, point):
        nothing = np.zeros(energy.form.grid.shape)
        lowest = min((reached.lowest_force, reached.lowest_force_depth), (0.0, -math.inf))
        return AdhesiveState(
            problem, law, -math.inf, nothing, nothing > 0, 0.0, reached.jumps, products, *lowest
        )
    depth = control.depth(value, point)
    gap = point.gap[inside]
    contact = gap <= 0
    # Away from the wall the pressure is minus the attraction; at the wall it follows from the body.
    pressure = np.where(contact, point.pressure[inside], -law.traction(gap))
    for array in (pressure, contact):
        array.flags.writeable = False
    exact = exact_of(problem.operator).apply(pressure) + problem.separation - depth
    reaction = pressure + law.traction(np.maximum(exact, 0.0))
    worst = float(np.abs(np.minimum(exact / energy.form.reference, reaction)).max())
    residual = worst / energy.scale(point)
    weighted = pressure * problem.operator.weights
    force = float(weighted.sum())
    if isinstance(control, ForceControl):
        residual = max(residual, abs(force - value) / float(np.abs(weighted).sum()))
    lowest = min((reached.lowest_force, reached.lowest_force_depth), (force, depth))
    return AdhesiveState(problem, law, depth, pressure, contact, residual, reached.jumps, products, *lowest)
