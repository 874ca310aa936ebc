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

_PASSES = 20  # enough for a map with spikes; a map that needs more is rough everywhere


@on_host_only
def despiked(surface: Surface, to: Literal["missing", "filled"] = "missing") -> Surface:
    """Return the surface without its spikes and streaks, see `find_spikes`.

    The search is repeated in the remaining cells until no spike is found.

    Parameters
    ----------
    surface : Surface
    to : {"missing", "filled"}
        Treatment of their cells: set to missing, and ignored in contact; or filled in smoothly from the heights around
        them, as by `filled`. Points that were missing before stay missing. A cell that still stands out after it is
        filled, because the heights around it are missing or faulty, is set to missing.

    Returns
    -------
    Surface
        Its provenance states their number, and the number left after 20 passes; the surface itself if it has none.

    Raises
    ------
    ValueError
        If `to` is neither of these.

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
    """Return the surface without the given spikes, and without those found in the remaining cells."""
    taken = np.zeros(surface.grid.shape, dtype=np.bool_)
    given_up = taken.copy()  # of the selected cells, those that stand out after they are filled
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
        words += "around them are also missing or faulty"
    if spikes.count:
        words += (
            f"; {spikes.count} more are left after {_PASSES} passes: the map is rough everywhere, filter it"
        )
    return surface.with_heights(clean.heights, words)
