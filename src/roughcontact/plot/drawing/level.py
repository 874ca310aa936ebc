"""A horizontal line across the axes, with words on it at a free place."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from roughcontact.plot.drawing.ticks import TICK
from roughcontact.validation import Array

__all__ = ["free_place", "level"]

_PLACES = {"left": 0.01, "center": 0.5, "right": 0.99}  # of words, along the line
_WIDE, _HIGH, _NEAR = 0.27, 0.06, 0.015  # of the axes: width and height of words, and size of a point
_FINE = 60  # points on a straight piece of a line
_ORDER = (*product(("right", "left", "center"), ("bottom",)), *product(("right", "left", "center"), ("top",)))


def level(axes: Axes, value: float, words: str = "", style: Any = "--", **given: Any) -> None:
    """Draw a horizontal line across the axes, with words above its left end, or aligned by `ha` and `va`."""
    axes.axhline(value, color="0.35", linewidth=0.9, linestyle=style, zorder=1)
    aligned = {"ha": "left", "va": "bottom"} | given
    above = 2 if aligned["va"] == "bottom" else -3
    at: Any = ("axes fraction", "data")
    text: Any = {"fontsize": TICK, "color": "0.3"} | aligned
    axes.annotate(words, (_PLACES[aligned["ha"]], value), (0, above), at, "offset points", **text)


def free_place(axes: Axes, value: float, first: tuple[str, str] | None = None) -> dict[str, str]:
    """Return the alignment of words on a horizontal line that covers the least of what is drawn already.

    `first` is chosen if no other alignment covers less.
    """
    x, y = _drawn(axes)
    above = y - float((axes.transData + axes.transAxes.inverted()).transform((1.0, value))[1])

    def covered(place: tuple[str, str]) -> int:
        ha, va = place
        start = {"left": 0.0, "center": 0.5 - _WIDE / 2, "right": 1 - _WIDE}[ha]
        up = above if va == "bottom" else -above
        beside = (x > start) & (x < start + _WIDE)
        return int(np.count_nonzero(beside & (up > -_NEAR) & (up < _HIGH)))

    ha, va = min(_ORDER if first is None else (first, *_ORDER), key=covered)
    return {"ha": ha, "va": va}


def _drawn(axes: Axes) -> tuple[Array, Array]:
    """Return points on all markers and lines, as parts of the axes."""
    axes.get_xlim(), axes.get_ylim()  # reading the limits updates them
    points = []
    for line in axes.lines:
        corners = line.get_transform().transform(line.get_xydata())
        corners = axes.transAxes.inverted().transform(corners)
        if len(corners) and line.get_linestyle() not in ("None", "none", " ", ""):
            ends = np.arange(len(corners))
            fine = np.linspace(0, len(corners) - 1, _FINE * (len(corners) - 1) + 1)
            corners = np.stack([np.interp(fine, ends, each) for each in corners.T], axis=1)
        points.append(corners)
    return tuple(np.concatenate([*points, np.empty((0, 2))]).T)
