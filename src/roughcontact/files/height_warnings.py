"""Sizes and heights that are unusual for a measured surface of a machine part: warnings, not errors."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from roughcontact.arrays import is_numpy, namespace
from roughcontact.files.noisy_rows import noisy_rows
from roughcontact.surface.preparation.regular_subset import regular_subset
from roughcontact.surface.preparation.spikes import spikes_in
from roughcontact.validation import Array

__all__ = ["DESPIKE", "IMPOSSIBLE", "height_warnings", "highest"]

DESPIKE = "; remove faulty points by despiked() before pressing"  # the end of the warning about spikes
_SMALLEST, _LARGEST = 1e-9, 1.0  # side lengths [m]
_STEEPEST = 10.0  # rms height over side length, and the slope that half of all neighbours exceed
_HIGHEST = 1.0  # [m]
_FLATTEST = 1e-14  # smallest credible rms height [m]: an atom is ten thousand times as large
# Larger than any body: random bytes read as numbers, not a wrong unit.
IMPOSSIBLE = 1e9  # [m]
_FAR = 100.0  # interquartile ranges from the median
_ENOUGH = 1000  # points for statistics
_ENOUGH_IN_A_ROW = 32
# Equal neighbours, and the ratio to the second longest run: a plateau has similar runs in each row.
_RUN, _LONGER = 12, 4
_FEW = 64  # points needed to find outliers
_REPEATED = 4  # equal numbers far from all others
_MOSTLY = 0.5  # share of missing points
_DEVIATIONS = 3.0  # standard deviations within which a correlation counts as zero
_NOISY = 0.2  # share of rows without correlation


def highest(heights: Array) -> float:
    """Return the largest finite height or depth [m]; 0 if there is none."""
    if not is_numpy(heights):
        xp = namespace(heights)
        return float(xp.max(xp.where(xp.isfinite(heights), xp.abs(heights), 0.0)))
    low, high = (float(f(heights[np.isfinite(heights)], initial=0.0)) for f in (np.min, np.max))
    return max(-low, high)


def height_warnings(heights: Array, spacing: tuple[float, ...]) -> tuple[str, ...]:
    """Return a warning for each unusual property of `heights` [m], one axis or two, on cells of `spacing` [m]."""
    found = []
    lengths = [n * step for n, step in zip(heights.shape, spacing, strict=True)]
    if min(lengths) < _SMALLEST or max(lengths) > _LARGEST:
        sides = " m x ".join(f"{length:.3g}" for length in lengths)
        found.append(f"a surface of {sides} m is unusual; check size=")
    if (peak := highest(heights)) > _HIGHEST:
        found.append(f"heights up to {peak:.3g} m are unusual; check unit=")
    flat = float(np.nanmin(heights)) == float(np.nanmax(heights))
    rms = float(np.nanstd(heights))
    if rms < _FLATTEST and not flat:
        found.append(f"an rms height of {rms:.3g} m is less than any instrument resolves; check unit=")
    if rms > _STEEPEST * min(lengths):
        found.append(
            f"an rms height of {rms:.3g} m on {min(lengths):.3g} m is unusual; check unit= and size="
        )
    missing = np.count_nonzero(np.isnan(heights)) / heights.size
    if missing > _MOSTLY:
        found.append(f"{missing:.0%} of its points are missing")
    known = int(np.count_nonzero(~np.isnan(heights)))
    if known < _ENOUGH:
        return (*found, *(_apart(heights) if known >= _FEW and not flat else ()))
    if flat:
        return (*found, "all its heights are equal, unlike any measured surface")
    return (*found, *_statistics(heights, spacing))


def _statistics(heights: Array, spacing: tuple[float, ...]) -> list[str]:
    """Return warnings that need many points: rows without heights, spikes, slopes, noise."""
    found = _broken_off(heights) or _long_runs(heights)
    steps = [np.abs(np.diff(heights, axis=axis)) for axis in range(heights.ndim)]
    if (spikes := spikes_in(heights, (False,) * heights.ndim)).count > 0:
        found.append(f"{spikes}, far outside their neighbours{DESPIKE}")
    if (count := _far_points(heights)) > 0:
        found.append(
            f"{count} points lie more than {_FAR:g} interquartile ranges from the median height; "
            "mark them as missing by masked()"
        )
    else:
        found += _apart(heights)
    slopes = [_quantile(step, 0.5) / width for step, width in zip(steps, spacing, strict=True)]
    if (slope := max(slopes)) > _STEEPEST:
        found.append(f"a typical slope of {slope:.3g} is unusual; check unit= and size=")
    if (share := _noise(heights)) > _NOISY:
        found.append(
            f"in {share:.0%} of the rows neighbouring heights are unrelated, as random numbers are; check the file"
        )
    elif (rows := noisy_rows(heights)) > 0:
        found.append(
            f"in {rows} rows or columns neighbouring heights are unrelated and far apart, as random numbers are; "
            "check the file"
        )
    return found


def _broken_off(heights: Array) -> list[str]:
    """Return a warning for each edge of a map along which rows hold one number and no heights."""
    if heights.ndim != 2:
        return []
    found = []
    for edge, rows in (("first", heights), ("last", heights[::-1])):
        other = (rows != rows[0, 0]).any(axis=1)  # a missing point also differs
        count = int(np.argmax(other))
        if count > 1:
            found.append(
                f"its {edge} {count} of {len(rows)} rows all hold {rows[0, 0]:g} m, as after an interrupted scan"
            )
    return found


def _long_runs(heights: Array) -> list[str]:
    """Return a warning if one number is repeated far more often than any other, as in a damaged file.

    The search goes along rows and columns, and along rows that are stored from the bottom up.
    """
    orders: tuple[Callable[[Any], Any], ...] = (lambda a: a, lambda a: a.T, lambda a: a[::-1])
    for order in orders[: 2 * heights.ndim - 1]:
        values = order(heights).reshape(-1)
        ends = np.flatnonzero(np.append(values[1:] != values[:-1], True))  # of runs; NaN differs from itself
        lengths = np.diff(ends, prepend=-1)
        longest = int(np.argmax(lengths))
        second = int(np.delete(lengths, longest).max(initial=1))
        if (count := int(lengths[longest])) >= max(_RUN, _LONGER * second):
            first = order(np.arange(heights.size).reshape(heights.shape)).reshape(-1)[
                ends[longest] - count + 1
            ]
            place = ", ".join(str(k) for k in np.unravel_index(first, heights.shape))
            return [
                f"{count} neighbouring points from cell {place} hold {values[ends[longest]]:g} m, as in a "
                "damaged file; write nan there if they were not measured"
            ]
    return []


def _far_points(heights: Array) -> int:
    """Count the points that lie far from all the heights."""
    low, middle, high = (_quantile(heights, q) for q in (0.25, 0.5, 0.75))
    return int(np.count_nonzero(np.abs(heights - middle) > _FAR * (high - low))) if high > low else 0


def _apart(heights: Array) -> list[str]:
    """Return a warning if the lowest or highest number is repeated, and further away than the range of the others."""
    known = heights[~np.isnan(heights)]
    for extreme in (known.min(), known.max()):
        others = known[known != extreme]
        count = known.size - others.size
        low, high = others.min(), others.max()
        if count >= _REPEATED and high > low and min(abs(extreme - low), abs(extreme - high)) > high - low:
            return [
                f"{count} points hold {extreme:g} m, like a mark of missing points, and the others {low:g} to "
                f"{high:g} m; mark them as missing by masked()"
            ]
    return []


def _noise(heights: Array) -> float:
    """Return the share of rows in which two neighbours lie on one side of the median as often as on both.

    Only signs count, because spikes are not noise; row by row, because damage may begin anywhere.
    """
    rows = heights.reshape(-1, heights.shape[-1])
    rows = rows[np.count_nonzero(~np.isnan(rows), axis=1) > _ENOUGH_IN_A_ROW]
    if len(rows) == 0:
        return 0.0
    signs = np.sign(rows - np.nanmedian(rows, axis=1, keepdims=True))
    product = signs[:, 1:] * signs[:, :-1]
    pairs = np.nansum(np.abs(product), axis=1)  # a plateau at the median is no evidence
    unrelated = np.abs(np.nansum(product, axis=1)) < _DEVIATIONS * np.sqrt(pairs)
    return float(np.mean(unrelated & (pairs >= _ENOUGH_IN_A_ROW)))


def _quantile(values: Array, share: float) -> float:
    """Return a quantile of the numbers in a regular subset of `values`; 0 if there is none."""
    chosen = regular_subset(values)
    numbers = chosen[~np.isnan(chosen)]
    if numbers.size == 0:
        return 0.0
    place = int(share * (numbers.size - 1))
    return float(np.partition(numbers, place)[place])
