"""A viscoelastic contact that is moved from one time to the next: each step is one elastic contact problem."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from roughcontact.arrays import as_like, max_abs, multiply
from roughcontact.contact.continuation import settled, tangent_of
from roughcontact.contact.press import lock, solve_state
from roughcontact.contact.problem import ContactProblem
from roughcontact.halfspace.operators.operator import exact_of
from roughcontact.solver.control import Control, Depth, Force, Solver, Start, State, Tangent
from roughcontact.solver.subdomain import Box, Subdomain, SubdomainSolver, prolong
from roughcontact.validation import Array
from roughcontact.viscoelastic.prony_series import Viscoelastic
from roughcontact.viscoelastic.relaxation_step import Transition
from roughcontact.viscoelastic.viscoelastic_state import ViscoelasticState

__all__ = ["BodyState", "ContactInTime", "Guess", "Search", "Trial"]

Guess = tuple[Array, float]
"""A pressure [Pa] and a depth [m] to start from."""
Search = tuple[Array | None, Box | None]
"""The last tangent [Pa/m] and the last window, which set the last bits of the next state."""


@dataclass(frozen=True, eq=False)
class BodyState:
    """All that the future of a contact depends on, and the sums so far.

    Attributes
    ----------
    time, depth, force : float
        [s], [m], [N].
    pressure : array
        [Pa]
    fields : tuple of two arrays, shape (k + 1, ...)
        X and r_k of the material [Pa], and the displacements that they cause [m].
    products : array, shape (k + 1, k + 1)
        Inner products of X and r_k with these displacements [J].
    totals : array, shape (k + 1,)
        Totals of X and r_k [N].
    work, stored, dissipated : float
        Energies [J].
    largest : array, shape (5,)
        Largest values so far, to which errors are related, of force [N], depth [m], pressure [Pa], total of the strain
        [N], and stored and dissipated energy [J].
    time_residual : float
        Of the last step.
    before : tuple of array and float, optional
        Pressure and depth at its begin; None after a jump.
    """

    time: float
    depth: float
    pressure: Array
    fields: tuple[Any, Any]
    products: Array
    totals: Array
    largest: Array
    force: float = 0.0
    work: float = 0.0
    stored: float = 0.0
    dissipated: float = 0.0
    time_residual: float = 0.0
    before: Guess | None = None

    @property
    def leak(self) -> float:
        """Work less stored and dissipated energy [J]."""
        return self.work - self.stored - self.dissipated

    @property
    def guess(self) -> Guess | None:
        """Where the next step starts: its changes are those of the last step. None without contact."""
        if not self.force > 0:
            return None
        if self.before is None:
            return self.pressure, self.depth
        pressure, depth = self.before
        return (2 * self.pressure - pressure) * (self.pressure > 0), 2 * self.depth - depth


@dataclass(frozen=True, eq=False)
class Trial:
    """A step that is solved.

    Attributes
    ----------
    start : BodyState
    step : float
        [s]; 0 for a jump.
    transition : Transition
    past : array
        Displacement at the end of the step without pressure [m].
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

    start: BodyState
    step: float
    transition: Transition
    past: Array
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
        own = self.problem.measure.total(self.pressure) / self.transition.modulus
        return float(self.transition.past @ self.start.totals) + own

    def finished(self) -> BodyState:
        """Return the body at the end of the step, by one product."""
        start, numbers, measure = self.start, self.transition, self.problem.measure
        modulus, matrix, xp = numbers.modulus, numbers.matrix, measure.xp
        displacement = exact_of(self.problem.operator).apply(self.pressure)
        pressures, displacements = start.fields
        past = _summed(numbers.past, pressures)
        change = past + self.pressure / modulus - pressures[0]
        moved = self.past + displacement / modulus - displacements[0]
        fields = numbers.after(pressures, change), numbers.after(displacements, moved)
        force = measure.total(self.pressure)
        totals = np.append(start.totals, force / modulus)
        mixed = [measure.dot(self.pressure, each) / modulus for each in displacements]
        own = measure.dot(self.pressure, displacement) / modulus**2
        every = np.block([[start.products, np.c_[mixed]], [np.array([*mixed, own])]])
        products = matrix @ every @ matrix.T
        stored = numbers.stored(products)
        work, lost, residual = stored - start.stored, 0.0, 0.0  # a sudden motion is elastic
        if self.step:
            work = numbers.mean_force(totals) * (self.depth - start.depth)
            lost = numbers.dissipated(every)
            middle = _summed(numbers.middle[:-1], pressures)
            touched = (start.pressure > 0) | (self.pressure > 0)
            residual = max_abs(xp.where(touched, 0.0, middle))
        totals = matrix @ totals
        sizes = force, abs(self.depth), max_abs(self.pressure), totals[0], stored + start.dissipated + lost
        largest = np.maximum(start.largest, sizes)
        return BodyState(
            time=start.time + self.step,
            depth=self.depth,
            pressure=self.pressure,
            fields=fields,
            products=products,
            totals=totals,
            largest=largest,
            force=force,
            work=start.work + work,
            stored=stored,
            dissipated=start.dissipated + lost,
            time_residual=_share(residual, float(largest[2])),
            before=(start.pressure, start.depth) if self.step and start.force > 0 else None,
        )


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
    most : float
        Largest load of the history.
    """

    problem: ContactProblem
    material: Viscoelastic
    forced: bool
    solver: Solver
    most: float
    _subdomains: SubdomainSolver = field(init=False)
    _tangent: Tangent | None = field(default=None, init=False)

    def __post_init__(self) -> None:
        self._subdomains = SubdomainSolver(self.problem.operator)

    @property
    def search(self) -> Search:
        """Where the searches of the next step start, beside its guess."""
        return None if self._tangent is None else self._tangent.pressure, self._subdomains.box

    @search.setter
    def search(self, last: Search) -> None:
        tangent, box = last
        self._tangent = None if tangent is None else Tangent(tangent, math.inf)
        if box is not None:
            self._subdomains.operator_on(box)

    def untouched(self, time: float) -> BodyState:
        """Return the undeformed body."""
        xp, count = self.problem.measure.xp, len(self.material.moduli) + 1
        zero = xp.zeros_like(self.problem.separation)
        rest = xp.stack([zero] * count)
        products, totals, largest = np.zeros((count, count)), np.zeros(count), np.zeros(5)
        return BodyState(time, 0.0, zero, (rest, rest), products, totals, largest)

    def attempt(self, start: BodyState, step: float, load: float, guess: Guess | None) -> Trial:
        """Return a solved step [s] to a load: a force [N] or a depth [m]."""
        problem = self.problem
        numbers = Transition.of(self.material, problem.modulus, step)
        past = _summed(numbers.past, start.fields[1])
        separation = problem.separation + past
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
        self, trial: Trial, end: BodyState, time_error: float, products: int, *, prescribed: bool
    ) -> ViscoelasticState:
        """Return the state at the end of a step, with its stiffness."""
        part = self._subdomains.operator_on(trial.subdomain)
        solution = settled(trial.problem, trial.state, trial.subdomain, part, self._tangent)
        self._tangent = tangent_of(solution)
        displacement = end.fields[1][0]
        # Its elastic part is that of the step, times the modulus of the step.
        elastic = trial.transition.modulus * (displacement - trial.past)
        separation = self.problem.separation + displacement - elastic
        control: Control = Force(end.force) if self.forced and end.force > 0 else Depth(max(end.depth, 0.0))
        true = self.problem.moved(separation, control=control)
        return ViscoelasticState(
            time=end.time,
            solution=replace(solution, problem=true, pressure=end.pressure, depth=end.depth),
            displacement=multiply(displacement, 1.0),  # a view would keep all fields
            material=self.material,
            work=end.work,
            stored_energy=end.stored,
            dissipated_energy=end.dissipated,
            time_residual=end.time_residual,
            time_error=time_error,
            products=products,
            prescribed=prescribed,
        )

    def errors(self, coarse: Trial, fine: Trial, end: BodyState) -> tuple[float, float]:
        """Return the estimated errors of the finer of two solutions at one time, with steps in the ratio of two.

        First the largest error of the force or the depth, whichever is not prescribed, of the total strain, which shows
        the recovery of a free surface, and of the balance of energy, over the largest values so far. Then that of the
        fields: the absolute difference of the pressures over the largest force, or that of the areas, less one cell.
        """
        measure, halves = self.problem.measure, [fine.pressure]
        force, depth, _, strain, energy = (end.largest * self._growth(end)).tolist()
        if self.material.dashpot:
            # Pressures jump with the speed: those of the whole step are the mean of its halves.
            halves.append(0.5 * (fine.start.pressure + fine.pressure))
        own = _share(abs(coarse.total_strain - fine.total_strain), strain)
        if self.forced:
            own = max(own, _share(abs(coarse.depth - fine.depth), depth))
        elif not self.material.dashpot:  # whose force, as the fields, follows from the last step
            own = max(own, _share(abs(measure.total(coarse.pressure) - end.force), force))
        pressure = _share(min(measure.total(abs(coarse.pressure - each)) for each in halves), force)
        area = measure.total(fine.pressure > 0)
        more = abs(measure.total(coarse.pressure > 0) - area) - float(np.max(self.problem.operator.weights))
        parts = 2**self.order - 1
        leaks = [abs(each.leak - coarse.start.leak) for each in (fine.start, end)]
        leak = _share(max(leaks), energy)
        return max(own / parts, leak), max(pressure, _share(max(more, 0.0), area)) / parts

    def _growth(self, end: BodyState) -> float:
        """Return the factor by which the largest values will grow with the load, at least.

        With a dashpot the first moments of a contact have an error of the order of their values at any step, so that it
        is related to the values to come.
        """
        reached = float(end.largest[0 if self.forced else 1])
        return max(self.most / reached, 1.0) if self.material.dashpot and reached else 1.0

    @property
    def order(self) -> int:
        """Order of the error in time."""
        return 1 if self.material.dashpot else 2


def _share(part: float, whole: float) -> float:
    return part / whole if whole > 0 else math.inf if part else 0.0


def _summed(factors: Array, fields: Any) -> Any:
    """Return the sum of fields, shape (n, ...), with factors of shape (n,)."""
    count, *shape = fields.shape
    return (as_like(factors, fields) @ fields.reshape(count, -1)).reshape(shape)
