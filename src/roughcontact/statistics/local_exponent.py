"""The local exponent d ln y/d ln F of a curve: in windows of half a decade, each with its standard error."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from roughcontact.validation import Array

__all__ = ["LocalExponent", "exponent_within", "local_exponents"]

WINDOW = 0.5  # decades of force: wide enough for a slope, narrow enough to show a bend
FEWEST = 4  # points: two for the line, two for its scatter


@dataclass(frozen=True, slots=True)
class LocalExponent:
    """The exponent of a curve over a window of forces.

    Attributes
    ----------
    exponent : float
        Slope of ln y over ln F by least squares.
    error : float
        Its standard error, from the scatter about the line: too small where neighbours deviate alike.
    window : tuple of float
        Lowest and highest force of the window [N].
    count : int
        Number of points in it.
    """

    exponent: float
    error: float
    window: tuple[float, float]
    count: int


def local_exponents(force: Array, values: Array) -> tuple[LocalExponent, ...]:
    """Return the exponents of a curve in windows side by side, which share the range of its forces evenly.

    A whole number of windows fills the range, each about half a decade wide; windows with fewer than four points are
    left out.

    Parameters
    ----------
    force, values : array, shape (n,)
        Both positive.
    """
    if len(force) < FEWEST:
        return ()
    low, high = math.log(force.min()), math.log(force.max())
    number = max(1, round((high - low) / (WINDOW * math.log(10))))
    ends = np.exp(np.linspace(low, high, number + 1))
    found = (exponent_within(force, values, pair) for pair in pairwise(ends))
    return tuple(each for each in found if each is not None)


def exponent_within(force: Array, values: Array, window: tuple[float, float]) -> LocalExponent | None:
    """Return the exponent over one window of forces; None with fewer than four points in it.

    Parameters
    ----------
    force, values : array, shape (n,)
        Values that are not positive and finite are ignored.
    window : tuple of float
        Lowest and highest force; both belong to it.
    """
    low, high = float(window[0]), float(window[1])
    inside = (force >= low * (1 - 1e-9)) & (force <= high * (1 + 1e-9)) & np.isfinite(values) & (values > 0)
    count = int(inside.sum())
    if count < FEWEST:
        return None
    x, y = np.log(force[inside]), np.log(values[inside])
    centred = x - x.mean()
    spread = float(centred @ centred)
    if spread == 0:
        return None  # all points at one force
    slope = float(centred @ y) / spread
    rest = y - y.mean() - slope * centred
    return LocalExponent(slope, math.sqrt(float(rest @ rest) / (count - 2) / spread), (low, high), count)
