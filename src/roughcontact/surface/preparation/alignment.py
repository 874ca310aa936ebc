"""Alignment of scan lines that are shifted against each other, by their medians."""

from __future__ import annotations

from typing import Literal

import numpy as np

from roughcontact.errors import InputError
from roughcontact.surface.in_memory import on_host_only
from roughcontact.surface.surface import Surface
from roughcontact.validation import require

__all__ = ["aligned"]


@on_host_only
def aligned(surface: Surface, lines: Literal["rows", "columns"] = "rows") -> Surface:
    """Return the surface with the median of each scan line at that of the map, as AFM software aligns rows.

    Each line of a scanning microscope drifts separately. Real long waves across the lines are also removed with the
    shifts: align only maps that were measured line by line. A streak along part of a line is not a shift: call
    `despiked` first.

    Parameters
    ----------
    surface : Surface
        On a grid of two axes. Missing points are ignored and stay missing.
    lines : {"rows", "columns"}
        The scan lines.

    Returns
    -------
    Surface
        The surface with the shifts in its provenance.

    Raises
    ------
    ValueError
        If `lines` is neither, or the surface is a profile.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> rng = np.random.default_rng(1)
    >>> rough = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-7, rng=rng)
    >>> shifted = rough.with_heights(rough.heights + rng.normal(0, 1e-6, (64, 1)), "rows shifted")
    >>> f"rms {shifted.rms * 1e9:.0f} nm, {shifted.aligned().rms * 1e9:.0f} nm when aligned"
    'rms 854 nm, 82 nm when aligned'
    """
    require(lines in ("rows", "columns"), f"lines must be 'rows' or 'columns', not {lines!r}", place="lines")
    heights = surface.heights
    if heights.ndim == 1:
        raise InputError("a profile is one scan line", "align the lines of a map")
    along = 1 if lines == "rows" else 0
    known = surface.measured.any(axis=along)
    shifts = np.zeros(known.size)
    shifts[known] = np.nanmedian(np.compress(known, heights, axis=1 - along), axis=along)
    shifts[known] -= np.nanmedian(heights)
    size = float(np.sqrt(np.mean(shifts[known] ** 2)))
    line = f"{lines} aligned by their medians, shifts of {size:.6g} m rms removed"
    return surface.with_heights(heights - np.expand_dims(shifts, along), line)
