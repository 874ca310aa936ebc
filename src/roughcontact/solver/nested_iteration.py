"""Coarse to fine: a first guess of the pressure from the same problem on larger cells."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import is_numpy, namespace
from roughcontact.grid import Grid
from roughcontact.halfspace.operators.operator import Operator, capabilities, is_semidefinite
from roughcontact.solver.control import Control, Depth, Terms
from roughcontact.solver.projection import elastic_control
from roughcontact.solver.restriction import raised
from roughcontact.solver.state import Solver
from roughcontact.solver.subdomain import Windows, bounding_box, embed

__all__ = ["coarse_guess", "coarse_operator"]

Array = npt.NDArray[np.float64]

COARSEST = 64  # cells along the longer side at which a problem is solved from nothing
SMALL = 512  # cells along it up to which a level more costs more than the steps that it saves (tried by hand)
COARSE_TOLERANCE = 1e-3  # no coarser answer deserves more: its grid is further from the fine one than that


def coarse_guess(
    operator: Operator, separation: Array, control: Control, solver: Solver
) -> tuple[Array, float]:
    """Return a pressure [Pa] and a depth [m] to start from, found on larger cells, recursively.

    Without coarser cells the guess is no pressure.
    """
    coarser = coarse_operator(operator, separation.shape)
    if coarser is None:
        return namespace(separation).zeros_like(separation), 0.0
    part, factors = coarser
    control = elastic_control(operator, separation, control)
    heights = raised(separation, factors)
    if isinstance(control, Depth) and is_semidefinite(part):
        control = _reachable(control, separation, heights)
    guess = coarse_guess(part, heights, control, solver)
    state, place = Windows(part).solve(solver, heights, Terms(control, COARSE_TOLERANCE), guess)
    return _spread(embed(state.pressure, place, heights.shape), factors, separation), state.depth


def _spread(coarse: Array, factors: tuple[int, ...], separation: Array) -> Array:
    """Return the pressure on the cells of which blocks have another, zero where a cell is missing."""
    xp = namespace(separation)
    # Only where there is some, which elsewhere than on the host would cost a look: planes are large.
    some = bounding_box(coarse > 0) if is_numpy(coarse) else None
    box = tuple(slice(0, n) for n in coarse.shape) if some is None else some
    fine, there = coarse[box], []
    for axis, (part, factor, n) in enumerate(zip(box, factors, separation.shape, strict=True)):
        fine = xp.repeat(fine, factor, axis=axis)
        there.append(slice(part.start * factor, min(part.stop * factor, n)))
    place = tuple(there)
    fine = fine[tuple(slice(0, part.stop - part.start) for part in place)]
    return embed(xp.where(xp.isfinite(separation[place]), fine, 0.0), place, tuple(separation.shape))


def coarse_operator(operator: Operator, shape: tuple[int, ...]) -> tuple[Operator, tuple[int, ...]] | None:
    """Return the operator on larger cells and the factor of each axis, 1, 2 or 4; None if that ends here."""
    grid = operator.grid
    if max(shape) <= COARSEST or not isinstance(grid, Grid):
        return None
    most = 4 if max(shape) <= SMALL else 2
    factors = tuple(most if n >= most * COARSEST else 2 if n > COARSEST // 2 else 1 for n in shape)
    coarse_shape = tuple(-(-n // f) for n, f in zip(shape, factors, strict=True))
    coarse = capabilities(operator).coarsened(_coarse_grid(grid, coarse_shape, factors))
    return None if coarse is None else (coarse, factors)


def _reachable(depth: Depth, fine: Array, coarse: Array) -> Depth:
    """Return a depth as far from full contact on the coarse cells as on the fine ones.

    Otherwise the coarse problem might have no solution: its highest cells stand higher above its mean.
    """
    xp = namespace(fine)
    if bool(xp.any(xp.isinf(fine))) or not bool(xp.any(fine != 0)):
        return depth
    return Depth(depth.value * min(1.0, float(xp.mean(coarse) / xp.mean(fine))))


def _coarse_grid(grid: Grid, shape: tuple[int, ...], factors: tuple[int, ...]) -> Grid:
    """Return the grid of the blocks; a periodic one keeps its period, a free one its cells."""
    spacing = [
        length / n if periodic else f * step
        for length, n, periodic, f, step in zip(
            grid.lengths, shape, grid.periodic, factors, grid.spacing, strict=True
        )
    ]
    return Grid(shape, spacing, grid.periodic)
