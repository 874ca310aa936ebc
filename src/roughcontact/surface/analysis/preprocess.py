"""Heights made ready for a Fourier transform: complete, levelled, tapered."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
import numpy.typing as npt

from roughcontact.surface.analysis.windows import Taper, Window, window_along
from roughcontact.surface.surface import Surface

__all__ = ["Level", "complete", "power_left", "tapered", "tapers"]

Array = npt.NDArray[np.float64]
Level = Literal["auto", "none", "mean", "plane"]


def complete(surface: Surface, what: str) -> Array:
    """Return the heights of `surface`, which must have no missing point for `what`."""
    if surface.missing:
        raise ValueError(
            f"{what} needs a height at every point, and {surface.missing} are missing: fill them or crop the "
            "surface first, or use the structure function, which ignores missing points"
        )
    return surface.heights


def tapers(surface: Surface, window: Window) -> tuple[Taper, ...]:
    """Return the window of every axis."""
    grid = surface.grid
    return tuple(window_along(window, n, p) for n, p in zip(grid.shape, grid.periodic, strict=True))


def tapered(surface: Surface, windows: tuple[Taper, ...], level: Level, what: str) -> Array:
    """Return a new array of levelled heights [m] times the `windows`, whose sum is zero."""
    heights = complete(surface, what)
    if level not in ("auto", "none", "mean", "plane"):
        raise ValueError(f"level must be 'auto', 'none', 'mean' or 'plane', not {level!r}")
    work = heights - (0.0 if level == "none" else heights.mean())
    for axis, (n, periodic) in enumerate(zip(heights.shape, surface.grid.periodic, strict=True)):
        # Without missing points the slopes of the least-squares plane are independent of each other.
        if level == "plane" or (level == "auto" and not periodic):
            along = np.arange(n) - (n - 1) / 2
            shape = [1] * heights.ndim
            shape[axis] = n
            others = tuple(a for a in range(heights.ndim) if a != axis)
            slope = along @ work.mean(axis=others) / max(along @ along, 1.0)
            work -= (slope * along).reshape(shape)
    columns = windows[-1].values
    rows = windows[0].values[:, None] if heights.ndim == 2 else np.ones(1)
    if level != "none":
        # What the window makes of a constant would leak into the longest waves.
        weights = float(columns.sum() * rows.sum())
        work -= float(np.sum(rows.ravel() * (work @ columns))) / weights
    work *= columns
    work *= rows
    return work


def power_left(windows: tuple[Taper, ...]) -> float:
    """Return the share of the power that all `windows` together leave."""
    return math.prod(w.power for w in windows)
