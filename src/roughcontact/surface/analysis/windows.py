"""Windows that take a free surface down to zero at its edges, and what they cost a spectrum."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

__all__ = ["WINDOWS", "Taper", "Window", "taper", "window_along"]

Array = npt.NDArray[np.float64]
Window = Literal["auto", "none", "hann", "hamming", "blackman", "welch"]
# Each as a function of the phase, from 0 to 2 pi along the axis.
_SHAPES: dict[str, Callable[[Array], Array]] = {
    "none": np.ones_like,
    "hann": lambda t: 0.5 - 0.5 * np.cos(t),
    "hamming": lambda t: 0.54 - 0.46 * np.cos(t),
    "blackman": lambda t: 0.42 - 0.5 * np.cos(t) + 0.08 * np.cos(2 * t),
    "welch": lambda t: 1 - (t / np.pi - 1) ** 2,
}
WINDOWS = tuple(_SHAPES)


@dataclass(frozen=True, slots=True, eq=False)
class Taper:
    """A window along one axis, with its corrections.

    Parameters
    ----------
    values : array, shape (n,)
        Factors of the heights at the cell centres.
    power : float
        Mean square factor: the share of the power that is left.
    overlap : float
        How many neighbouring waves share their information, ``<w^4>/<w^2>^2``: 1 without a window.
        An average over waves is as good as one over that many times fewer independent waves.
    smear : float
        Second moment of the window's kernel in units of ``(2 pi/L)^2``, ``<w'^2>/<w^2>``: 0 without a window.
        To first order the mean estimate is the true density plus half of this times its second derivative.
    """

    values: Array
    power: float
    overlap: float
    smear: float


def taper(name: str, size: int) -> Taper:
    """Return the window `name` at the centres of `size` cells.

    Raises
    ------
    ValueError
        If there is no such window.
    """
    if name not in _SHAPES:
        raise ValueError(f"window must be one of {', '.join(_SHAPES)}, not {name!r}")
    values = _SHAPES[name](2 * np.pi * (np.arange(size) + 0.5) / size)
    power = float(np.mean(values**2))
    # A step at the edges has no second moment: only the inside of the window counts.
    slope = np.diff(values) * size
    smear = float(slope @ slope) / size / power / (2 * math.pi) ** 2
    return Taper(values, power, float(np.mean(values**4)) / power**2, smear)


def window_along(name: str, size: int, periodic: bool) -> Taper:
    """Return the window `name`, of which "auto" is none along a periodic and Hann along a free axis."""
    if name == "auto":
        return taper("none" if periodic else "hann", size)
    return taper(name, size)
