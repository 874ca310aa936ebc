"""Windows: factors that reduce the heights to zero toward the edges, for periodic continuation of a free map."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Literal, TypeAlias

import numpy as np

from roughcontact.surface.in_memory import on_host_only
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric_method, require

__all__ = ["WINDOWS", "Window", "tapered", "window_values"]

Window: TypeAlias = Literal["hann", "hamming", "blackman", "welch", "tukey"]
# Each window except Tukey's, which has a parameter, as a function of the phase, from 0 to 2 pi along the axis.
_SHAPES: dict[str, Callable[[Array], Array]] = {
    "hann": lambda t: 0.5 - 0.5 * np.cos(t),
    "hamming": lambda t: 0.54 - 0.46 * np.cos(t),
    "blackman": lambda t: 0.42 - 0.5 * np.cos(t) + 0.08 * np.cos(2 * t),
    "welch": lambda t: 1 - (t / np.pi - 1) ** 2,
}
WINDOWS = (*_SHAPES, "tukey")


def window_values(name: str, count: int, share: float = 0.25) -> Array:
    """Return a window at the centres of `count` cells, see `tapered`.

    Raises
    ------
    ValueError
        If there is no such window, or `share` lies outside 0 to 1.
    """
    phase = 2 * np.pi * (np.arange(count) + 0.5) / count
    if name in _SHAPES:
        return _SHAPES[name](phase)
    require(name == "tukey", f"window must be one of {', '.join(WINDOWS)}, not {name!r}", place="name")
    require(0 <= share <= 1, f"share must lie between 0 and 1, not {share}", place="share")
    # A flat middle between two halves of a Hann window, each of half the share.
    bent = np.minimum(phase, 2 * np.pi - phase)
    return _SHAPES["hann"](np.minimum(bent, math.pi * share) / share) if share else np.ones(count)


@on_host_only
@numeric_method
def tapered(surface: Surface, window: Window = "hann", share: float = 0.25) -> Surface:
    """Return the heights above their mean times a window along every free axis.

    Periodic axes need no window and are unchanged. The mean square falls by the factor in the provenance. Do not taper
    before `power_spectrum`, which applies a window and corrects for it.

    Parameters
    ----------
    surface : Surface
    window : {"hann", "hamming", "blackman", "welch", "tukey"}
        With t from 0 to 1 along the axis, Hann: sin^2(pi t), Welch: 1 - (2t - 1)^2, Tukey: a flat middle between two
        halves of a Hann window.
    share : float
        For "tukey": the tapered part of the length, both ends together, from 0 to 1.

    Returns
    -------
    Surface
        The tapered heights, about zero.

    Raises
    ------
    ValueError
        If `window` is unknown, or `share` lies outside 0 to 1.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> rough = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> rough.tapered("hann").provenance[-1]
    'hann window, mean square times 0.140625'
    """
    heights = surface.heights - np.nanmean(surface.heights)
    loss = 1.0
    for axis, (count, repeats) in enumerate(zip(surface.grid.shape, surface.grid.periodic, strict=True)):
        if not repeats:
            weights = window_values(window, count, share)
            heights = heights * weights.reshape([-1 if k == axis else 1 for k in range(heights.ndim)])
            loss *= float((weights**2).mean())
    line = f"{window} window, mean square times {loss:.6g}"
    return surface.with_heights(heights, line)
