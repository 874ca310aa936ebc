"""The lowest force along a retreat: the largest tension.

It lies where the slope of the force with the depth changes its sign (where it vanishes, or where a cell leaves the
wall), or where a branch ends. On rough surfaces the sign may change at many cells, so the slopes at two states do not
bound the force between them. But the slope is the minimum of a quadratic form, ``(y + 1).K (y + 1) - y.D y`` over all
changes y of the gap that vanish at the wall. It falls as the curvature D of the attraction grows, and as cells leave
the wall. Between two states whose gaps enclose all gaps in between, both are bounded, and so is the slope. The force is
therefore not below the point where the steepest lines from both ends meet; states in between are computed until this
point is not below the lowest force that was found.

Labels E35 and E36 are the lines of the algorithm in docs/concepts/method-adhesion.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import count

import numpy as np

from roughcontact.adhesion.control_form import DepthControl, ForceControl
from roughcontact.adhesion.gap_energy import Point
from roughcontact.adhesion.tangent import force_slope
from roughcontact.adhesion.truncated_newton import Counter, minimise
from roughcontact.validation import Array, Mask

__all__ = ["FORCE_TOLERANCE", "LowestForce"]

FORCE_TOLERANCE = 1e-6  # relative precision of the lowest force
CLOSEST = 0.05  # of the distance of two states: smallest distance of a state in between from each


@dataclass(slots=True)
class LowestForce:
    """The lowest force of a retreat so far.

    Parameters
    ----------
    control : DepthControl or ForceControl
    counter : Counter
        Counts products.
    force : float
        The lowest so far [N].
    depth : float
        The depth at which it acts [m].
    """

    control: DepthControl | ForceControl
    counter: Counter
    force: float
    depth: float = math.nan
    _last: _BranchPoint | None = None

    def start_branch(self, value: float, point: Point) -> None:
        """Begin a branch at a state."""
        self._last = None
        self.extend(value, point)

    def extend(self, value: float, point: Point) -> None:
        """Continue to the next state of a branch; the energy is strictly convex between it and the last state."""
        if isinstance(self.control, ForceControl):
            self._take(value, self.control.depth(value, point))
            return
        new = _BranchPoint(value, self.control.energy_at(value).force(point), point.displacement, point.gap)
        self._take(new.force, value)
        if self._last is not None:
            self._search(self.control, self._last, new)
        self._last = new

    def _take(self, force: float, depth: float) -> None:
        if force < self.force:
            self.force, self.depth = force, depth

    def _search(self, control: DepthControl, upper: _BranchPoint, lower: _BranchPoint) -> None:
        """Find the lowest force between two states, if it is a tension and lower than the lowest so far."""
        order = count()
        intervals: list[tuple[float, int, _Interval]] = []

        def add(upper: _BranchPoint, lower: _BranchPoint) -> None:
            interval = _Interval.of(control, upper, lower, threshold(), self.counter)
            heappush(intervals, (interval.bound, next(order), interval))  # E35

        def threshold() -> float:
            return min(self.force, 0.0) - FORCE_TOLERANCE * abs(self.force)

        add(upper, lower)
        while intervals and intervals[0][0] < threshold():  # E36
            _, _, interval = heappop(intervals)
            between = interval.state_between(control, self.counter)
            if between is not None:
                self._take(between.force, between.depth)
                add(interval.upper, between)
                add(between, interval.lower)


@dataclass(frozen=True, slots=True, eq=False)
class _BranchPoint:
    """A state at a prescribed depth [m]: its force [N], displacement and gap [m] on the cells of the computation."""

    depth: float
    force: float
    displacement: Array
    gap: Array


@dataclass(frozen=True, slots=True, eq=False)
class _Interval:
    """Two states of a branch; the force between them is at least `bound` [N], perhaps reached at `part` of the way."""

    upper: _BranchPoint
    lower: _BranchPoint
    bound: float
    part: float

    @classmethod
    def of(
        cls,
        control: DepthControl,
        upper: _BranchPoint,
        lower: _BranchPoint,
        threshold: float,
        counter: Counter,
    ) -> _Interval:
        """Bound the force between two states, only as closely as `threshold` [N] and zero require."""
        if min(upper.force, lower.force) >= 0:
            return cls(upper, lower, 0.0, 0.0)
        law = control.attraction
        nearest, farthest = np.minimum(upper.gap, lower.gap), np.maximum(upper.gap, lower.gap)

        def slope(free: Mask, curvature: Array) -> float:
            return force_slope(control.form, free, np.where(free, curvature, 0.0), counter)

        least = slope(farthest > 0, law.curvature_between(nearest, farthest))
        width = upper.depth - lower.depth
        if least >= 0 or lower.force + least * width >= threshold:
            return cls(upper, lower, lower.force + min(0.0, least) * width, 0.0)
        # The curvature has at most one peak, so its minimum is at an end.
        most = slope(nearest > 0, np.minimum(law.curvature(nearest), law.curvature(farthest)))
        if most <= 0:
            return cls(upper, lower, upper.force, 1.0)
        rise = (lower.force - upper.force + most * width) / (most - least) if math.isfinite(most) else width
        rise = min(max(rise, 0.0), width)
        return cls(upper, lower, lower.force + least * rise, rise / width)

    def state_between(self, control: DepthControl, counter: Counter) -> _BranchPoint | None:
        """Return the state at which the force may be lowest; None if rounding leaves no value in between."""
        upper, lower = self.upper, self.lower
        part = min(max(self.part, CLOSEST), 1 - CLOSEST)
        depth = lower.depth + part * (upper.depth - lower.depth)
        if not lower.depth < depth < upper.depth:
            return None
        energy = control.energy_at(depth)
        start = lower.displacement + part * (upper.displacement - lower.displacement)
        at_wall = (upper.gap <= 0) & (lower.gap <= 0)
        start = np.where(at_wall, energy.obstacle, start)
        end = minimise(energy, start, counter, convex_only=True)
        if not end.converged:
            return None
        return _BranchPoint(depth, energy.force(end.point), end.point.displacement, end.point.gap)
