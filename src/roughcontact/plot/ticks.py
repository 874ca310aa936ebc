"""Ticks of logarithmic axes: enough numbers to read by, few enough to stand apart."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axis import Axis

__all__ = ["readable_ticks"]

_DECADES = 100.0  # from this ratio on, powers of ten are enough
_STEPS = 5.0  # below it, not even 1, 2 and 5 times a power of ten are sure to occur twice


def readable_ticks(axis: Axis, ratio: float) -> None:
    """Choose the ticks of a logarithmic axis whose largest number is `ratio` times its smallest."""
    from matplotlib import ticker

    axis.set_minor_formatter(ticker.NullFormatter())
    if ratio >= _DECADES:
        axis.set_major_locator(ticker.LogLocator())
        axis.set_major_formatter(ticker.LogFormatterSciNotation())
        return
    if ratio >= _STEPS:
        axis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
    else:
        axis.set_major_locator(ticker.MaxNLocator(4, steps=[1, 2, 5, 10]))
        axis.set_minor_locator(ticker.NullLocator())
    axis.set_major_formatter(ticker.FormatStrFormatter("%g"))
