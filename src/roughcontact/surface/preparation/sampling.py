"""Fewer points: a part of a surface, a subsample, means over pixels."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.surface.in_memory import on_host_only
from roughcontact.surface.preparation.filters import gaussian_mean
from roughcontact.surface.surface import Surface
from roughcontact.validation import number

__all__ = ["averaged", "cell_ranges", "cropped", "downsampled", "range_words"]


@on_host_only
def cropped(surface: Surface, *parts: slice) -> Surface:
    """Return the part of the surface in `parts`.

    A periodic axis that is cut becomes free, which the provenance names; an axis that is kept whole is unchanged.

    Parameters
    ----------
    surface : Surface
    *parts : slice
        Ranges of cells, one slice of step 1 for each axis: rows, then columns.

    Returns
    -------
    Surface
        The cells in `parts`.

    Raises
    ------
    ValueError
        If there is not one slice for each axis, a slice has a step, ends beyond the map, is empty, or holds no
        measured point.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> ball.cropped(slice(16, 48), slice(0, 32)).grid.lengths
    (3.2e-05, 3.2e-05)
    """
    grid = surface.grid
    ranges = cell_ranges(grid, parts, "a crop")
    whole = [stop - start == n for (start, stop), n in zip(ranges, grid.shape, strict=True)]
    small = Grid(
        [stop - start for start, stop in ranges],
        grid.spacing,
        [kept and repeats for kept, repeats in zip(whole, grid.periodic, strict=True)],
    )
    line = f"cropped to cells {range_words(ranges)} of {' x '.join(map(str, grid.shape))}"
    axes = zip("yx"[-grid.ndim :], grid.periodic, small.periodic, strict=True)
    if cut := " and ".join(axis for axis, before, after in axes if before and not after):
        line += f", no longer periodic along {cut}"
    return surface.with_heights(surface.heights[parts], line, small)


@on_host_only
def downsampled(surface: Surface, factor: int | tuple[int, ...], anti_alias: bool = True) -> Surface:
    """Return a subsample of the surface: every `factor`-th point along each axis.

    Parameters
    ----------
    surface : Surface
    factor : int or tuple of int
        One number for all axes, or one for each axis (y, x).
    anti_alias : bool
        Filter first: the Gaussian filter with the shortest wave of the new grid, two new cells, as its cut-off.
        Without it, shorter waves are aliased to spurious long ones.

    Returns
    -------
    Surface
        On a grid of fewer and larger cells.

    Raises
    ------
    ValueError
        If a factor is not a whole number from 1 to half the cells, or does not divide a periodic axis.

    Notes
    -----
    The points are the middle ones of blocks of `factor` cells (for an even factor the one before the middle: half
    an old cell to the upper left). Cells at the end that fill no block are left out.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> rough = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> rough.downsampled(2).grid.shape, f"{rough.downsampled(2).rms / rough.rms:.3f}"
    ((32, 32), '0.986')
    """
    grid = surface.grid
    factors = _factors(grid, factor)
    heights = surface.heights
    if anti_alias:
        cutoffs = tuple(
            2 * thin * step if thin > 1 else None for thin, step in zip(factors, grid.spacing, strict=True)
        )
        heights = gaussian_mean(heights, grid.spacing, grid.periodic, cutoffs)
    chosen = heights[
        tuple(
            slice((thin - 1) // 2, (n // thin) * thin, thin)
            for thin, n in zip(factors, grid.shape, strict=True)
        )
    ]
    how = "after a Gaussian filter" if anti_alias else "without a filter"
    line = f"downsampled by {' x '.join(map(str, factors))} {how}{_left_out(grid, factors)}"
    return surface.with_heights(chosen, line, _coarse(grid, factors))


@on_host_only
def averaged(surface: Surface, factor: int | tuple[int, ...]) -> Surface:
    """Return the surface as recorded by pixels of `factor` cells a side: the mean over each block.

    Parameters
    ----------
    surface : Surface
    factor : int or tuple of int
        Cells per pixel for all axes, or one number for each axis (y, x).

    Returns
    -------
    Surface
        On a grid of fewer and larger cells. A block of which less than half was measured is missing.

    Raises
    ------
    ValueError
        As for `downsampled`.

    Notes
    -----
    A wave of length l along an axis is transmitted by sin(pi k d/l) / (k sin(pi d/l)) with k cells of size d a
    pixel: for waves much longer than a cell the sinc of the pixel. Cells at the end that fill no block are left out.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> ball.averaged(4).grid
    Grid(shape=(16, 16), spacing=(4e-06, 4e-06), periodic=(False, False))
    """
    grid = surface.grid
    factors = _factors(grid, factor)
    coarse = _coarse(grid, factors)
    used = surface.heights[tuple(slice(n * k) for n, k in zip(coarse.shape, factors, strict=True))]
    blocks = used.reshape([size for pair in zip(coarse.shape, factors, strict=True) for size in pair])
    inner = tuple(range(1, 2 * grid.ndim, 2))
    measured = ~np.isnan(blocks)
    count = measured.sum(axis=inner)
    total = np.where(measured, blocks, 0.0).sum(axis=inner)
    enough = 2 * count >= np.prod(factors)
    heights = np.divide(total, count, out=np.full(coarse.shape, np.nan), where=enough)
    line = f"averaged over pixels of {' x '.join(map(str, factors))} cells{_left_out(grid, factors)}"
    return surface.with_heights(heights, line, coarse)


def _factors(grid: Grid, factor: int | tuple[int, ...]) -> tuple[int, ...]:
    given = number(factor, "factor")
    factors = np.broadcast_to(given, grid.ndim).tolist() if given.shape in ((), (grid.ndim,)) else []
    if not factors or any(k % 1 != 0 or k < 1 for k in factors):
        raise about("factor", f"must be one whole number from 1 up, or {grid.ndim}, not {factor}")
    for k, n, repeats in zip(factors, grid.shape, grid.periodic, strict=True):
        if 2 * k > n:
            raise InputError(
                f"a factor of {k:g} leaves less than two of {n} cells",
                f"give at most {n // 2}",
                place="factor",
            )
        if repeats and n % k:
            raise InputError(
                f"a factor of {k:g} does not divide {n} cells of a periodic axis",
                f"give a divisor of {n}, or crop the surface, which frees it",
                place="factor",
            )
    return tuple(int(k) for k in factors)


def _left_out(grid: Grid, factors: tuple[int, ...]) -> str:
    """Return the cells at the end that fill no block, as the end of a line of the history."""
    names = ("rows", "columns") if grid.ndim == 2 else ("cells",)
    over = [n % k for n, k in zip(grid.shape, factors, strict=True)]
    parts = [
        f"{count} of {n} {name}" for count, n, name in zip(over, grid.shape, names, strict=True) if count
    ]
    return f"; the last {' and '.join(parts)} are left out" if parts else ""


def _coarse(grid: Grid, factors: tuple[int, ...]) -> Grid:
    shape = [n // k for n, k in zip(grid.shape, factors, strict=True)]
    return Grid(shape, [step * k for step, k in zip(grid.spacing, factors, strict=True)], grid.periodic)


def cell_ranges(grid: Grid, parts: Sequence[slice], what: str) -> list[tuple[int, int]]:
    """Return the first cell and the one after the last of slices, one for each axis.

    Raises
    ------
    ValueError
        If there is not one for each axis, one has a step, ends beyond the grid, or holds no cell; the message begins
        with `what`.
    """
    if len(parts) != grid.ndim:
        raise about(
            what,
            f"needs one slice an axis, {grid.ndim} in all, not {len(parts)}",
            f"give {'rows and columns' if grid.ndim == 2 else 'one range of cells'}",
        )
    if any(part.step not in (None, 1) for part in parts):
        raise about(what, "has no step", "use downsampled for a subsample")
    for part, n in zip(parts, grid.shape, strict=True):
        if any(end is not None and not -n <= end <= n for end in (part.start, part.stop)):
            words = f"{'' if part.start is None else part.start}:{'' if part.stop is None else part.stop}"
            raise about(
                what,
                f"of cells {words} ends beyond the {n} cells of the map",
                f"end at {n} at most; an open end, such as 0:, is that of the map",
            )
    ranges = [part.indices(n)[:2] for part, n in zip(parts, grid.shape, strict=True)]
    if any(stop <= start for start, stop in ranges):
        raise InputError(f"no cell is left of {grid.shape} cells in {range_words(ranges)}")
    return ranges


def range_words(ranges: list[tuple[int, int]]) -> str:
    """Return ranges of cells as they are written: 0:512, 100:612."""
    return ", ".join(f"{start}:{stop}" for start, stop in ranges)
