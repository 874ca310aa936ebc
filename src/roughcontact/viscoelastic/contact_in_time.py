"""A viscoelastic contact that is moved from one time to the next: each step is one elastic contact problem."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from roughcontact.arrays import max_abs
from roughcontact.contact.continuation import settled, tangent_of
from roughcontact.contact.press import lock, solve_state
from roughcontact.contact.problem import ContactProblem
from roughcontact.halfspace.operators.operator import exact_of
from roughcontact.solver.control import Control, Depth, Force, Solver, Start, State, Tangent
from roughcontact.solver.subdomain import Subdomain, SubdomainSolver, prolong
from roughcontact.validation import Array
from roughcontact.viscoelastic.prony_series import Viscoelastic
from roughcontact.viscoelastic.relaxation_step import Pair, Transition, combined
from roughcontact.viscoelastic.viscoelastic_state import ViscoelasticState

__all__ = ["ContactInTime", "Guess", "Memory", "Trial"]

Guess = tuple[Array, float]
"""A pressure [Pa] and a depth [m] to start from."""


@dataclass(frozen=True, eq=False)
class Memory:
    """All that the future of a contact depends on, and the sums so far.

    Attributes
    ----------
    time, depth, force : float
        [s], [m], [N].
    pressure : array
        [Pa]
    strain : Pair
        X and the displacement.
    elements : tuple of Pair
        r_k of the material and the displacements that they would cause.
    work, stored, dissipated : float
        Energies [J].
    largest_force, largest_depth, largest_pressure, largest_strain, largest_energy : float
        Largest values so far, to which errors are related: of the strain its total, of the energy that which is stored
        or dissipated.
    time_residual : float
        Of the last step.
    """

    time: float
    depth: float
    pressure: Array
    strain: Pair
    elements: tuple[Pair, ...]
    force: float = 0.0
    work: float = 0.0
    stored: float = 0.0
    dissipated: float = 0.0
    largest_force: float = 0.0
    largest_depth: float = 0.0
    largest_pressure: float = 0.0
    largest_strain: float = 0.0
    largest_energy: float = 0.0
    time_residual: float = 0.0

    @property
    def leak(self) -> float:
        """Work less stored and dissipated energy [J]."""
        return self.work - self.stored - self.dissipated

    @property
    def guess(self) -> Guess | None:
        """Where the next step starts; None without contact."""
        return (self.pressure, self.depth) if self.force > 0 else None


@dataclass(frozen=True, eq=False)
class Trial:
    """A step that is solved.

    Attributes
    ----------
    start : Memory
    step : float
        [s]; 0 for a jump.
    transition : Transition
    past : Pair
        Strain at the end of the step without pressure.
    problem : ContactProblem
        The elastic contact of the step; its pressures are divided by the modulus of the transition.
    state : State
        Its solution on a window.
    subdomain : Subdomain
        The window.
    depth : float
        [m]
    pressure : array
        Pressure at the end of the step [Pa].
    """

    start: Memory
    step: float
    transition: Transition
    past: Pair
    problem: ContactProblem
    state: State
    subdomain: Subdomain
    depth: float
    pressure: Array

    @property
    def guess(self) -> Guess:
        """The end of the step, to start others from."""
        return self.pressure, self.depth

    @property
    def total_strain(self) -> float:
        """Total of the strain at the end of the step [N]."""
        total = self.problem.measure.total
        return total(self.past.pressure) + total(self.pressure) / self.transition.modulus

    def finished(self) -> Memory:
        """Return the memory at the end of the step, by one product."""
        start, numbers, measure = self.start, self.transition, self.problem.measure
        displacement = exact_of(self.problem.operator).apply(self.pressure)
        strain = combined([(1.0, self.past), (1 / numbers.modulus, Pair(self.pressure, displacement))])
        change = combined([(1.0, strain), (-1.0, start.strain)])
        elements = numbers.after(start.elements, change)
        stored = numbers.stored(strain, elements, measure)
        force, highest = measure.total(self.pressure), max(start.largest_pressure, max_abs(self.pressure))
        if not self.step:  # the sudden motion is elastic
            work, dissipated, residual = stored - start.stored, 0.0, 0.0
        else:
            totals = [measure.total(each.pressure) for each in start.elements]
            before, moved = measure.total(start.strain.pressure), measure.total(change.pressure)
            work = numbers.mean_pressure(before, totals, moved) * (self.depth - start.depth)
            dissipated = numbers.dissipated(start.elements, change, measure)
            residual = self._open_pressure(change) / highest if highest else 0.0
        return Memory(
            time=start.time + self.step,
            depth=self.depth,
            pressure=self.pressure,
            strain=strain,
            elements=elements,
            force=force,
            work=start.work + work,
            stored=stored,
            dissipated=start.dissipated + dissipated,
            largest_force=max(start.largest_force, force),
            largest_depth=max(start.largest_depth, abs(self.depth)),
            largest_pressure=highest,
            largest_energy=max(start.largest_energy, stored + start.dissipated + dissipated),
            largest_strain=max(start.largest_strain, measure.total(strain.pressure)),
            time_residual=residual,
        )

    def _open_pressure(self, change: Pair) -> float:
        """Return the largest pressure in the middle of the step on cells that are open at both ends [Pa]."""
        start, xp = self.start, self.problem.measure.xp
        middle = self.transition.halved.pressure(
            start.strain.pressure, [each.pressure for each in start.elements], 0.5 * change.pressure
        )
        return max_abs(xp.where((start.pressure > 0) | (self.pressure > 0), 0.0, middle))


@dataclass(slots=True)
class ContactInTime:
    """A surface against a viscoelastic half-space; it keeps restricted operators and the last tangent.

    Attributes
    ----------
    problem : ContactProblem
        The undeformed surface, with the reference modulus.
    material : Viscoelastic
    forced : bool
        Whether forces are prescribed, otherwise depths.
    solver : Solver
    """

    problem: ContactProblem
    material: Viscoelastic
    forced: bool
    solver: Solver
    _subdomains: SubdomainSolver = field(init=False)
    _tangent: Tangent | None = field(default=None, init=False)

    def __post_init__(self) -> None:
        self._subdomains = SubdomainSolver(self.problem.operator)

    def untouched(self, time: float) -> Memory:
        """Return the undeformed body."""
        zero = self.problem.measure.xp.zeros_like(self.problem.separation)
        rest = Pair(zero, zero)
        return Memory(time, 0.0, zero, rest, (rest,) * len(self.material.moduli))

    def attempt(self, start: Memory, step: float, load: float, guess: Guess | None) -> Trial:
        """Return a solved step [s] to a load: a force [N] or a depth [m]."""
        problem = self.problem
        numbers = Transition.of(self.material, problem.modulus, step)
        past = numbers.past(start.strain, start.elements)
        separation = problem.separation + past.displacement
        touch = float(problem.measure.xp.min(separation))
        control: Control = Depth(0.0 if self.forced else max(load - touch, 0.0))
        if self.forced and load > 0:
            control = Force(load / numbers.modulus)
        problem = problem.moved(separation - touch, control=control)
        first = None if guess is None else Start(guess[0] / numbers.modulus, guess[1] - touch)
        problem, state, subdomain = solve_state(problem, self.solver, first, self._subdomains)
        pressure = prolong(state.pressure, subdomain, problem.grid.shape) * numbers.modulus
        lock(pressure)
        depth = touch + state.depth if self.forced else load
        return Trial(start, step, numbers, past, problem, state, subdomain, depth, pressure)

    def state(
        self, trial: Trial, end: Memory, time_error: float, products: int, *, prescribed: bool
    ) -> ViscoelasticState:
        """Return the state at the end of a step, with its stiffness."""
        part = self._subdomains.operator_on(trial.subdomain)
        solution = settled(trial.problem, trial.state, trial.subdomain, part, self._tangent)
        self._tangent = tangent_of(solution)
        # The elastic displacement is that of the strain less that of the past.
        elastic = trial.transition.modulus * (end.strain.displacement - trial.past.displacement)
        separation = self.problem.separation + (end.strain.displacement - elastic)
        control: Control = Force(end.force) if self.forced and end.force > 0 else Depth(max(end.depth, 0.0))
        true = self.problem.moved(separation, control=control)
        return ViscoelasticState(
            time=end.time,
            solution=replace(solution, problem=true, pressure=end.pressure, depth=end.depth),
            displacement=end.strain.displacement,
            material=self.material,
            work=end.work,
            stored_energy=end.stored,
            dissipated_energy=end.dissipated,
            time_residual=end.time_residual,
            time_error=time_error,
            products=products,
            prescribed=prescribed,
        )

    def errors(self, coarse: Trial, fine: Trial, end: Memory) -> tuple[float, float]:
        """Return the estimated errors of the finer of two solutions at one time, with steps in the ratio of two.

        First the largest error of what is not prescribed, the force or the depth, of the total strain, which shows the
        recovery of a free surface, and of the balance of energy, over the largest values so far. Then that of the
        fields: the absolute difference of the pressures over the largest force, or that of the areas, less one cell.
        """
        measure = self.problem.measure
        if self.forced:
            own = _share(abs(coarse.depth - fine.depth), end.largest_depth)
        else:
            own = _share(abs(measure.total(coarse.pressure) - end.force), end.largest_force)
        strain = _share(abs(coarse.total_strain - fine.total_strain), end.largest_strain)
        pressure = _share(measure.total(abs(coarse.pressure - fine.pressure)), end.largest_force)
        area = measure.total(fine.pressure > 0)
        more = abs(measure.total(coarse.pressure > 0) - area) - float(np.max(self.problem.operator.weights))
        parts = 2**self.order - 1
        leaks = [abs(each.leak - coarse.start.leak) for each in (fine.start, end)]
        leak = _share(max(leaks), end.largest_energy)
        return max(max(own, strain) / parts, leak), max(pressure, _share(max(more, 0.0), area)) / parts

    @property
    def order(self) -> int:
        """Order of the error in time."""
        return 1 if self.material.dashpot else 2


def _share(part: float, whole: float) -> float:
    return part / whole if whole > 0 else math.inf if part else 0.0
