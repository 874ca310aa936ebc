"""A quasi-static path: from one prescribed depth or force to the next within one basin of the energy.

A step is accepted if the energy at the new value is strictly convex on the box that contains the old and the new state:
it contains no other equilibrium, and the gradient flow from the old state ends in the new one. Otherwise the step is
halved, down to a bracket. A step as short as the bracket that is not accepted contains a limit point of the branch, and
the body jumps.

Labels E24 to E30 are the lines of the algorithm in docs/concepts/method-adhesion.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from roughcontact.adhesion.control_form import DepthControl, ForceControl
from roughcontact.adhesion.gap_energy import GapEnergy, Point
from roughcontact.adhesion.gradient_flow import detached, flow
from roughcontact.adhesion.lowest_force import LowestForce
from roughcontact.adhesion.reduced_hessian import smallest_ratio
from roughcontact.adhesion.truncated_newton import TOLERANCE, Counter, Equilibrium, minimise
from roughcontact.progress.events import RunningTask
from roughcontact.validation import Array

__all__ = ["Jump", "PathPoint", "QuasiStatic"]

MOVED = 1e-2  # of the range of the attraction: a smaller change is not a jump
# Residuals of states between the prescribed values: of a retreat, whose lowest force may be theirs, and of an approach,
# where they only start the next step.
ON_THE_WAY, APPROACHING = 1e-8, 1e-4
COARSE = 1e-4  # residual of a first, coarse solution of a step
SURE = 1e-5  # accuracy of an eigenvalue whose sign is needed
LONGER = 4.0  # times the last step: the next one at most
TO_THE_END = 0.85  # of the estimated distance to the end of a branch
IN_THE_BOX = 0.5  # of the eigenvalue of a state: by how much that of the box of the next step may be smaller
SAME = 1e-5  # of the range of the attraction: difference of gaps below which two states are the same


@dataclass(frozen=True, slots=True)
class Jump:
    """An instability: the end of a branch of equilibria, from which the body jumps to another branch.

    Attributes
    ----------
    depth : float
        The last depth at which the branch was found [m].
    depth_after : float
        [m]; NaN if a force pulled the body off.
    force_before, force_after : float
        [N]
    bracket : float
        Distance from the last depth (or force) of the branch to the first one at which it was not found [m] (or [N]).
    lost : float
        Lost energy [J]; infinite if a force pulled the body off.
    approach : bool
        Whether the depth (or force) was growing.
    ambiguous : bool
        Whether two integrations of the gradient flow ended in different states; in one of them the bodies may be apart.

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
class PathPoint:
    """A state on a path: the prescribed value, the jumps before it, the lowest force of the retreat, and its depth.

    The lowest force is infinite at the begin of the path, and after an approach.
    """

    value: float
    point: Point
    residual: float
    converged: bool
    jumps: tuple[Jump, ...] = ()
    lowest_force: float = math.inf
    lowest_force_depth: float = math.nan


@dataclass(slots=True)
class _StepControl:
    """Step length: estimated from the eigenvalues of accepted steps; bisected toward the value of a rejected step.

    The square of the eigenvalue of a state falls to zero at the end of a branch, linearly close to it. The eigenvalue
    of a box is smaller than that of its state, by the square of the step. After a rejection the end of the branch may
    be at any distance. Each further rejection squares the fraction of the step that is tried.
    """

    smallest: float
    length: float
    rejected: float = np.inf  # distance to the last value without a state
    rejections: int = 0  # in a row
    accepted: int = 0  # steps in a row since a rejection
    eigenvalue: float = 0.0  # of the last state; 0 if it is not known

    def proposal(self) -> float:
        if self.length < self.rejected:
            return max(self.length, self.smallest)
        if self.accepted >= 2 or self.rejected <= self.smallest:
            return self.rejected
        return max(self.rejected / 2, self.smallest)

    def accept(self, length: float, state: float, box: float) -> None:
        """Take a step with the eigenvalues of its state and of its box."""
        self.accepted = 0 if length >= self.rejected else self.accepted + 1
        self.rejected = self.rejected - length if length < self.rejected else np.inf
        fall = max(0.0, self.eigenvalue**2 - state**2) / (TO_THE_END * state**2)
        narrowing = math.sqrt(max(0.0, state - box) / (IN_THE_BOX * state))
        self.length = length / max(fall, narrowing, 1 / LONGER)
        self.rejections, self.eigenvalue = 0, state

    def reject(self, length: float, *, found: bool) -> None:
        """Shorten a step, on whose way the energy was not convex, or whose state was not even found."""
        self.rejections += 1
        self.rejected, self.accepted = np.inf if found else length, 0
        self.length = length * 0.5 ** (2 ** (self.rejections - 1))


@dataclass(slots=True)
class QuasiStatic:
    """Follows a path of prescribed depths or forces.

    Parameters
    ----------
    control : DepthControl or ForceControl
        The prescribed quantity, as an energy.
    bracket : float
        Smallest step of the prescribed value.
    """

    control: DepthControl | ForceControl
    bracket: float
    counter: Counter = field(default_factory=Counter)
    task: RunningTask | None = None  # reports the part of the way to the next value [%]
    _vectors: tuple[Array, ...] = ()
    _eigenvalues: tuple[float, float] = (1.0, 1.0)  # of the last state that was tested, and of its box

    def start(self, value: float, displacement: Array) -> PathPoint:
        """Return the end of the gradient flow from a displacement."""
        end = flow(self.control.energy_at(value), displacement, self._convex, self.counter).equilibrium
        return PathPoint(value, end.point, end.residual, end.converged)

    def continue_to(self, start: PathPoint, target: float) -> PathPoint:
        """Continue the branch from a point to another prescribed value, with jumps where a branch ends."""
        jumps: list[Jump] = []
        if detached(self.control.energy_at(target), start.point):
            return replace(start, value=target, converged=True, jumps=())
        lowest = LowestForce(self.control, self.counter, start.lowest_force, start.lowest_force_depth)
        if retreats := target < start.value:
            lowest.start_branch(start.value, start.point)
        here, steps = start, _StepControl(self.bracket, abs(target - start.value))  # E24
        # Slope of the secant predictor: the change of the displacement with the prescribed value in the last step,
        # without the displacement of the cells at the wall.
        slope: Array | float = 0.0
        while here.value != target:
            left = target - here.value
            length = min(steps.proposal(), abs(left))
            value = target if length == abs(left) else here.value + float(np.copysign(length, left))
            energy = self.control.energy_at(value)
            moved = energy.at_depth(here.point)  # E25
            # Between prescribed values the residual may be larger, in proportion to the step.
            loosest = ON_THE_WAY if retreats else APPROACHING
            tolerance = TOLERANCE if value == target else min(loosest, TOLERANCE * length / self.bracket)
            # After a rejection more follow, and a coarse solution detects most of them.
            coarse = (COARSE,) if steps.rejected < math.inf and tolerance < COARSE else ()
            predicted = moved.displacement + length * slope
            end, convex = self._end(energy, here.point, moved, predicted, (*coarse, tolerance))  # E26, E27
            if convex:
                slope = (end.point.displacement - moved.displacement) / length
                here = PathPoint(value, end.point, end.residual, True)
                if self.task is not None:
                    self.task.reached(100 * abs(value - start.value) / abs(target - start.value))
                if retreats:
                    lowest.extend(value, here.point)
                steps.accept(length, *self._eigenvalues)  # E28
            elif length > self.bracket:
                steps.reject(length, found=end.converged)
            else:
                here, jump = self._jump(here, value, energy, moved)  # E29
                slope = 0.0
                jumps += [jump] if jump else []
                if detached(energy, here.point):
                    break
                if retreats:
                    lowest.start_branch(value, here.point)
                steps = _StepControl(self.bracket, abs(target - here.value))
        least = (math.inf, math.nan) if target > start.value else (lowest.force, lowest.depth)
        return PathPoint(target, here.point, here.residual, here.converged, tuple(jumps), *least)

    def _end(
        self, energy: GapEnergy, before: Point, moved: Point, guess: Array, tolerances: tuple[float, ...]
    ) -> tuple[Equilibrium, bool]:
        """Return the end of a step, and whether the energy is strictly convex between both ends of the step."""
        for tolerance in tolerances:
            end = minimise(energy, guess, self.counter, tolerance=tolerance, convex_only=True)
            if not (end.converged and self._convex(energy, moved, end.point, before)):
                return end, False
            guess = end.point.displacement
        return end, True

    def _jump(
        self, here: PathPoint, value: float, energy: GapEnergy, moved: Point
    ) -> tuple[PathPoint, Jump | None]:
        start = moved.displacement
        result = flow(energy, start, self._convex, self.counter)
        end = result.equilibrium
        scale = energy.attraction.range
        reached = PathPoint(value, end.point, end.residual, end.converged)
        change = float(np.abs(end.point.displacement - start).max())
        if change < MOVED * scale and end.converged:  # E30
            return reached, None  # the branch continues, too flat for the test of convexity
        off = detached(energy, end.point)
        other = flow(energy, start, self._convex, self.counter, uniform=True).equilibrium
        differ = float(np.abs(end.point.displacement - other.point.displacement).max()) > SAME * scale
        jump = Jump(
            self.control.depth(here.value, here.point),
            math.nan if off else self.control.depth(value, end.point),
            energy.force(here.point),
            0.0 if off else energy.force(end.point),
            abs(value - here.value),
            math.inf if off else result.lost,
            value > here.value,
            off != detached(energy, other.point) or (differ and not off),
        )
        return reached, jump

    def _convex(self, energy: GapEnergy, one: Point, other: Point, before: Point | None = None) -> bool:
        """Whether the energy is strictly convex on the box between two points, as far as the search finds.

        The first may come from a point `before`, at another depth: the gaps of states at depths in between lie between
        its gaps and those of the other.
        """
        earlier = before or one
        nearest = np.minimum(np.minimum(one.gap, earlier.gap), other.gap)
        farthest = np.maximum(np.maximum(one.gap, earlier.gap), other.gap)
        free = earlier.free | other.free
        curvature = energy.attraction.curvature_between(nearest, farthest)
        # The direction of least curvature is often the change of the state itself.
        start = (other.displacement - one.displacement, *self._vectors)
        ritz = smallest_ratio(
            energy.form, free, curvature, self.counter, start=start, accuracy=SURE, sign_only=True
        )
        self._vectors = ritz.vectors
        softer = curvature - np.where(other.free, energy.attraction.curvature(other.gap), 0.0)
        more = sum(energy.form.dot(softer * x, x) for x in self._vectors)
        self._eigenvalues = ritz.value + more, ritz.value
        return ritz.positive
