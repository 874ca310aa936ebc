"""A surface without its spikes and streaks."""

from __future__ import annotations

from typing import Literal

import numpy as np

from roughcontact.surface.in_memory import on_host_only
from roughcontact.surface.preparation.missing import filled
from roughcontact.surface.preparation.spikes import Spikes, described, find_spikes
from roughcontact.surface.surface import Surface
from roughcontact.validation import require

__all__ = ["despiked", "without_spikes"]

_PASSES = 20  # what a map of spikes needs; one that needs more is rough all over


@on_host_only
def despiked(surface: Surface, to: Literal["missing", "filled"] = "missing") -> Surface:
    """Return the surface without its spikes and streaks, see `find_spikes`.

    They are looked for again in what is left, until none is found.

    Parameters
    ----------
    surface : Surface
    to : {"missing", "filled"}
        What becomes of their cells: not measured, so that contact leaves them out; or filled in smoothly from the
        heights around them, as `filled` does. Points that were missing before stay missing. A cell that still stands
        out when it is filled, because the heights around it are missing or faulty, is set to missing.

    Returns
    -------
    Surface
        With their number in the provenance, and what is left after 20 passes; the surface itself if it has none.

    Raises
    ------
    ValueError
        If `to` is neither.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> rough = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> heights = rough.heights.copy()
    >>> heights[20, 30:32] += 1e-5
    >>> rc.Surface(heights, rough.grid).despiked().missing
    2
    """
    require(to in ("missing", "filled"), f"to must be 'missing' or 'filled', not {to!r}", place="to")
    return without_spikes(surface, find_spikes(surface), to)


def without_spikes(surface: Surface, spikes: Spikes, to: Literal["missing", "filled"] = "missing") -> Surface:
    """Return the surface without the spikes that were found on it, and those that are found in what is left."""
    taken = np.zeros(surface.grid.shape, dtype=np.bool_)
    given_up = taken.copy()  # of the cells that are taken, those that stand out when they are filled
    clean = surface
    for _ in range(_PASSES):
        if spikes.count == 0:
            break
        given_up |= spikes.mask & taken
        taken |= spikes.mask
        heights = np.where(taken, np.nan, surface.heights)
        if to == "filled":
            whole = filled(surface.with_heights(heights, "")).heights
            heights = np.where(taken & ~given_up, whole, heights)
        clean = surface.with_heights(heights, "")
        spikes = find_spikes(clean)
    if clean is surface:
        return surface
    words, count = f"despiked: {described(surface.heights, taken)}", int(given_up.sum())
    if to == "missing":
        words += " set to missing"
    elif count == 0:
        words += " filled in, harmonic"
    else:
        words += f": {int(taken.sum()) - count} filled in, harmonic, and {count} set to missing, because the heights "
        words += "around them are missing or faulty too"
    if spikes.count:
        words += (
            f"; {spikes.count} more are left after {_PASSES} passes: the map is rough all over, filter it"
        )
    return surface.with_heights(clean.heights, words)
