"""Restriction to the overlap: contact lies where the undeformed bodies overlap, so nothing outside is computed.

docs/concepts/method.md, "Subdomain", proves it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.halfspace.operators.operator import Capabilities, Operator, capabilities
from roughcontact.halfspace.sums.tiles import SIDE, Tiles
from roughcontact.solver import tuning
from roughcontact.solver.complementarity import resolve_contact
from roughcontact.solver.control import Solver, Specification, Start, State
from roughcontact.solver.inner_product import Measure
from roughcontact.validation import Array, Mask

__all__ = ["Box", "Subdomain", "SubdomainSolver", "bounding_box", "prolong", "restrict", "restrict_hardness"]

Box = tuple[slice, ...]
Subdomain = Box | npt.NDArray[np.intp]
"""Some cells of a grid: a box, or a list of flat indices."""


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


def restrict(field: Any, subdomain: Subdomain) -> Any:
    """Return a field on a subdomain."""
    return field[subdomain] if isinstance(subdomain, tuple) else field.ravel()[subdomain]


def prolong(part: Array, subdomain: Subdomain, shape: tuple[int, ...]) -> Array:
    """Return a field of a subdomain on the whole grid, zero elsewhere."""
    if tuple(part.shape) == shape:
        return part
    whole = np.zeros(shape)
    if isinstance(subdomain, tuple):
        whole[subdomain] = part
    else:
        whole.ravel()[subdomain] = part
    return whole


@dataclass(slots=True)
class SubdomainSolver:
    """Solves on the overlap of a problem; keeps the last restricted operator for the next load.

    If no pressure lifts any cell, the displacement is nowhere negative and the gap outside the overlap
    ``separation < depth`` is positive whatever the pressure: contact lies in the overlap. A solve on a part
    of the cells overestimates the depth at a given force, so the overlap found from it is safe, and the
    answer on a subdomain that contains its own overlap is the answer on the whole grid.
    """

    operator: Operator
    _box: tuple[Box, Operator] | None = field(default=None)
    _list: tuple[npt.NDArray[np.intp], Operator] | None = field(default=None)
    _can: Capabilities = field(init=False)

    def __post_init__(self) -> None:
        self._can = capabilities(self.operator)

    def solve(
        self,
        solver: Solver,
        separation: Array,
        spec: Specification,
        start: Start,
    ) -> tuple[State, Subdomain]:
        """Solve from a pressure on the whole grid and a depth; return the state and its subdomain."""
        if not (self._can.positive and isinstance(separation, np.ndarray)):
            # Elsewhere than on the host a box costs a transfer for each of its sides.
            whole = tuple(slice(0, n) for n in separation.shape)
            return resolve_contact(solver, self.operator, separation, spec, start), whole
        candidates = (separation < start.depth) | (start.pressure > 0)
        if not candidates.any():
            candidates = separation == separation.min()
        if spec.plastic and spec.depth is None:
            candidates |= _bearing_cells(Measure(self.operator.weights), separation, spec)
        steps = 0
        while True:
            subdomain = self._subdomain(candidates)
            part = self.operator_on(subdomain)
            limits = replace(spec, hardness=restrict_hardness(spec.hardness, subdomain))
            inside = Start(restrict(start.move(), subdomain), start.depth)
            # Machine code takes fields whose numbers lie one after the other.
            below = np.ascontiguousarray(restrict(separation, subdomain))
            state = resolve_contact(solver, part, below, limits, inside)
            steps += state.steps
            overlap = separation < state.depth
            if np.count_nonzero(overlap) == np.count_nonzero(restrict(overlap, subdomain)):
                return replace(state, steps=steps), subdomain
            start = Start(prolong(state.pressure, subdomain, separation.shape), state.depth)
            candidates |= overlap

    @property
    def box(self) -> Box | None:
        """The box whose restricted operator is kept."""
        return self._box and self._box[0]

    def operator_on(self, subdomain: Subdomain) -> Operator:
        """Return the operator between the cells of a subdomain."""
        if not isinstance(subdomain, tuple):
            if self._list is None or self._list[0] is not subdomain:
                self._list = (subdomain, self._between(subdomain))
            return self._list[1]
        if _size(subdomain) == self.operator.grid.size:
            return self.operator
        if self._box is None or self._box[0] != subdomain:
            self._box = (subdomain, self.operator.restrict(subdomain))
        return self._box[1]

    def _between(self, cells: npt.NDArray[np.intp]) -> Operator:
        """Return the operator between the cells of a list, as part of the box that holds them, which is kept."""
        submatrix = self._can.submatrix
        assert submatrix is not None  # no list is made of others
        shape = self.operator.grid.shape
        if len(shape) == 1 or math.prod(shape) <= tuning.SMALL_GRID:
            return submatrix(cells)
        indices = np.unravel_index(cells, shape)
        box = self._with_margin(tuple(slice(int(i.min()), int(i.max()) + 1) for i in indices))
        part = self.operator_on(box)
        part_submatrix = capabilities(part).submatrix
        if part_submatrix is None:
            return submatrix(cells)
        inside = tuple(i - s.start for i, s in zip(indices, box, strict=True))
        return part_submatrix(np.ravel_multi_index(inside, part.grid.shape))

    def _subdomain(self, candidates: Mask) -> Subdomain:
        """Return the box of the candidates for contact, or their list where a direct sum costs less."""
        box = bounding_box(candidates)
        assert box is not None  # the lowest separation at least is one
        if self._can.submatrix and self._is_list_cheaper(candidates[box]):
            return np.flatnonzero(candidates)
        return self._with_margin(box)

    def _with_margin(self, box: Box) -> Box:
        """Return a box with a margin: the last as long as it holds this one and is not much larger, or a new one."""
        shape = self.operator.grid.shape
        new = tuple(_widened(part, n) for part, n in zip(box, shape, strict=True))
        last = self.box
        return last if last and _holds(last, box) and _size(last) < tuning.KEPT_BOX * _size(new) else new

    def _is_list_cheaper(self, candidates: Mask) -> bool:
        """Whether products between the candidates of a box cost less than those in the box."""
        count, padded = int(np.count_nonzero(candidates)), 2**candidates.ndim * candidates.size
        if count * count / 4 < tuning.LOOKUPS * padded:
            return True
        few = count <= tuning.LIST_FILLING * candidates.size
        if not few or self._can.particle_mesh() is None:
            return False
        # Inner products are taken on tiles, exact ones on the box if need be, and all else follows the list.
        if candidates.size > tuning.LARGE_BOX:
            return True
        # Tile by tile; there is one at least for each SIDE^2 cells.
        few = count / SIDE**2 * count / 4 < padded
        return few and bool(len(Tiles.of(candidates)) * count / 4 < padded)


def restrict_hardness(hardness: float | Array, subdomain: Subdomain) -> float | Array:
    """Return the hardness [Pa] on a subdomain: one number, or one for each of its cells."""
    return hardness if isinstance(hardness, int | float) else restrict(hardness, subdomain)


def _bearing_cells(measure: Measure, separation: Array, spec: Specification) -> Mask:
    """Return the lowest cells that could carry twice the force under the hardness: a subdomain needs as many."""
    order = np.argsort(separation, axis=None, kind="stable")
    area = measure.on(order)
    if not isinstance(spec.hardness, int | float):  # softer cells bear as smaller ones would
        area = area * (spec.hardness.ravel()[order] / spec.largest_hardness)
    count = int(np.searchsorted(np.cumsum(area), 2 * spec.control.value / spec.largest_hardness)) + 1
    bearing = np.zeros(separation.size, dtype=bool)
    bearing[order[:count]] = True
    return (bearing & np.isfinite(separation).ravel()).reshape(separation.shape)


def _holds(a: Box, b: Box) -> bool:
    return all(s.start <= t.start and t.stop <= s.stop for s, t in zip(a, b, strict=True))


def _size(box: Box) -> int:
    return math.prod(s.stop - s.start for s in box)


def _widened(part: slice, end: int) -> slice:
    """Return a side of a box with a small margin, so that an overlap that grows somewhat is still inside."""
    margin = max(1, (part.stop - part.start) // 32)
    return slice(max(0, part.start - margin), min(end, part.stop + margin))
