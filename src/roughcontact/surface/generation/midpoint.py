"""Fractal lines and surfaces by random midpoint displacement (thesis, section 2.3.1)."""

from __future__ import annotations

import math
from typing import Literal, TypeAlias

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.progress.events import tracked
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, RngLike, as_generator, numeric

__all__ = ["midpoint_line", "midpoint_surface"]

Distribution: TypeAlias = Literal["uniform", "gaussian"]


@numeric(displacement="m", rms="m")
def midpoint_line(
    grid: Grid,
    hurst: float,
    rng: RngLike,
    *,
    displacement: float | None = None,
    rms: float | None = None,
    distribution: Distribution = "uniform",
) -> Surface:
    """Return a fractal line by random midpoint displacement (thesis, section 2.3.1 and fig. 4).

    It starts with a straight line between two ends at height 0. The middle of every segment is moved by up to the
    displacement, which shrinks by the factor 2^-H from each level to the next.

    Parameters
    ----------
    grid : Grid
        Free grid of 2^n + 1 nodes, shape ``(2**n + 1,)``.
    hurst : float
        Hurst exponent H, from 0 to 1.
    rng : int, numpy.random.Generator, SeedSequence, BitGenerator or None
        Source of the displacements, drawn level by level: the same state or seed on a finer grid gives a finer
        version of the same line.
    displacement : float
        Largest displacement of the first level [m].
    rms : float
        Instead of `displacement`: the rms height of this sample about its mean [m], set afterwards.
    distribution : {"uniform", "gaussian"}
        Displacements between the limits, or normal ones of the same variance, displacement^2/3.

    Returns
    -------
    Surface
        Heights of shape ``(2**n + 1,)`` [m], 0 at both ends.

    Raises
    ------
    ValueError
        If the grid is periodic or has another number of nodes or axes, a parameter is out of range, or `rng` is
        no seed.

    Notes
    -----
    The displacements follow the power law exactly, but the increments of the line are not stationary:
    second differences over all positions, from a lag of 8 to one of 16 cells in 512, grow with the exponents 0.26,
    0.50 and 0.79 for H = 0.2, 0.5 and 0.8. The largest features depend on the first few random numbers, so samples
    scatter widely. Use `self_affine` for an exact spectrum.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> line = rc.midpoint_line(rc.Grid(129, 1e-6), hurst=0.8, rng=np.random.default_rng(1), rms=1e-6)
    >>> f"{line.rms:.3g} m, ends at {line.heights[0]:.0f} and {line.heights[-1]:.0f} m"
    '1e-06 m, ends at 0 and 0 m'
    """
    levels = _levels(grid, 1)
    first, generator = _first(hurst, displacement, rms, distribution), as_generator(rng)
    heights = np.zeros(grid.shape)
    for level in range(levels):
        step = 2 ** (levels - level)
        middle = _draw(generator, (2**level,), first * 2 ** (-hurst * level), distribution)
        heights[step // 2 :: step] = (heights[:-1:step] + heights[step::step]) / 2 + middle
    return _finished(heights, grid, rms, f"random midpoint line, H = {hurst:g}, {distribution}")


@numeric(displacement="m", rms="m")
def midpoint_surface(
    grid: Grid,
    hurst: float,
    rng: RngLike,
    *,
    displacement: float | None = None,
    rms: float | None = None,
    distribution: Distribution = "uniform",
    half_steps: Literal["same", "saupe"] = "same",
    borders: Literal["three", "wrap"] = "three",
) -> Surface:
    """Return a fractal surface by random midpoint displacement (thesis, section 2.3.1 and fig. 5).

    The centre of every square becomes the mean of its four corners, then the middle of every edge the mean of
    its four neighbours, each plus a displacement that shrinks by the factor 2^-H from each level to the next.

    Parameters
    ----------
    grid : Grid
        Free grid of 2^n + 1 nodes and the same spacing along both axes.
    hurst : float
        Hurst exponent H, from 0 to 1.
    rng : int, numpy.random.Generator, SeedSequence, BitGenerator or None
        Source of the displacements, drawn level by level: the same state or seed on a finer grid gives a finer
        version of the same surface.
    displacement : float
        Largest displacement of the first centre [m].
    rms : float
        Instead of `displacement`: the rms height of this sample about its mean [m], set afterwards.
    distribution : {"uniform", "gaussian"}
        Displacements between the limits, or normal ones of the same variance, displacement^2/3.
    half_steps : {"same", "saupe"}
        Displacement of the middles of edges: that of the centres of the same level (the thesis), or smaller by
        2^(-H/2), because their neighbours are nearer by 2^(-1/2) (Saupe, in Peitgen and Saupe, The Science of Fractal
        Images, 1988, ch. 2).
    borders : {"three", "wrap"}
        An edge on the border has three neighbours: use their mean, or use a fourth from the other side. With "wrap"
        the surface is periodic, and its last row and column equal the first.

    Returns
    -------
    Surface
        Heights of shape ``(2**n + 1, 2**n + 1)`` [m], 0 at the corners.

    Raises
    ------
    ValueError
        If the grid is periodic or has another number of nodes or axes, a parameter is out of range, or `rng` is
        no seed.

    Notes
    -----
    The displacements follow the power law exactly, but the surface is not stationary, and it has creases along the
    grid: over all positions second differences along it grow with smaller exponents at the shortest lags, about 0.53
    (0.56 with "saupe") from a lag of 1 to one of 2 cells at H = 0.8, and 0.75 from 8 to 16. Use `self_affine` for an
    exact spectrum.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.midpoint_surface(rc.Grid((65, 65), 1e-6), hurst=0.8, rng=np.random.default_rng(1), rms=1e-6)
    >>> f"{surface.rms:.3g} m"
    '1e-06 m'
    """
    levels = _levels(grid, 2)
    first, generator = _first(hurst, displacement, rms, distribution), as_generator(rng)
    if half_steps not in ("same", "saupe"):
        raise about("half_steps", f"must be 'same' or 'saupe', not {half_steps!r}")
    if borders not in ("three", "wrap"):
        raise about("borders", f"must be 'three' or 'wrap', not {borders!r}")
    heights, wrap = np.zeros(grid.shape), borders == "wrap"
    for level in tracked(range(levels), "Displacing midpoints", "levels"):
        step, m = 2 ** (levels - level), 2**level
        half, limit = step // 2, first * 2 ** (-hurst * level)
        corners = heights[::step, ::step]
        pairs = corners[:, :-1] + corners[:, 1:]
        centres = (pairs[:-1] + pairs[1:]) / 4 + _draw(generator, (m, m), limit, distribution)
        heights[half::step, half::step] = centres
        if half_steps == "saupe":
            limit *= 2 ** (-hurst / 2)
        flat = _edges(pairs, centres, _draw(generator, (m + 1, m), limit, distribution), wrap)
        heights[::step, half::step] = flat
        pairs = (corners[:-1] + corners[1:]).T
        upright = _edges(pairs, centres.T, _draw(generator, (m + 1, m), limit, distribution), wrap)
        heights[half::step, ::step] = upright.T
    return _finished(
        heights,
        grid,
        rms,
        f"random midpoint surface, H = {hurst:g}, {distribution}, half steps {half_steps}, borders {borders}",
    )


def _edges(pairs: Array, centres: Array, moved: Array, wrap: bool) -> Array:
    """Return the middles of the edges along x: `pairs` sums their ends, `centres` lie above and below them."""
    total, members = pairs.copy(), np.full((len(pairs), 1), 4)
    total[1:] += centres
    total[:-1] += centres
    if wrap:
        total[0] += centres[-1]
        total[-1] += centres[0]
    else:
        members[[0, -1]] = 3
    edges = np.asarray(total / members + moved)
    if wrap:
        edges[-1] = edges[0]
    return edges


def _draw(
    rng: np.random.Generator, shape: tuple[int, ...], limit: float, distribution: Distribution
) -> Array:
    if distribution == "uniform":
        return rng.uniform(-limit, limit, shape)
    return np.asarray(limit / math.sqrt(3) * rng.standard_normal(shape))


def _levels(grid: Grid, ndim: int) -> int:
    """Return n for a free grid of 2^n + 1 nodes an axis."""
    levels = max(1, round(math.log2(max(2, grid.shape[0] - 1))))
    if grid.shape != (2**levels + 1,) * ndim:
        what = "a line of (2^n + 1,)" if ndim == 1 else "a square of (2^n + 1, 2^n + 1)"
        raise InputError(f"midpoints need {what} nodes, for example {2**levels + 1}, not {grid.shape}")
    if any(grid.periodic):
        raise InputError(
            "a midpoint grid ends at its nodes and cannot be periodic", "use Grid(..., periodic=False)"
        )
    if max(grid.spacing) > min(grid.spacing) * (1 + 1e-9):
        raise InputError(f"midpoints need the same spacing along both axes, not {grid.spacing}")
    return levels


def _first(
    hurst: float,
    displacement: float | None,
    rms: float | None,
    distribution: str,
) -> float:
    """Return the largest first displacement [m], which is arbitrary if the rms height is set afterwards."""
    if not 0 <= hurst <= 1:
        raise about(
            "hurst", f"must lie between 0 and 1 for midpoints, not {hurst}: self_affine takes -1 to 3"
        )
    if distribution not in ("uniform", "gaussian"):
        raise about("distribution", f"must be 'uniform' or 'gaussian', not {distribution!r}")
    if (displacement is None) == (rms is None):
        raise InputError(
            "the scale of the heights must be given exactly once",
            "give either displacement (of the first level) or rms [m]",
            "displacement, rms",
        )
    size = displacement if rms is None else rms
    if size is None or not (math.isfinite(size) and size > 0):
        raise InputError(
            f"{'displacement' if rms is None else 'rms'} must be positive and finite [m], not {size}"
        )
    return 1.0 if displacement is None else displacement


def _finished(heights: Array, grid: Grid, rms: float | None, line: str) -> Surface:
    if rms is not None:
        heights *= rms / heights.std()
        line += f", rms = {rms:g} m"
    return Surface(heights, grid, (line,))
