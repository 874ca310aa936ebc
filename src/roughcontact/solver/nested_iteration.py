"""Nested iteration: the first pressure from the same problem on larger cells, recursively."""

from __future__ import annotations

from functools import reduce
from typing import Any

import numpy as np

from roughcontact.arrays import namespace
from roughcontact.grid import Grid
from roughcontact.halfspace.operators.operator import Operator, capabilities, is_semidefinite
from roughcontact.slabs.levels_of_slabs import divides, gathered_if_small, scatter_like
from roughcontact.slabs.passes import passes_over
from roughcontact.solver import tuning
from roughcontact.solver.control import Control, Depth, Solver, Specification, Start
from roughcontact.solver.projection import elastic_control
from roughcontact.solver.subdomain import SubdomainSolver, bounding_box, prolong
from roughcontact.solver.summit_start import summit_start
from roughcontact.validation import Array

__all__ = ["block_minimum", "block_separation", "coarse_operator", "coarse_operator_on", "nested_start"]


def nested_start(
    operator: Operator, separation: Array, control: Control, solver: Solver
) -> tuple[Array, float]:
    """Return a pressure [Pa] and a depth [m] to start from, found on larger cells, recursively.

    On the coarsest cells only the summits are pressed, and only of planes on the host.
    """
    coarser, xp = coarse_operator(operator, separation.shape), namespace(separation)
    plane = xp is np and separation.ndim == 2 and max(separation.shape) <= tuning.COARSEST
    if (coarser is None and not plane) or (coarser and not divides(separation, coarser[1])):
        return xp.zeros_like(separation), 0.0
    control = elastic_control(operator, separation, control, xp)
    if coarser is None:
        return summit_start(operator, separation, control)
    part, factors = coarser
    blocks = block_separation(separation, factors)
    if isinstance(control, Depth) and is_semidefinite(part):
        control = elastic_control(part, blocks, _reachable(control, separation, blocks, xp), xp)
    small = gathered_if_small(blocks)
    start = Start(*nested_start(part, small, control, solver))
    spec = Specification(control, tuning.COARSE_TOLERANCE)
    state, subdomain = SubdomainSolver(part).solve(solver, small, spec, start)
    coarse = scatter_like(prolong(state.pressure, subdomain, blocks.shape), blocks)
    return _interpolated(coarse, factors, separation, xp), state.depth


def _interpolated(coarse: Array, factors: tuple[int, ...], separation: Array, xp: Any) -> Array:
    """Return the pressure of blocks on their cells, constant in each, zero where a cell is missing."""
    # Only where there is some; elsewhere than on the host a box costs a transfer. Planes are large.
    some = bounding_box(coarse > 0) if xp is np else None
    blocks = tuple(slice(0, n) for n in coarse.shape) if some is None else some
    fine, there = coarse[blocks], []
    for axis, (part, factor, n) in enumerate(zip(blocks, factors, separation.shape, strict=True)):
        fine = xp.repeat(fine, factor, axis=axis)
        there.append(slice(part.start * factor, min(part.stop * factor, n)))
    box = tuple(there)
    fine = fine[tuple(slice(0, part.stop - part.start) for part in box)]
    return prolong(xp.where(xp.isfinite(separation[box]), fine, 0.0), box, tuple(separation.shape))


def coarse_operator(operator: Operator, shape: tuple[int, ...]) -> tuple[Operator, tuple[int, ...]] | None:
    """Return the operator on larger cells and the factor of each axis, 1, 2 or 4; None on the coarsest."""
    grid = operator.grid
    if max(shape) <= tuning.COARSEST or not isinstance(grid, Grid):
        return None
    most = 4 if max(shape) <= tuning.FACTOR_FOUR else 2
    factors = tuple(
        most if n >= most * tuning.COARSEST else 2 if n > tuning.COARSEST // 2 else 1 for n in shape
    )
    coarse = coarse_operator_on(operator, shape, factors)
    return None if coarse is None else (coarse, factors)


def coarse_operator_on(
    operator: Operator, shape: tuple[int, ...], factors: tuple[int, ...]
) -> Operator | None:
    """Return the operator on blocks of given numbers of cells along each axis; None where it has none."""
    grid = operator.grid
    if not isinstance(grid, Grid):
        return None
    coarse_shape = tuple(-(-n // f) for n, f in zip(shape, factors, strict=True))
    return capabilities(operator).coarsened(_coarse_grid(grid, coarse_shape, factors))


def _reachable(depth: Depth, fine: Array, coarse: Array, xp: Any) -> Depth:
    """Return a depth as far from full contact on the coarse cells as on the fine ones.

    Otherwise the coarse problem might have no solution: its highest cells stand higher above its mean.
    """
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


def block_separation(separation: Array, factors: tuple[int, ...]) -> Array:
    """Return a separation for each block of cells, from which the contact of the cells is best predicted.

    Where long waves carry the contact that is the mean, whatever the slope. Where the cells of a block are rough their
    summits touch, and the block is raised above the plane through them by twice as far as they stand out of
    it, never above its highest cell. Half as much misleads on surfaces without long waves, H < 0; the highest cell
    itself costs smooth ones up to twice the steps (`benchmarks/ideas.py`).

    Parameters
    ----------
    separation : array
        Of cells [m], infinite where one is missing.
    factors : tuple of int
        Cells of a block along each axis, 1, 2 or 4: blocks of four are blocks of blocks. Only whole blocks of two by
        two distinguish slope from roughness; of others it is the lowest separation.
    """
    for _ in range(max(factors).bit_length() - 1):
        halves = tuple(min(f, 2) for f in factors)
        separation = _raised_blocks(separation, halves)
        factors = tuple(f // half for f, half in zip(factors, halves, strict=True))
    return separation


def _raised_blocks(separation: Array, factors: tuple[int, ...]) -> Array:
    passes = passes_over(separation) if factors == (2, 2) else None
    raised = None if passes is None else passes.raise_blocks(separation, tuning.SUMMITS)
    if raised is not None:
        return raised
    low = block_minimum(separation, factors)
    if factors != (2, 2):
        return low
    xp, (ny, nx) = namespace(separation), (n // 2 * 2 for n in separation.shape)
    for start in range(0, ny, tuning.SLAB):  # planes are large, and fresh memory is slow
        upper, lower = (separation[start + k : min(start + tuning.SLAB, ny) : 2, :nx] for k in (0, 1))
        with np.errstate(invalid="ignore"):  # missing cells
            both, apart = upper + lower, upper - lower
            out_of_it = xp.abs(apart[:, ::2] - apart[:, 1::2])
            block = (both[:, ::2] + both[:, 1::2] - tuning.SUMMITS * out_of_it) / 4
        whole = low[start // 2 : start // 2 + block.shape[0], : nx // 2]
        whole[...] = xp.where(block > whole, block, whole)
    return low


def block_minimum(separation: Array, factors: tuple[int, ...]) -> Array:
    """Return the lowest value of each block; infinite for a block of missing cells."""
    xp, padded = namespace(separation), separation
    for axis, factor in enumerate(factors):
        missing = [n if a != axis else -n % factor for a, n in enumerate(padded.shape)]
        if missing[axis]:
            edge = xp.full(tuple(missing), np.inf, dtype=padded.dtype, device=padded.device)
            padded = xp.concat([padded, edge], axis=axis)
    for axis, factor in enumerate(factors):
        # Slices, not an axis of blocks: a reduction along two numbers takes several times as long.
        parts = [padded[(slice(None),) * axis + (slice(k, None, factor), ...)] for k in range(factor)]
        padded = reduce(xp.minimum, parts)
    return padded
