"""A quasi-static path: from one prescribed depth or force to the next without leaving the basin of the energy.

A step is taken if the energy at the new value is strictly convex on the box that holds the old state and the new: no
other equilibrium lies in it, and the gradient flow from the old state ends in the new one. Else the step is halved,
down to a bracket; what is left then is a limit point of the branch, and the body jumps.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from roughcontact.adhesion.control_form import DepthControl, ForceControl
from roughcontact.adhesion.gap_energy import GapEnergy, Point
from roughcontact.adhesion.gradient_flow import flow, released
from roughcontact.adhesion.lowest_force import LowestForce
from roughcontact.adhesion.reduced_hessian import smallest_ratio
from roughcontact.adhesion.truncated_newton import TOLERANCE, Counter, Equilibrium, minimise
from roughcontact.validation import Array

__all__ = ["Jump", "QuasiStatic", "Station"]

MOVED = 1e-2  # of the range of the attraction: below, a body has not jumped
ON_THE_WAY = 1e-8  # residual of states that nobody asked for
ROUGH = 1e-4  # residual at which the way of a step is judged first
SAME = 1e-5  # of the range of the attraction: gaps of two states that are one


@dataclass(frozen=True, slots=True)
class Jump:
    """An instability: where a branch of equilibria ends, the body jumps to another.

    Attributes
    ----------
    depth : float
        The last depth at which the branch was found [m].
    depth_after : float
        [m]; NaN where a force pulled the body off.
    force_before, force_after : float
        [N]
    bracket : float
        Distance from the last depth (or force) of the branch to the first at which it was not found [m] (or [N]).
    lost : float
        Energy that is lost [J]: infinite where a force pulled the body off, which nothing stops.
    approach : bool
        Whether the depth (or force) was growing.
    ambiguous : bool
        Whether two integrations of the gradient flow ended in different states, of which one may be that of a body
        that is pulled off.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> jumps = rc.adhesive_loop(ball, 1e8, rc.Adhesion(work=10e-3, range=2.5e-9), depth=10e-9).jumps
    >>> first, last = jumps[0], jumps[-1]
    >>> f"in at {first.depth * 1e9:.0f} nm, off at {last.depth * 1e9:.0f} nm", f"{last.lost * 1e18:.0f} aJ are lost"
    ('in at -7 nm, off at -8 nm', '170 aJ are lost')
    """

    depth: float
    depth_after: float
    force_before: float
    force_after: float
    bracket: float
    lost: float
    approach: bool
    ambiguous: bool


@dataclass(frozen=True, slots=True, eq=False)
class Station:
    """A state on a path: what is prescribed, the jumps on the way to it, and the lowest force of the retreat so far.

    The lowest force is infinite where the path has begun, or the body has approached.
    """

    value: float
    point: Point
    residual: float
    converged: bool
    jumps: tuple[Jump, ...] = ()
    lowest_force: float = math.inf


@dataclass(slots=True)
class _Stride:
    """How far to go: twice as far from step to step; toward a value that was missed, by bisection.

    Where a step was missed, the end of the branch may be at any distance, near as far: every further miss squares the
    part that is tried, and between a step that is taken and one that is missed lies their geometric mean.
    """

    least: float
    length: float
    barrier: float = np.inf  # distance of the value that was missed
    misses: int = 0
    row: int = 0

    def next(self) -> float:
        if self.length < self.barrier:
            return max(self.length, self.least)
        if self.row >= 2 or self.barrier <= self.least:
            return self.barrier
        return max(self.barrier / 2, self.least)

    def taken(self, length: float) -> None:
        self.row = 0 if length >= self.barrier else self.row + 1
        self.barrier = self.barrier - length if length < self.barrier else np.inf
        self.length = max(2 * length, math.sqrt(length * self.barrier) if self.barrier < np.inf else 0.0)
        self.misses = 0

    def missed(self, length: float) -> None:
        self.misses += 1
        self.barrier, self.row, self.length = length, 0, length * 0.5 ** (2 ** (self.misses - 1))


@dataclass(slots=True)
class QuasiStatic:
    """Walks along a path of prescribed depths or forces.

    Parameters
    ----------
    control : DepthControl or ForceControl
        What is prescribed.
    bracket : float
        Smallest step of it.
    """

    control: DepthControl | ForceControl
    bracket: float
    counter: Counter = field(default_factory=Counter)
    _vectors: tuple[Array, ...] = ()

    def start(self, value: float, displacement: Array) -> Station:
        """Return where the gradient flow from a displacement ends."""
        end = flow(self.control.energy_at(value), displacement, self._convex, self.counter).equilibrium
        return Station(value, end.point, end.residual, end.converged)

    def go(self, station: Station, target: float) -> Station:
        """Return the state under another value of what is prescribed."""
        jumps: list[Jump] = []
        if released(self.control.energy_at(target), station.point):
            return replace(station, value=target, converged=True, jumps=())
        lowest = LowestForce(self.control, self.counter, station.lowest_force)
        if retreats := target < station.value:
            lowest.begin(station.value, station.point)
        here, stride = station, _Stride(self.bracket, abs(target - station.value))
        # Of the displacement with what is prescribed, in the last step, beyond what the wall takes along.
        change: Array | float = 0.0
        while here.value != target:
            left = target - here.value
            length = min(stride.next(), abs(left))
            value = target if length == abs(left) else here.value + float(np.copysign(length, left))
            energy = self.control.energy_at(value)
            begin = energy.carried(here.point)
            # On the way a state need be no better than the step is long: as sharp as a state asked for at the bracket.
            tolerance = TOLERANCE if value == target else min(ON_THE_WAY, TOLERANCE * length / self.bracket)
            # Where a step was missed, more will be, and a rough solution shows most of them.
            rough = (ROUGH,) if stride.barrier < math.inf and tolerance < ROUGH else ()
            guess = begin.displacement + length * change
            end = self._end(energy, here.point, begin, guess, (*rough, tolerance))
            if end is not None:
                change = (end.point.displacement - begin.displacement) / length
                here = Station(value, end.point, end.residual, True)
                if retreats:
                    lowest.go_on(value, here.point)
                stride.taken(length)
            elif length > self.bracket:
                stride.missed(length)
            else:
                here, jump = self._jump(here, value, energy, begin)
                change = 0.0
                jumps += [jump] if jump else []
                if released(energy, here.point):
                    break
                if retreats:
                    lowest.begin(value, here.point)
                stride = _Stride(self.bracket, abs(target - here.value))
        force = math.inf if target > station.value else lowest.force
        return Station(target, here.point, here.residual, here.converged, tuple(jumps), force)

    def _end(
        self, energy: GapEnergy, before: Point, begin: Point, guess: Array, tolerances: tuple[float, ...]
    ) -> Equilibrium | None:
        """Return the state at the end of a step, if the energy is strictly convex from its begin to there."""
        end: Equilibrium | None = None
        for tolerance in tolerances:
            end = minimise(energy, guess, self.counter, tolerance=tolerance, convex_only=True)
            if not (end.converged and self._convex(energy, begin, end.point, before)):
                return None
            guess = end.point.displacement
        return end

    def _jump(
        self, here: Station, value: float, energy: GapEnergy, begin: Point
    ) -> tuple[Station, Jump | None]:
        start = begin.displacement
        landing = flow(energy, start, self._convex, self.counter)
        end = landing.equilibrium
        scale = energy.attraction.range
        station = Station(value, end.point, end.residual, end.converged)
        moved = float(np.abs(end.point.displacement - begin.displacement).max())
        if moved < MOVED * scale and end.converged:
            return station, None  # the branch goes on, too flat for the test of convexity
        off = released(energy, end.point)
        other = flow(energy, start, self._convex, self.counter, even=True).equilibrium
        apart = float(np.abs(end.point.displacement - other.point.displacement).max()) > SAME * scale
        jump = Jump(
            self.control.depth(here.value, here.point),
            math.nan if off else self.control.depth(value, end.point),
            energy.force(here.point),
            0.0 if off else energy.force(end.point),
            abs(value - here.value),
            math.inf if off else landing.lost,
            value > here.value,
            off != released(energy, other.point) or (apart and not off),
        )
        return station, jump

    def _convex(self, energy: GapEnergy, one: Point, other: Point, before: Point | None = None) -> bool:
        """Whether the energy is strictly convex on the box between two points, as far as can be told.

        The first may come from a point `before`, under another depth: states under depths in between have gaps between
        its gaps and those of the other.
        """
        earlier = before or one
        nearest = np.minimum(np.minimum(one.gap, earlier.gap), other.gap)
        farthest = np.maximum(np.maximum(one.gap, earlier.gap), other.gap)
        free = earlier.free | other.free
        curvature = energy.attraction.curvature_between(nearest, farthest)
        # What bends the energy least is often the way that the state has moved.
        start = (other.displacement - one.displacement, *self._vectors)
        ritz = smallest_ratio(energy.form, free, curvature, self.counter, start=start, sign_only=True)
        self._vectors = ritz.vectors[:1]
        return ritz.positive
