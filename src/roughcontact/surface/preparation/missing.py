"""Filling of points that were not measured, from the points around them."""

from __future__ import annotations

from typing import Literal

import numpy as np

from roughcontact.surface.in_memory import on_host_only
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, require

__all__ = ["filled"]


@on_host_only
def filled(surface: Surface, method: Literal["harmonic", "nearest"] = "harmonic") -> Surface:
    """Return the surface with heights at the points that were not measured.

    The true heights are unknown: the filling is smooth or flat, without roughness, and within the range of the heights
    around it. Spectra and filters by Fourier transform need it; contact does not.

    Parameters
    ----------
    surface : Surface
    method : {"harmonic", "nearest"}
        The solution of Laplace's equation through the measured heights around, like a soap film (at the edge of a
        free map it meets the edge at right angles); or the height of the nearest measured point.

    Returns
    -------
    Surface
        The surface without missing points; the surface itself if it has none.

    Raises
    ------
    ValueError
        If `method` is neither.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.Surface(np.array([[1e-6, 1e-6, 1e-6], [3e-6, np.nan, 3e-6]]), rc.Grid((2, 3), 1e-6))
    >>> f"{surface.filled().heights[1, 1] * 1e6:.2f} um"
    '2.33 um'
    """
    require(
        method in ("harmonic", "nearest"),
        f"method must be 'harmonic' or 'nearest', not {method!r}",
        place="method",
    )
    if surface.missing == 0:
        return surface
    fill = _harmonic if method == "harmonic" else _nearest
    heights = fill(surface.heights, surface.grid.spacing, surface.grid.periodic)
    return surface.with_heights(heights, f"{surface.missing} missing points filled in, {method}")


def _harmonic(heights: Array, spacing: tuple[float, ...], periodic: tuple[bool, ...]) -> Array:
    """Solve the five-point Laplace equation at the missing points."""
    from scipy.sparse import coo_array
    from scipy.sparse.linalg import splu

    missing = np.isnan(heights).reshape(-1)
    unknowns = np.flatnonzero(missing)
    number = np.full(heights.size, -1)
    number[unknowns] = np.arange(unknowns.size)
    flat, level = heights.reshape(-1), float(np.nanmean(heights))
    places = np.stack(np.unravel_index(unknowns, heights.shape))
    diagonal, right = np.zeros(unknowns.size), np.zeros(unknowns.size)
    rows, columns, values = [], [], []
    for axis, (n, step, repeats) in enumerate(zip(heights.shape, spacing, periodic, strict=True)):
        weight = (min(spacing) / step) ** 2  # only the ratio of the steps counts
        for way in (1, -1):
            moved = places.copy()
            moved[axis] += way
            inside = np.flatnonzero(repeats | ((moved[axis] >= 0) & (moved[axis] < n)))
            beside = np.ravel_multi_index(tuple(moved[:, inside]), heights.shape, mode="wrap")
            diagonal[inside] += weight
            known = ~missing[beside]
            right[inside[known]] += weight * (flat[beside[known]] - level)
            rows.append(inside[~known])
            columns.append(number[beside[~known]])
            values.append(np.full(rows[-1].size, -weight))
    each = np.arange(unknowns.size)
    matrix = coo_array(
        (
            np.concatenate([diagonal, *values]),
            (np.concatenate([each, *rows]), np.concatenate([each, *columns])),
        ),
        shape=(unknowns.size, unknowns.size),
    ).tocsc()
    factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    result = flat.copy()
    result[unknowns] = factors.solve(right) + level
    return result.reshape(heights.shape)


def _nearest(heights: Array, spacing: tuple[float, ...], periodic: tuple[bool, ...]) -> Array:
    """Copy the nearest measured height; on a periodic axis the nearest may lie across the border."""
    from scipy.ndimage import distance_transform_edt

    pads = [(n // 2 if repeats else 0,) * 2 for n, repeats in zip(heights.shape, periodic, strict=True)]
    wide = np.pad(heights, pads, mode="wrap")
    nearest = distance_transform_edt(
        np.isnan(wide), sampling=spacing, return_distances=False, return_indices=True
    )
    whole: Array = wide[tuple(nearest)]
    return whole[tuple(slice(pad, pad + n) for (pad, _), n in zip(pads, heights.shape, strict=True))]
