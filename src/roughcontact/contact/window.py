"""The window: contact lies where the bodies overlap, so nothing outside needs to be computed."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from roughcontact.contact.problem import Control
from roughcontact.contact.state import Solver, State
from roughcontact.halfspace.operator import Operator

__all__ = ["Box", "Windows", "bounding_box", "embed"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]
Box = tuple[slice, ...]


def bounding_box(mask: Mask) -> Box | None:
    """Return the smallest window that holds every cell of `mask`; None for an empty one."""
    box = []
    for axis in range(mask.ndim):
        others = tuple(a for a in range(mask.ndim) if a != axis)
        hits = np.flatnonzero(mask.any(axis=others))
        if not len(hits):
            return None
        box.append(slice(int(hits[0]), int(hits[-1]) + 1))
    return tuple(box)


def embed(field: Array, box: Box, shape: tuple[int, ...]) -> Array:
    """Return `field` in its place on the whole grid, zero elsewhere."""
    whole = np.zeros(shape)
    whole[box] = field
    return whole


def _union(a: Box, b: Box) -> Box:
    return tuple(slice(min(s.start, t.start), max(s.stop, t.stop)) for s, t in zip(a, b, strict=True))


def _holds(a: Box, b: Box) -> bool:
    return all(s.start <= t.start and t.stop <= s.stop for s, t in zip(a, b, strict=True))


@dataclass(slots=True)
class Windows:
    """Solves on the window of a problem; keeps the last restricted operator for the next load.

    If no pressure lifts any cell, the displacement is nowhere negative and the gap outside the overlap
    ``separation < depth`` is positive whatever the pressure: contact lies in the overlap. A solve on a part
    of the cells overestimates the depth at a given force, so the overlap found from it is safe, and the
    answer on a window that holds its own overlap is the answer on the whole grid.
    """

    operator: Operator
    _last: tuple[tuple[int, ...], Operator] | None = field(default=None)

    def solve(
        self,
        solver: Solver,
        separation: Array,
        control: Control,
        guess: tuple[Array, float],
        tolerance: float,
    ) -> tuple[State, Box]:
        """Solve from a `guess` of pressure [Pa] on the whole grid and depth [m]; return the state on its box."""
        pressure, depth = guess
        whole = tuple(slice(0, n) for n in separation.shape)
        if not self.operator.positive:
            return solver.run(self.operator, separation, control, pressure, tolerance), whole
        box = bounding_box((separation < depth) | (pressure > 0))
        if box is None:
            box = bounding_box(separation == separation.min())
        assert box is not None  # a separation has a minimum
        while True:
            part = self.part(box)
            state = solver.run(part, separation[box], control, pressure[box], tolerance)
            overlap = bounding_box(separation < state.depth)
            if overlap is None or _holds(box, overlap):
                return state, box
            pressure = embed(state.pressure, box, separation.shape)
            box = _union(box, overlap)

    def part(self, box: Box) -> Operator:
        """Return the operator between the cells of `box`."""
        shape = tuple(s.stop - s.start for s in box)
        if shape == self.operator.grid.shape:
            return self.operator
        if self._last is None or self._last[0] != shape:
            self._last = (shape, self.operator.restrict(box))
        return self._last[1]
