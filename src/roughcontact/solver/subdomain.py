"""The window: contact lies where the bodies overlap, so nothing outside needs to be computed."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import is_numpy
from roughcontact.halfspace.operators.operator import Operator, capabilities
from roughcontact.halfspace.sums.tiles import SIDE, Tiles
from roughcontact.solver.control import Terms
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.refinement import run_certified
from roughcontact.solver.state import Solver, State

__all__ = ["Place", "Windows", "bounding_box", "embed", "take"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]
Box = tuple[slice, ...]
Place = Box | npt.NDArray[np.intp]
"""Where a part of the grid lies: a box of cells, or a list of them (flat indices)."""

# A direct sum between the cells of a list is worth it while a quarter of their square (a typical contact
# is a quarter of the overlap) costs less than a transform of the padded box: in look-ups of the influence table a cell
# of the padded box. Transforms cost 0.3 to 0.7 (benchmarks/transforms.py), but a new window takes a kernel too: with
# 0.6, tried by hand, a curve at 256 x 256 took a third longer.
LOOKUPS = 1.5
FILLED = 0.2  # of a box, up to which a list of cells is worth it where there are tiles
LARGE = 2**21  # cells of a box from which on each pass over it is worth sparing (both tried by hand)


def bounding_box(mask: Mask) -> Box | None:
    """Return the smallest box that holds every cell of `mask`; None for an empty one."""
    box = []
    for axis in range(mask.ndim):
        others = tuple(a for a in range(mask.ndim) if a != axis)
        hits = np.flatnonzero(mask.any(axis=others))
        if not len(hits):
            return None
        box.append(slice(int(hits[0]), int(hits[-1]) + 1))
    return tuple(box)


def take(field: Any, place: Place) -> Any:
    """Return the part of a field at `place`."""
    return field[place] if isinstance(place, tuple) else field.ravel()[place]


def embed(part: Array, place: Place, shape: tuple[int, ...]) -> Array:
    """Return `part` in its place on the whole grid, zero elsewhere."""
    if tuple(part.shape) == shape:
        return part
    whole = np.zeros(shape)
    if isinstance(place, tuple):
        whole[place] = part
    else:
        whole.ravel()[place] = part
    return whole


@dataclass(slots=True)
class Windows:
    """Solves on the window of a problem; keeps the last restricted operator for the next load.

    If no pressure lifts any cell, the displacement is nowhere negative and the gap outside the overlap
    ``separation < depth`` is positive whatever the pressure: contact lies in the overlap. A solve on a part
    of the cells overestimates the depth at a given force, so the overlap found from it is safe, and the
    answer on a window that holds its own overlap is the answer on the whole grid.
    """

    operator: Operator
    _box: tuple[Box, Operator] | None = field(default=None)
    _list: tuple[npt.NDArray[np.intp], Operator] | None = field(default=None)

    def solve(
        self,
        solver: Solver,
        separation: Array,
        terms: Terms,
        guess: tuple[Array, float],
    ) -> tuple[State, Place]:
        """Solve from a `guess` of pressure [Pa] on the whole grid and depth [m]; return the state in its place."""
        pressure, depth = guess
        if not (capabilities(self.operator).positive and is_numpy(separation)):
            # Elsewhere than on the host a window would cost a look at every side of the overlap.
            whole = tuple(slice(0, n) for n in separation.shape)
            return run_certified(solver, self.operator, separation, terms, pressure), whole
        window = (separation < depth) | (pressure > 0)
        if not window.any():
            window = separation == separation.min()
        window |= _carrying(Measure(self.operator.weights), separation, terms)
        steps = 0
        while True:
            place = self._place(window)
            state = run_certified(
                solver, self.part(place), take(separation, place), terms, take(pressure, place)
            )
            steps += state.steps
            overlap = separation < state.depth
            if np.count_nonzero(overlap) == np.count_nonzero(take(overlap, place)):
                return replace(state, steps=steps), place
            pressure = embed(state.pressure, place, separation.shape)
            window |= overlap

    def part(self, place: Place) -> Operator:
        """Return the operator between the cells of `place`."""
        if not isinstance(place, tuple):
            if self._list is None or self._list[0] is not place:
                self._list = (place, self._between(place))
            return self._list[1]
        shape = tuple(s.stop - s.start for s in place)
        if shape == self.operator.grid.shape:
            return self.operator
        if self._box is None or self._box[0] != place:
            self._box = (place, self.operator.restrict(place))
        return self._box[1]

    def _between(self, cells: npt.NDArray[np.intp]) -> Operator:
        """Return the operator between the cells of a list, as part of the box that holds them, which is kept."""
        submatrix = capabilities(self.operator).submatrix
        assert submatrix is not None  # no list is made of others
        if self.operator.grid.ndim == 1:
            return submatrix(cells)
        shape = self.operator.grid.shape
        places = np.unravel_index(cells, shape)
        box = self._kept(tuple(slice(int(p.min()), int(p.max()) + 1) for p in places))
        part = self.part(box)
        part_submatrix = capabilities(part).submatrix
        if part_submatrix is None:
            return submatrix(cells)
        inside = tuple(p - s.start for p, s in zip(places, box, strict=True))
        return part_submatrix(np.ravel_multi_index(inside, part.grid.shape))

    def _place(self, window: Mask) -> Place:
        """Return the box of a window, or the list of its cells where a direct sum costs less."""
        box = bounding_box(window)
        assert box is not None  # a window holds the lowest separation at least
        if capabilities(self.operator).submatrix and self._is_short(window[box]):
            return np.flatnonzero(window)
        return self._kept(box)

    def _kept(self, box: Box) -> Box:
        """Return a box with some room: the last as long as it holds this one and is not much larger, or a new one."""
        shape = self.operator.grid.shape
        roomy = tuple(_roomy(part, n) for part, n in zip(box, shape, strict=True))
        # What the last box takes is at hand: its kernel, or its nodes.
        if self._box is not None and _holds(self._box[0], box) and _size(self._box[0]) < 1.3 * _size(roomy):
            return self._box[0]
        return roomy

    def _is_short(self, window: Mask) -> bool:
        """Whether a list of the cells of a window costs less than its box."""
        count, padded = int(np.count_nonzero(window)), 2**window.ndim * window.size
        if count * count / 4 < LOOKUPS * padded:
            return True
        if count > FILLED * window.size or capabilities(self.operator).particle_mesh() is None:
            return False
        # Tiles drive, products go by the box if need be, and all else follows the list.
        if window.size > LARGE:
            return True
        # Tile by tile; there is one at least for each SIDE^2 cells.
        few = count / SIDE**2 * count / 4 < padded
        return few and bool(len(Tiles.of(window)) * count / 4 < padded)


def _carrying(measure: Measure, separation: Array, terms: Terms) -> Mask:
    """Return the lowest cells that could carry twice the force under the hardness: a window needs as many."""
    if terms.hardness == math.inf or terms.depth is not None:
        return np.zeros(separation.shape, dtype=bool)
    order = np.argsort(separation, axis=None, kind="stable")
    area = np.cumsum(measure.on(order))
    count = int(np.searchsorted(area, 2 * terms.control.value / terms.hardness)) + 1
    carrying = np.zeros(separation.size, dtype=bool)
    carrying[order[:count]] = True
    return (carrying & np.isfinite(separation).ravel()).reshape(separation.shape)


def _holds(a: Box, b: Box) -> bool:
    return all(s.start <= t.start and t.stop <= s.stop for s, t in zip(a, b, strict=True))


def _size(box: Box) -> int:
    return math.prod(s.stop - s.start for s in box)


def _roomy(part: slice, end: int) -> slice:
    """Return a side of a box with a little room, so that an overlap that grows somewhat is still inside."""
    room = max(1, (part.stop - part.start) // 32)
    return slice(max(0, part.start - room), min(end, part.stop + room))
