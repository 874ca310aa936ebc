"""A level across the axes, with words on it."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes

from roughcontact.plot.ticks import TICK

__all__ = ["level"]


def level(axes: Axes, value: float, words: str = "", style: Any = "--", **given: Any) -> None:
    """Draw a level across the axes, with words above its left end, or as the keywords `ha` and `va` align them."""
    axes.axhline(value, color="0.35", linewidth=0.9, linestyle=style, zorder=1)
    aligned = {"ha": "left", "va": "bottom"} | given
    place = 0.01 if aligned["ha"] == "left" else 0.99
    above = 2 if aligned["va"] == "bottom" else -3
    at: Any = ("axes fraction", "data")
    text: Any = {"fontsize": TICK, "color": "0.3"} | aligned
    axes.annotate(words, (place, value), (0, above), at, "offset points", **text)
