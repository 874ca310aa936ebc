"""Combination of two rough bodies into one, also for different grids."""

from __future__ import annotations

import math
import warnings
from typing import Any, Literal, TypeAlias

import numpy as np
import scipy.sparse

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.surface.in_memory import on_host_only
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric, require

__all__ = ["combined", "resampled"]

Interpolation: TypeAlias = Literal["cubic", "linear"]

# Relative difference up to which spacings, lengths and positions count as equal.
_SAME = 1e-9


@numeric
@on_host_only
def combined(
    lower: Surface,
    upper: Surface,
    *,
    turned_about: Literal["x", "y"] | None = "y",
    grid: Grid | None = None,
    interpolation: Interpolation = "cubic",
) -> Surface:
    """Return the surface that replaces two rough bodies in contact with a flat: the sum of their heights.

    The gap of two rough bodies is a constant less both heights, each positive out of its body. Their elastic contact
    is therefore that of one body with the sum of the heights and the reduced modulus.

    Parameters
    ----------
    lower, upper : Surface
        Both as measured, seen from outside, with the first row at the top of the picture. Their middles coincide.
    turned_about : {"y", "x", None}
        Axis about which the upper body is turned over to face the lower one. About y, like a page: its columns are
        reversed. About x: its rows. None: it is given as seen from behind, in the coordinates of the lower body.
    grid : Grid, optional
        Grid of the result, whose middle coincides with theirs. By default that of the surface with the
        smaller cells; of the lower one if they are equal.
    interpolation : {"cubic", "linear"}
        How a surface on another grid is resampled, see `resampled` for its cost. Surfaces on equal grids are added
        without interpolation.

    Returns
    -------
    Surface
        Missing where either surface is missing or has no cells.

    Raises
    ------
    ValueError
        If one is periodic along an axis and the other is not, their periods differ, or they do not overlap.

    Warns
    -----
    UserWarning
        If cells of either lie beyond the other or beyond the grid, and are lost; the warning and the provenance state
        how many.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> rough = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> f"{rc.combined(rough, rough, turned_about=None).rms:.3g} m"
    '2e-06 m'
    """
    turned = _turned(upper, turned_about)
    target = grid
    if target is None:
        target = upper.grid if upper.grid.cell_area < lower.grid.cell_area * (1 - _SAME) else lower.grid
    below, above = (resampled(body, target, interpolation=interpolation) for body in (lower, turned))
    heights = below.heights + above.heights
    if np.isnan(heights).all():
        raise InputError("the two surfaces have no measured point in common: nothing can touch")
    line = "combined with: " + ("; ".join(above.provenance) or "a surface")
    whole = below.with_heights(heights, line, target)
    if loss := _lost(lower.grid, upper.grid, target):
        warnings.warn(f"combined: {loss}", stacklevel=2)
        whole = whole.with_heights(heights, loss)
    return whole


@numeric
@on_host_only
def resampled(surface: Surface, grid: Grid, *, interpolation: Interpolation = "cubic") -> Surface:
    """Return the heights interpolated at the cell centres of another grid with the same middle.

    Parameters
    ----------
    surface : Surface
    grid : Grid
        Of the same length along a periodic axis, of any length along others; cells outside the surface are missing.
    interpolation : {"cubic", "linear"}
        Through four neighbouring points along each axis, or two. Where one of them is missing, "cubic" falls back to
        "linear", and where one of two is missing, so is the result.

    Returns
    -------
    Surface
        The surface itself if the grids are equal.

    Raises
    ------
    ValueError
        If the number of axes or the periodic axes differ, or periods do, or a grid has too few cells.

    Notes
    -----
    Error of a wave of amplitude h and wavenumber q along an axis of spacing D, at most ``h (qD)^2/8`` with "linear" and
    ``3h (qD)^4/128`` with "cubic": 1 % of h needs 23 and 8 points a wave. Waves of fewer points lose most of their
    height: a surface that is rough down to its spacing becomes smoother between its points. The same polynomials are
    used between the outermost points and the edges of their cells. On a coarser grid heights are not averaged: waves
    shorter than twice its spacing appear as longer ones.

    Examples
    --------
    >>> import roughcontact as rc
    >>> coarse, fine = (rc.Grid((n, n), 64e-6 / n, periodic=True) for n in (32, 64))
    >>> wave = rc.shapes.wave(coarse, amplitude=1e-6, wavelength=32e-6)
    >>> finer = rc.resampled(wave, fine)
    >>> finer.grid.shape, f"{finer.rms:.2g} m"
    ((64, 64), '7.1e-07 m')
    """
    if interpolation not in ("cubic", "linear"):
        raise about("interpolation", f"must be 'cubic' or 'linear', not {interpolation!r}")
    _comparable(surface.grid, grid)
    if surface.grid.shape == grid.shape and np.allclose(
        surface.grid.spacing, grid.spacing, rtol=_SAME, atol=0
    ):
        return surface
    heights = _interpolated(surface, grid, 1)
    if interpolation == "cubic":
        finer = _interpolated(surface, grid, 3)
        heights = np.where(np.isnan(finer), heights, finer)
    require(not np.isnan(heights).all(), "the new grid holds no measured point of the surface")
    shape = " x ".join(str(n) for n in grid.shape)
    return surface.with_heights(heights, f"resampled to {shape} cells, {interpolation} interpolation", grid)


def _lost(lower: Grid, upper: Grid, target: Grid) -> str:
    """Return a text with the number of cells of each body whose centre lies outside the other body or the new grid."""
    common = [min(ends) for ends in zip(lower.lengths, upper.lengths, target.lengths, strict=True)]
    found = []
    for name, grid in (("lower", lower), ("upper", upper)):
        kept = 1
        for n, step, length in zip(grid.shape, grid.spacing, common, strict=True):
            places = np.abs(np.arange(n) - (n - 1) / 2) * step
            kept *= int(np.count_nonzero(places <= length / 2 * (1 + _SAME)))
        if lost := grid.size - kept:
            found.append(
                f"{lost} of {grid.size} cells ({math.ceil(100 * lost / grid.size)} %) of the {name} surface"
            )
    both = " and ".join(found)
    return (
        f"{both} lie beyond what both cover and are left out; crop the larger one to choose its part"
        if both
        else ""
    )


def _turned(upper: Surface, about: str | None) -> Surface:
    if about is None:
        return upper
    require(about in ("x", "y"), f"turned_about must be 'x', 'y' or None, not {about!r}")
    if upper.grid.ndim == 1 and about == "x":
        raise InputError("a line is turned about 'y', which reverses it, or not at all (None)")
    flipped = np.flip(upper.heights, -1 if about == "y" else 0)
    return upper.with_heights(flipped, f"turned over about {about}")


def _comparable(source: Grid, target: Grid) -> None:
    if source.ndim != target.ndim:
        raise InputError(
            f"the number of axes must be the same, not {source.ndim} and {target.ndim}",
            "give two maps or two lines",
        )
    if source.periodic != target.periodic:
        raise InputError(
            f"one grid is periodic where the other is not ({source.periodic} and {target.periodic})",
            "make both the same, for example Surface(heights, Grid(shape, spacing, periodic=False))",
        )
    for mine, theirs, periodic in zip(source.lengths, target.lengths, source.periodic, strict=True):
        if periodic and abs(mine - theirs) > _SAME * theirs:
            raise InputError(
                f"periods must be equal, not {mine:g} m and {theirs:g} m", "free both (Grid(shape, spacing))"
            )


def _interpolated(surface: Surface, grid: Grid, degree: int) -> Array:
    """Return the heights at the new points, by polynomials of the given degree along each axis in turn."""
    heights = surface.heights
    for axis in range(grid.ndim):
        weights = _weights(surface.grid, grid, axis, degree)
        heights = np.moveaxis(weights @ np.moveaxis(heights, axis, 0), 0, axis)
        outside = np.diff(weights.indptr) == 0
        heights[(slice(None),) * axis + (outside,)] = np.nan
    return heights


def _weights(source: Grid, target: Grid, axis: int, degree: int) -> Any:
    """Return the sparse matrix from the old points to the new ones of an axis; no entry outside the old cells."""
    n, step, periodic = source.shape[axis], source.spacing[axis], source.periodic[axis]
    if n <= degree:
        raise InputError(
            f"interpolation of degree {degree} needs at least {degree + 1} cells an axis, not {n}"
        )
    m = target.shape[axis]
    # In cells of the old grid, counted from its first centre; the middles coincide.
    place = (np.arange(m) - (m - 1) / 2) * (target.spacing[axis] / step) + (n - 1) / 2
    # A point that coincides with an old one gets its height, even if its neighbours are missing.
    whole = np.round(place)
    place = np.where(np.abs(place - whole) < _SAME * n, whole, place)
    first = np.floor(place).astype(int) - degree // 2
    if not periodic:
        first = np.clip(first, 0, n - 1 - degree)
    columns = first[:, None] + np.arange(degree + 1)
    values = np.ones(columns.shape)
    for k in range(degree + 1):  # Lagrange's polynomials on the nodes of each row
        for other in set(range(degree + 1)) - {k}:
            values[:, k] *= (place - columns[:, other]) / (k - other)
    if not periodic:
        values[(place < -0.5 - _SAME * n) | (place > n - 0.5 + _SAME * n)] = 0
    rows = np.broadcast_to(np.arange(m)[:, None], columns.shape)
    matrix = scipy.sparse.csr_array(
        (values.ravel(), (rows.ravel(), np.mod(columns, n).ravel())), shape=(m, n)
    )
    matrix.eliminate_zeros()  # zero times a missing height must not enter the sum
    return matrix
