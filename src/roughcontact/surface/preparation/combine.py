"""Combination of two rough bodies into one, also for different grids."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterable
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt
import scipy.sparse

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.surface.in_memory import on_host_only
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, finite, numeric, require, shown

__all__ = ["combined", "require_comparable", "resampled", "same_spacing"]

Interpolation: TypeAlias = Literal["cubic", "linear"]

# Relative difference up to which spacings, lengths and positions count as equal.
_SAME = 1e-9


@numeric(shift="m")
@on_host_only
def combined(
    lower: Surface,
    upper: Surface,
    *,
    turned_about: Literal["x", "y"] | None = "y",
    grid: Grid | None = None,
    interpolation: Interpolation = "cubic",
    shift: npt.ArrayLike | None = None,
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
    shift : tuple of float, optional
        ``(dy, dx)`` by which the upper body is moved after it is turned over [m], as `shift_between` finds it.

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
    below = resampled(lower, target, interpolation=interpolation)
    above = resampled(turned, target, interpolation=interpolation, shift=shift)
    heights = below.heights + above.heights
    if np.isnan(heights).all():
        raise InputError("the two surfaces have no measured point in common: nothing can touch")
    line = "combined with: " + ("; ".join(above.provenance) or "a surface")
    whole = below.with_heights(heights, line, target)
    if loss := _lost(lower.grid, upper.grid, target, _moved(shift, target)):
        warnings.warn(f"combined: {loss}", stacklevel=2)
        whole = whole.with_heights(heights, loss)
    return whole


@numeric(shift="m")
@on_host_only
def resampled(
    surface: Surface,
    grid: Grid,
    *,
    interpolation: Interpolation = "cubic",
    shift: npt.ArrayLike | None = None,
) -> Surface:
    """Return the heights interpolated at the cell centres of another grid with the same middle.

    Parameters
    ----------
    surface : Surface
    grid : Grid
        Of the same length along a periodic axis, of any length along others; cells outside the surface are missing.
    interpolation : {"cubic", "linear"}
        Through four neighbouring points along each axis, or two. Where one of them is missing, "cubic" falls back to
        "linear", and where one of two is missing, so is the result.
    shift : tuple of float, optional
        ``(dy, dx)`` by which the surface is moved on the grid [m], in the direction of increasing indices; ``(dx,)``
        of a profile.

    Returns
    -------
    Surface
        The surface itself if the grids are equal and nothing is moved. After a shift, the provenance states the share
        of its height that a wave of four cells keeps.

    Raises
    ------
    ValueError
        If the number of axes or the periodic axes differ, or periods do, or a grid has too few cells; or if `shift`
        is not one finite length an axis, or moves the surface off the grid.

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
    require_comparable(surface.grid, grid)
    same = surface.grid.shape == grid.shape and same_spacing(surface.grid, grid)
    moved = _moved(shift, grid)
    if same and not any(moved):
        return surface
    heights = _interpolated(surface, grid, 1, moved)
    if interpolation == "cubic":
        finer = _interpolated(surface, grid, 3, moved)
        heights = np.where(np.isnan(finer), heights, finer)
    require(not np.isnan(heights).all(), "the new grid holds no measured point of the surface")
    shape = " x ".join(str(n) for n in grid.shape)
    line = f"resampled to {shape} cells, {interpolation} interpolation"
    if any(moved):
        degree = 3 if interpolation == "cubic" else 1
        kept = [_kept(surface.grid, axis, degree, moved[axis]) for axis in range(grid.ndim)]
        line += f", moved by {_listed(moved, '.6g')} m: waves of four cells keep {_listed(kept, '.3g')} of their height"
    return surface.with_heights(heights, line, grid)


def same_spacing(one: Grid, other: Grid) -> bool:
    """Return whether the cells of two grids have the same size."""
    return one.ndim == other.ndim and np.allclose(one.spacing, other.spacing, rtol=_SAME, atol=0)


def _moved(shift: npt.ArrayLike | None, grid: Grid) -> tuple[float, ...]:
    """Return the shift along each axis [m]."""
    if shift is None:
        return (0.0,) * grid.ndim
    given = finite(shift, "shift [m]")
    if given.shape != (grid.ndim,):
        raise about("shift [m]", f"must be one length an axis, {grid.ndim} in all, not {shown(shift)}")
    return tuple(given.tolist())


def _listed(values: Iterable[float], form: str) -> str:
    return "(" + ", ".join(format(value, form) for value in values) + ")"


def _kept(grid: Grid, axis: int, degree: int, moved: float) -> float:
    """Return the share of its height that a wave of four cells keeps when it is moved along an axis."""
    row = _weights(grid, grid, axis, degree, moved % grid.spacing[axis])[[grid.shape[axis] // 2]]
    return float(abs(np.sum(row.data * 1j**row.indices)))


def _lost(lower: Grid, upper: Grid, target: Grid, moved: tuple[float, ...]) -> str:
    """Return a text with the number of cells of each body whose centre lies outside the other body or the new grid."""
    found = []
    for name, grid, offset in (("lower", lower, 0), ("upper", upper, 1)):
        kept = 1
        for axis in range(grid.ndim):
            n, shift = grid.shape[axis], moved[axis] * (not grid.periodic[axis])
            places = (np.arange(n) - (n - 1) / 2) * grid.spacing[axis] + offset * shift
            inside = np.abs(places) <= min(lower.lengths[axis], target.lengths[axis]) / 2 * (1 + _SAME)
            inside &= np.abs(places - shift) <= upper.lengths[axis] / 2 * (1 + _SAME)
            kept *= int(np.count_nonzero(inside))
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


def require_comparable(source: Grid, target: Grid) -> None:
    """Raise a ValueError unless two grids have the same axes and periods."""
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


def _interpolated(surface: Surface, grid: Grid, degree: int, moved: tuple[float, ...]) -> Array:
    """Return the heights at the new points, by polynomials of the given degree along each axis in turn."""
    heights = surface.heights
    for axis in range(grid.ndim):
        weights = _weights(surface.grid, grid, axis, degree, moved[axis])
        heights = np.moveaxis(weights @ np.moveaxis(heights, axis, 0), 0, axis)
        outside = np.diff(weights.indptr) == 0
        heights[(slice(None),) * axis + (outside,)] = np.nan
    return heights


def _weights(source: Grid, target: Grid, axis: int, degree: int, moved: float) -> Any:
    """Return the sparse matrix from the old points to the new ones of an axis; no entry outside the old cells."""
    n, step, periodic = source.shape[axis], source.spacing[axis], source.periodic[axis]
    if n <= degree:
        raise InputError(
            f"interpolation of degree {degree} needs at least {degree + 1} cells an axis, not {n}"
        )
    m = target.shape[axis]
    # In cells of the old grid, counted from its first centre; the middles coincide.
    place = (np.arange(m) - (m - 1) / 2) * (target.spacing[axis] / step) + (n - 1) / 2 - moved / step
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
