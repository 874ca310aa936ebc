"""Where a self-affine law ends, toward long and toward short waves."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Literal

import numpy as np
from scipy.special import ndtr

from roughcontact.surface.analysis.power import PowerSpectrum
from roughcontact.surface.analysis.whittle import Slope, likeliest, mean_level

__all__ = ["Limit", "Limits", "clear_bins", "find_limits", "sharpened", "step_at"]

Limit = Literal["auto", "none", "rolloff", "long_cutoff"]
# With fewer bins a law cannot be distinguished from its ends.
LEAST = 12
_End = Literal["bend", "first", "last"]
_Which = Literal["long", "short"]


@dataclass(frozen=True, slots=True)
class Limits:
    """A law from bin `first` to bin `last`, flat below the bin `bend`."""

    first: int
    last: int
    bend: int


def find_limits(band: PowerSpectrum, limit: Limit) -> Limits:
    """Return the ends of the law by maximum likelihood."""
    size = band.wavenumber.size
    if limit == "none" or size < LEAST:
        return Limits(0, size, 0)
    longs: dict[Limit, tuple[_End, ...]] = {
        "auto": ("bend", "first"),
        "rolloff": ("bend",),
        "long_cutoff": ("first",),
    }
    cost = cache(lambda limits: _cost(band, limits))
    # If there are two ends, the result depends on which is found first: the better of the two orders is taken.
    orders: tuple[tuple[_Which, _Which], ...] = (("long", "short"), ("short", "long"))
    found = [_alternate(band, cost, longs[limit], limit != "auto", order) for order in orders]
    return min(found, key=cost)


def _alternate(
    band: PowerSpectrum,
    cost: Callable[[Limits], float],
    longs: tuple[_End, ...],
    forced: bool,
    order: tuple[_Which, _Which],
) -> Limits:
    """Search for the ends in turn, and once more for each when the other is known."""
    limits = Limits(0, band.wavenumber.size, 0)
    for which in (*order, *order):
        if which == "long":
            without = replace(limits, first=0, bend=0)
            choices = [_search(band, cost, without, end) for end in longs]
        else:
            without = replace(limits, last=band.wavenumber.size)
            choices = [_search(band, cost, without, "last")]
        if not (forced and which == "long"):
            choices.append(without)
        limits = min(choices, key=cost)
    return limits


def _search(band: PowerSpectrum, cost: Callable[[Limits], float], limits: Limits, end: _End) -> Limits:
    """Return `limits` with one `end` of the law at its best position."""
    # The law keeps a few bins and a factor of two in wavenumber.
    q = band.wavenumber
    if end == "last":
        start = max(limits.first, limits.bend)
        low, high = max(start + 4, int(np.searchsorted(q, 2 * q[start]))), q.size - 4
    else:
        low, high = 1, min(limits.last - 4, int(np.searchsorted(q, q[limits.last - 1] / 2)))
    if high < low:
        return limits

    def moved(place: int) -> Limits:
        return replace(limits, **{end: place})

    def cost_at(place: int) -> float:
        return cost(moved(place))

    stride = max(1, (high - low) // 30)
    best = min(range(low, high + 1, stride), key=cost_at)
    while stride > 1:
        reach, stride = stride, max(1, stride // 4)
        best = min(range(max(low, best - reach), min(high, best + reach) + 1, stride), key=cost_at)
    return moved(best)


def _cost(band: PowerSpectrum, limits: Limits) -> float:
    """Return the cost of a law with these limits, and the price of the limits.

    Below a cut-off the spectrum has one level; beyond the short limit it may follow any other power law,
    as noise, a blunt tip or what leaks through a window do.
    The price keeps a fluctuation from becoming a limit: half the logarithm of the number of data for each free number
    (Schwarz), and the same again for the choice of the position.
    """
    x = np.log(band.wavenumber)
    x -= x.mean()
    inside, gap, after = _parts(band, limits)
    bent = np.maximum(x, x[limits.bend])[inside] if limits.bend else x[inside]
    law = likeliest(bent, band, inside)
    cost = law.cost
    if limits.first:
        level = mean_level(band, slice(0, limits.first))
        cost += level.cost + _jump(law.level - law.exponent * bent[0], level.level)
    if x[after].size:
        other = likeliest(x[after], band, after)
        ends = (law.level - law.exponent * bent[-1], other.level - other.exponent * x[after][0])
        cost += other.cost + _jump(*ends)
    # In the gap every bin has a separate level; a bin without power should belong to the part beyond.
    least = float(band.density[band.density > 0].min())
    cost += float(band.freedom[gap] @ (1 + np.log(np.maximum(band.density[gap], least))))
    numbers = 2 * (limits.bend > 0) + 3 * (limits.first > 0) + 4 * (x[after].size > 0) + x[gap].size
    return cost + 0.5 * numbers * math.log(float(band.freedom.sum()))


def _parts(band: PowerSpectrum, limits: Limits) -> tuple[slice, slice, slice]:
    """Return the bins of the law, those next to its short limit and those beyond.

    A limit may lie inside a bin: the last bin of the law may hold waves of both sides, and would bend it. In addition,
    a window spreads a step: by its main lobe into the law, by its side lobes further out.
    """
    q = band.wavenumber
    if limits.last == q.size:
        return slice(limits.first, limits.last), slice(0, 0), slice(limits.last, None)
    step, width = math.sqrt(q[limits.last - 1] * q[limits.last]), math.sqrt(band.smear)
    before = max(int(np.searchsorted(q, step - 3.5 * width)) - 1, limits.first + 3)
    beyond = min(int(np.searchsorted(q, step + 9 * width)), q.size - 3)
    return slice(limits.first, before), slice(before, beyond), slice(beyond, None)


def _jump(law: float, beyond: float) -> float:
    """Return an infinite cost if the spectrum rises at the end of its law: `law` and `beyond` are logarithms there.

    A law ends where power is missing, or where noise begins to dominate, without a jump.
    """
    return math.inf if beyond > law + math.log(3) else 0.0


def step_at(band: PowerSpectrum, edge: int) -> float:
    """Return the wavenumber between bin `edge` and the one before it [rad/m]; NaN outside the band."""
    q = band.wavenumber
    return math.sqrt(q[edge - 1] * q[edge]) if 0 < edge < q.size else math.nan


def sharpened(band: PowerSpectrum, slope: Slope, centre: float, edge: float, rises: bool) -> float:
    """Return the wavenumber of the limit near `edge`, where a window has turned the step into a slope [rad/m]."""
    if math.isnan(edge):
        return edge
    q, width = band.wavenumber, math.sqrt(band.smear)
    near = np.abs(q - edge) < 12 * width
    law = np.exp(slope.level - slope.exponent * (np.log(q[near]) - centre))
    beyond = q < edge - 4 * width if rises else q > edge + 4 * width
    floor = float(np.average(band.density[beyond], weights=band.freedom[beyond])) if beyond.any() else 0.0

    def cost(place: float) -> float:
        # The main lobe of the kernel is treated as a normal distribution with its second moment, the side lobes as a
        # rest.
        model = law * np.maximum(ndtr((q[near] - place) / width * (1 if rises else -1)), 3e-3) + floor
        return float(band.freedom[near] @ (np.log(model) + band.density[near] / model))

    places = edge + width * np.linspace(-6, 6, 121)
    return float(min(places[places > 0], key=cost))


def clear_bins(band: PowerSpectrum, limits: Limits, edges: tuple[float, ...]) -> slice:
    """Return the bins of the law that are not affected by a limit, inside a bin (see `_parts`) or through the window.

    There are at least four.
    """
    q, guard = band.wavenumber, 3.5 * math.sqrt(band.smear)
    low, high = edges
    first = 0 if math.isnan(low) else int(np.searchsorted(q, low + guard)) + 1
    last = q.size if math.isnan(high) else int(np.searchsorted(q, high - guard)) - 1
    return slice(first, last) if last - first >= 4 else slice(limits.first, limits.last)
