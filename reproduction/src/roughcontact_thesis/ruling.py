"""How a claim is judged: deviations, their standard errors and a tolerance that is fixed beforehand."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any, Literal, TypeVar

import numpy as np
import numpy.typing as npt
import xarray

from roughcontact.validation import Array

__all__ = [
    "INSIDE",
    "OUTSIDE",
    "RANGES",
    "VICINITY",
    "Ruling",
    "Word",
    "by_range",
    "exactly",
    "exceeds",
    "in_part",
    "middle",
    "ranged",
    "ruled",
    "ruled_in_middle",
    "undecided",
]

Labelled = TypeVar("Labelled", xarray.DataArray, xarray.Dataset)
Word = Literal["holds", "holds in part", "does not hold", "not decided"]

VICINITY = 0.25
"""What the thesis' "in the vicinity of these limits", H = 0 and H = 2, is taken to be (section 4.4.2)."""
INSIDE, OUTSIDE = 2, 3
"""Standard errors by which a deviation must lie inside or outside of a tolerance: outside more, as one of many
decides there."""
_LOW, _HIGH = VICINITY, 2 - VICINITY
RANGES = {
    "below 0": (-np.inf, -VICINITY),
    f"within {VICINITY:g} of 0": (-VICINITY, _LOW),
    f"{_LOW:g} to {_HIGH:g}": (_LOW, _HIGH),
    f"within {VICINITY:g} of 2": (_HIGH, 2 + VICINITY),
    "above 2": (2 + VICINITY, np.inf),
}
"""Ranges of the Hurst exponent; what lies on a border belongs to the middle one, else to the vicinity."""
_MIDDLE = f"{_LOW:g} to {_HIGH:g}"
_ROUND = 1e-9
_HURST = ("hurst", "line_hurst")
_FORMS = {
    "hurst": "H = {:.2f}",
    "line_hurst": "H = {:.2f}",
    "force": "F = {:.2g}",
    "line_force": "F = {:.2g}",
    "points": "N = {:.0f}",
    "cells": "{:.0f}² cells",
    "poisson_ratio": "nu = {:g}",
    "periodic": "periodic {}",
    "long": "L/{}",
    "waves": "L/{:.0f}",
    "modes": "{:.0f} modes",
}


@dataclass(frozen=True, slots=True)
class Ruling:
    """A verdict, and how it was reached.

    Parameters
    ----------
    word : str
    tolerance : str
        How far from the claim still agrees with it.
    span : str
        For which Hurst exponents it is judged; empty where there are none.
    trigger : str
        The number that decided.
    part : str
        Where it holds, if it does so in part.
    ranges : dict
        Verdict and deviations in each of the `RANGES` of the Hurst exponent that has some.
    """

    word: Word
    tolerance: str
    span: str = ""
    trigger: str = ""
    part: str = ""
    ranges: dict[str, str] = field(default_factory=dict)

    @property
    def words(self) -> str:
        """The verdict in words."""
        return f"{self.word} ({self.part})" if self.part else self.word


def exactly(holds: bool, tolerance: str, trigger: str = "") -> Ruling:
    """Return the ruling on what is computed without a random surface: only its tolerance counts."""
    return Ruling("holds" if holds else "does not hold", tolerance, trigger=trigger)


def in_part(part: str, tolerance: str, trigger: str = "") -> Ruling:
    """Return the ruling on what is computed without a random surface, and holds in some cases."""
    return Ruling("holds in part", tolerance, trigger=trigger, part=part)


def exceeds(value: float, error: float, least: float, form: str, words: str) -> Ruling:
    """Return whether a number lies above a least one by more than three standard errors, or below by as many."""
    away = value - least
    word: Word = "not decided"
    if abs(away) > OUTSIDE * error:
        word = "holds" if away > 0 else "does not hold"
    return Ruling(word, words, trigger=f"{value:{form}} ± {error:{form.replace('+', '')}}")


def undecided(why: str, tolerance: str = "") -> Ruling:
    """Return that nothing here decides."""
    return Ruling("not decided", tolerance, trigger=why)


def middle(values: Labelled) -> Labelled:
    """Return what belongs to Hurst exponents from 0.25 to 1.75, where the thesis expects no deviations."""
    return values.isel(hurst=np.flatnonzero(_of(values["hurst"].to_numpy(), _MIDDLE)))


def ruled(
    deviation: xarray.DataArray | npt.ArrayLike,
    error: xarray.DataArray | npt.ArrayLike,
    tolerance: float,
    form: str = "+.1%",
    *,
    words: str = "",
    above: bool = False,
) -> Ruling:
    """Return whether deviations stay within a tolerance, as far as their standard errors let one say.

    Each deviation d with error s is inside where |d| + 2 s does not exceed the tolerance, outside where |d| - 3 s
    does, and open otherwise. The claim holds if all are inside, does not hold if some are outside and none inside;
    in part, where they are inside, if some are outside; else nothing is decided. Deviations that are NaN say nothing.

    Parameters
    ----------
    deviation, error : DataArray or array
        An error that is NaN is that of a single sample: then nothing is inside and nothing outside. Errors of a
        difference between values that share their samples: at most the sum of both, which is what is to be given.
    tolerance : float
    form : str
        How deviations are written.
    words : str
        The tolerance in words, by default its number.
    above : bool
        Whether only deviations above the claim count against it.
    """
    away = deviation if isinstance(deviation, xarray.DataArray) else xarray.DataArray(np.asarray(deviation))
    errors = error if isinstance(error, xarray.DataArray) else xarray.DataArray(np.asarray(error))
    found = _ruled(away, errors, tolerance, form, words, above)
    return replace(found, ranges=by_range(away, errors, tolerance, form, above=above))


def ruled_in_middle(
    deviation: xarray.DataArray, error: xarray.DataArray, tolerance: float, form: str = "+.1%"
) -> Ruling:
    """Return the ruling on Hurst exponents from 0.25 to 1.75, with what is found in the other ranges."""
    found = _ruled(middle(deviation), middle(error), tolerance, form)
    return replace(found, ranges=by_range(deviation, error, tolerance, form))


def by_range(
    deviation: xarray.DataArray,
    error: xarray.DataArray,
    tolerance: float,
    form: str = "+.1%",
    *,
    above: bool = False,
) -> dict[str, str]:
    """Return verdict and deviations in words for every range of the Hurst exponent that has some."""
    found = _each_range(deviation, error, tolerance, form, above)
    return {name: f"{word}: {numbers}" for name, numbers, word in found}


def ranged(deviation: xarray.DataArray, error: xarray.DataArray, tolerance: float, form: str = "+.1%") -> str:
    """Return the deviations in every range of the Hurst exponent, each with its own verdict, in words."""
    found = _each_range(deviation, error, tolerance, form)
    return "; ".join(f"{numbers} for H {name} ({word})" for name, numbers, word in found)


def _each_range(
    deviation: xarray.DataArray, error: xarray.DataArray, tolerance: float, form: str, above: bool = False
) -> Iterator[tuple[str, str, Word]]:
    """Yield each range of the Hurst exponent with its deviations in words and its verdict."""
    dim = next((name for name in _HURST if name in deviation.dims and name in deviation.coords), None)
    if dim is None:
        return
    error = error.broadcast_like(deviation)
    for name in RANGES:
        inside = {dim: np.flatnonzero(_of(deviation[dim].to_numpy(), name))}
        one = deviation.isel(inside)
        values = one.to_numpy()
        values = values[np.isfinite(values)]
        if values.size:
            ends = dict.fromkeys(f"{each:{form}}" for each in (values.min(), values.max()))
            yield name, " to ".join(ends), _ruled(one, error.isel(inside), tolerance, form, above=above).word


def _ruled(
    away: xarray.DataArray,
    errors: xarray.DataArray,
    tolerance: float,
    form: str,
    words: str = "",
    above: bool = False,
) -> Ruling:
    if not away.dims and errors.dims:
        away = away + 0 * errors
    away, errors = xarray.broadcast(away, errors)
    errors = errors.transpose(*away.dims)
    value, spread = away.to_numpy().ravel().astype(float), errors.to_numpy().ravel().astype(float)
    labels = _labels(away)
    there = np.isfinite(value)
    told = words or (f"{100 * tolerance:g}%" if "%" in form else f"{tolerance:g}")
    span = _span(away)
    if not there.any():
        return Ruling("not decided", told, span, "nothing is resolved")
    value, spread = value[there], spread[there]
    labels = [label for label, kept in zip(labels, there, strict=True) if kept]
    size = value if above else np.abs(value)
    sure, outside = _sides(size, spread, tolerance)
    decisive = size - np.where(outside.any(), OUTSIDE, -INSIDE) * np.nan_to_num(spread)
    if outside.any():
        decisive[~outside] = -np.inf
    elif not sure.all():
        decisive[sure] = -np.inf
    most = int(np.argmax(decisive))
    at = f" at {labels[most]}" if labels[most] else ""
    error_words = (
        f" ± {spread[most]:{form.replace('+', '')}}" if np.isfinite(spread[most]) else ", one sample"
    )
    trigger = f"{value[most]:{form}}{error_words}{at}"
    if sure.all():
        return Ruling("holds", told, span, f"largest: {trigger}")
    if not outside.any():
        return Ruling("not decided", told, span, f"undecided: {trigger}")
    part = _part(away, there, sure)
    if part:
        return Ruling("holds in part", told, span, f"outside elsewhere: {trigger}", part)
    return Ruling("does not hold", told, span, trigger)


def _sides(
    size: Array, spread: Array, tolerance: float
) -> tuple[npt.NDArray[np.bool_], npt.NDArray[np.bool_]]:
    """Return which deviations are inside of a tolerance, and which outside, for all that their errors may hide."""
    hidden = np.where(np.isnan(spread), np.inf, spread)
    # Rounding of what is on the border is no deviation.
    edge = tolerance + _ROUND
    return size + INSIDE * hidden <= edge, size - OUTSIDE * hidden > edge


def _of(hurst: Array, name: str) -> npt.NDArray[np.bool_]:
    """Return which Hurst exponents belong to a range."""
    low, high = RANGES[name]
    near = name.startswith("within")
    edge = _ROUND if near or name == _MIDDLE else -_ROUND
    found = (hurst >= low - edge) & (hurst <= high + edge)
    if near:  # its border with the middle belongs there
        found &= (hurst < _LOW - _ROUND) | (hurst > _HIGH + _ROUND)
    return np.asarray(found)


def _labels(values: xarray.DataArray) -> list[str]:
    """Return which value of what each number belongs to, in words."""
    known = [(dim, values[dim].to_numpy()) for dim in values.dims if dim in values.coords and dim in _FORMS]
    if not known:
        return [""] * values.size
    axes = [list(values.dims).index(dim) for dim, _ in known]
    places = np.unravel_index(np.arange(values.size), values.shape)
    return [
        ", ".join(
            _FORMS[str(dim)].format(each[places[axis][n]])
            for (dim, each), axis in zip(known, axes, strict=True)
        )
        for n in range(values.size)
    ]


def _along(values: xarray.DataArray) -> str | None:
    """Return the dimension of Hurst exponents, or another one that has values."""
    for name in _HURST:
        if name in values.dims:
            return name
    named = [str(dim) for dim in values.dims if dim in values.coords and dim in _FORMS]
    return named[0] if named else None


def _span(values: xarray.DataArray) -> str:
    along = _along(values)
    if along not in _HURST or not values.sizes[along]:
        return ""
    hurst = values[along].to_numpy()
    low, high = float(hurst.min()), float(hurst.max())
    return f"H = {low:.2f}" if low == high else f"{low:.2f} <= H <= {high:.2f}"


def _part(values: xarray.DataArray, there: Any, sure: Any) -> str:
    """Return for which values along a dimension all that is there is inside; as ranges where neighbours are."""
    along = _along(values)
    if along is None:
        return ""
    every = np.ones(values.size, bool)
    every[np.flatnonzero(there)] = sure
    seen = there.reshape(values.shape)
    axis = list(values.dims).index(along)
    others = tuple(n for n in range(values.ndim) if n != axis)
    good = every.reshape(values.shape).all(axis=others) & seen.any(axis=others)
    places = values[along].to_numpy()
    if along not in _HURST:
        return ", ".join(_FORMS[along].format(each) for each in places[good])
    turns = np.flatnonzero(np.diff(np.concatenate([[False], good, [False]]).astype(int)))
    runs = zip(turns[::2], turns[1::2] - 1, strict=True)
    return ", ".join(
        f"H = {places[a]:.2f}" if a == b else f"{places[a]:.2f} <= H <= {places[b]:.2f}" for a, b in runs
    )
