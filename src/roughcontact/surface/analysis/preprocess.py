"""Heights made ready for a Fourier transform: complete, without tilt, under a window."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.surface.preparation.windows import window_values
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array

__all__ = ["Level", "SpectralWindow", "Taper", "complete", "power_left", "prepared", "taper", "tapers"]

Level: TypeAlias = Literal["auto", "none", "mean", "plane"]
SpectralWindow: TypeAlias = Literal["auto", "none", "hann", "hamming", "blackman", "welch", "tukey"]


@dataclass(frozen=True, slots=True, eq=False)
class Taper:
    """A window along one axis, with its corrections.

    Parameters
    ----------
    values : array, shape (n,)
        Factors of the heights at the cell centres.
    power : float
        Mean square of the factors: the share of the power that is left.
    overlap : float
        Number of neighbouring waves that are correlated, ``<w^4>/<w^2>^2``: 1 without a window. It divides the number
        of independent waves in an average.
    smear : float
        Second moment of the window's kernel in units of ``(2 pi/L)^2``, ``<w'^2>/<w^2>``: 0 without a window.
        To first order the mean estimate is the true density plus half of this times its second derivative.
    """

    values: Array
    power: float
    overlap: float
    smear: float


def taper(name: str, size: int, periodic: bool = False) -> Taper:
    """Return the window `name` along an axis of `size` cells; "auto" is "none" if it is periodic, otherwise "hann".

    Raises
    ------
    ValueError
        If there is no such window.
    """
    if name == "auto":
        name = "none" if periodic else "hann"
    values = np.ones(size) if name == "none" else window_values(name, size)
    power = float(np.mean(values**2))
    # A step at the edges has no second moment: only the inside of the window counts.
    slope = np.diff(values) * size
    smear = float(slope @ slope) / size / power / (2 * math.pi) ** 2
    return Taper(values, power, float(np.mean(values**4)) / power**2, smear)


def complete(surface: Surface, what: str) -> Array:
    """Return the heights of `surface`, which must have no missing point for `what`."""
    if surface.missing:
        raise InputError(
            f"{what} needs a height at every point, and {surface.missing} are missing",
            "fill them or crop the "
            "surface first, or use the structure function, which ignores missing points",
            place="surface",
        )
    return surface.heights


def tapers(surface: Surface, window: SpectralWindow) -> tuple[Taper, ...]:
    """Return the window of every axis."""
    grid = surface.grid
    return tuple(taper(window, n, p) for n, p in zip(grid.shape, grid.periodic, strict=True))


def prepared(surface: Surface, windows: tuple[Taper, ...], level: Level, what: str) -> Array:
    """Return a new array of the heights [m] without their trend, times the `windows`; its sum is zero."""
    heights = complete(surface, what)
    if level not in ("auto", "none", "mean", "plane"):
        raise about("level", f"must be 'auto', 'none', 'mean' or 'plane', not {level!r}")
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
        # The transform of a constant under the window would leak into the longest waves.
        weights = float(columns.sum() * rows.sum())
        work -= float(np.sum(rows.ravel() * (work @ columns))) / weights
    work *= columns
    work *= rows
    return work


def power_left(windows: tuple[Taper, ...]) -> float:
    """Return the share of the power that is left by all `windows` together."""
    return math.prod(w.power for w in windows)
