"""Windows: heights that go to zero toward the edges, so that a free map may be repeated."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt

from roughcontact.validation import numeric

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["taper", "tapered"]

Array = npt.NDArray[np.float64]
Window = Literal["hann", "welch", "tukey"]


@numeric
def tapered(surface: Surface, window: Window = "hann", share: float = 0.25) -> Surface:
    """Return the heights above their mean times a window along every free axis.

    Periodic axes need none and are left. The mean square falls by the factor that the provenance states; a
    spectrum takes its own window and corrects for it, so it wants the surface as it is.

    Parameters
    ----------
    surface : Surface
    window : {"hann", "welch", "tukey"}
        See `taper`.
    share : float
        For ``"tukey"``: the part of the length that is bent, both ends together, from 0 to 1.
    """
    heights = surface.heights - np.nanmean(surface.heights)
    loss = 1.0
    for axis, (count, repeats) in enumerate(zip(surface.grid.shape, surface.grid.periodic, strict=True)):
        if not repeats:
            weights = taper(count, window, share)
            heights = heights * weights.reshape([-1 if k == axis else 1 for k in range(heights.ndim)])
            loss *= float((weights**2).mean())
    line = f"{window} window, mean square times {loss:.6g}"
    return replace(surface, heights=heights, provenance=(*surface.provenance, line))


def taper(count: int, window: Window, share: float = 0.25) -> Array:
    """Return a window at the centres of `count` cells, at place t from 0 to 1.

    Hann: sin^2(pi t), Welch: 1 - (2t - 1)^2, Tukey: a flat middle between two halves of a Hann window that take
    the part `share` of the length together.
    """
    place = (np.arange(count) + 0.5) / count
    if window == "hann":
        return np.asarray(np.sin(math.pi * place) ** 2)
    if window == "welch":
        return np.asarray(1 - (2 * place - 1) ** 2)
    if window != "tukey":
        raise ValueError(f"window must be 'hann', 'welch' or 'tukey', not {window!r}")
    if not 0 <= share <= 1:
        raise ValueError(f"share must lie between 0 and 1, not {share}")
    if share == 0:
        return np.ones(count)
    to_edge = np.minimum(place, 1 - place)
    return np.asarray(np.sin(math.pi * np.minimum(to_edge / share, 0.5)) ** 2)
