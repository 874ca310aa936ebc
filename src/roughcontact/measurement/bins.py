"""Signals averaged over common bins of wavenumber, as logarithms with their variances."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.special import digamma, polygamma

from roughcontact.measurement.signal import Signal
from roughcontact.validation import Array

__all__ = ["Binned", "averaged", "binned", "slopes"]

_REACH = 0.25  # decades over which the exponent of a spectrum is averaged


class Binned(NamedTuple):
    """Values of each map (rows) in each bin (columns), NaN where a map has no reliable wave.

    `log` is ln C, `variance` its variance by the finite number of waves, `blur` the standard deviation by the
    instrument, `ratio` the noise of one map over the signal.
    """

    log: Array
    variance: Array
    blur: Array
    ratio: Array


def binned(
    signals: Sequence[Signal], bands: Sequence[tuple[float, float]], centres: Array, exponents: Array
) -> Binned:
    """Return the signals at the centres of bins that are evenly spaced in ln q.

    Each wave counts at the centre of its bin by the local power law, and the mean of a logarithm is corrected for its
    number of waves, f: <ln C> = ln <C> + psi(f) - ln f. The window's kernel is removed: its mean over the local law, by
    Gauss' and Hermite's rule of three points an axis.

    Parameters
    ----------
    signals : sequence of Signal
    bands : sequence of tuple of float
        Shortest and longest reliable wavelength of each [m].
    centres : array, shape (n,)
        Wavenumbers [rad/m].
    exponents : array, shape (n,)
        Local exponents a of ``C ~ q^-a``.
    """
    rows = [_one(signal, band, centres, exponents) for signal, band in zip(signals, bands, strict=True)]
    return Binned(*(np.array(column) for column in zip(*rows, strict=True)))


def _one(signal: Signal, band: tuple[float, float], centres: Array, exponents: Array) -> tuple[Array, ...]:
    q = signal.spectrum.wavenumber
    width = math.log(centres[1] / centres[0])
    index = np.floor(np.log(q / centres[0]) / width + 0.5 + 1e-9).astype(np.int64)
    wave = 2 * math.pi / q
    inside = (wave >= band[0] * (1 - 1e-9)) & (wave <= band[1] * (1 + 1e-9))
    inside &= (index >= 0) & (index < centres.size)
    index, q = index[inside], q[inside]
    weight = signal.spectrum.freedom[inside]
    number = np.bincount(index, weight, minlength=centres.size)

    def mean(values: Array) -> Array:
        sums = np.bincount(index, weight * values[inside], minlength=centres.size)
        return np.where(number > 0, sums, math.nan) / np.maximum(number, 1e-300)

    law = np.ones(inside.size)
    law[inside] = (q / centres[index]) ** exponents[index]
    density = mean(signal.density * law)
    ratio = signal.repeats * mean(signal.noise / signal.response * law) / density
    step = np.minimum(np.sqrt(3 * signal.spectrum.smear) / centres, 0.5)  # at most 1/3 in a band
    kernel = (4 + (1 - step) ** -exponents + (1 + step) ** -exponents) / 6
    if signal.spectrum.kind == "C2D":
        kernel *= (2 + (1 + step**2) ** (-exponents / 2)) / 3
    there = density > 0
    freedom = signal.freedom(np.where(there, ratio, 1.0), np.where(number > 0, number, 1.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        log = np.log(np.where(there, density, math.nan) / kernel) - digamma(freedom) + np.log(freedom)
    variance = np.where(there, polygamma(1, freedom), math.nan)
    return (
        log,
        variance,
        mean(signal.log_blur),
        np.where(there, ratio, np.where(number > 0, math.inf, math.nan)),
    )


def averaged(values: Array, weights: Array) -> tuple[Array, Array]:
    """Return the weighted mean over maps in each bin, without missing values, and the sum of the weights."""
    weights = np.where(np.isnan(values), 0.0, weights)
    total = weights.sum(axis=0)
    sums = (weights * np.nan_to_num(values)).sum(axis=0)
    return np.where(total > 0, sums, math.nan) / np.maximum(total, 1e-300), total


def slopes(found: Binned, centres: Array) -> Array:
    """Return the exponent a of ``C ~ q^-a`` at each bin: a straight line through its neighbours, never negative."""
    mean, weight = averaged(found.log, 1 / np.nan_to_num(found.variance, nan=math.inf))
    x, y = np.log(centres), np.nan_to_num(mean)
    near = np.exp(-0.5 * ((x[:, None] - x) / (_REACH * math.log(10))) ** 2) * np.minimum(weight, 1e3)
    total = np.maximum(near.sum(axis=1), 1e-300)
    at = near @ x / total
    spread = near @ x**2 / total - at**2
    along = (near @ (x * y) / total - at * (near @ y / total)) / np.maximum(spread, 1e-12)
    return np.asarray(np.maximum(-along, 0.0))
