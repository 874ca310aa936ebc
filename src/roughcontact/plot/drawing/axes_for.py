"""Axes to draw on: those of the caller, or those of a new figure."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes

__all__ = ["axes_for"]


def axes_for(ax: Axes | None, size: tuple[float, float] = (5.6, 4.2), **kind: Any) -> Axes:
    """Return `ax`, or the axes of a new figure of pyplot, which notebooks show and ``pyplot.show()`` finds.

    Only this function calls pyplot, which keeps its figures; whole figures belong only to the caller.
    """
    if ax is not None:
        return ax
    from matplotlib import pyplot

    axes: Axes = pyplot.subplots(figsize=size, layout="constrained", subplot_kw=kind)[1]
    return axes
