"""Whittle's likelihood of a power law: the power of each wave is exponentially distributed about the spectrum."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact.surface.analysis.power import PowerSpectrum
from roughcontact.validation import Array

__all__ = ["Slope", "likeliest", "mean_level", "slope_error", "smearing"]

# Trial laws fall, at most as fast as the steepest of the generator, H = 3, or as the leakage of a window.
STEEPEST = 8.0


@dataclass(frozen=True, slots=True)
class Slope:
    """The power law of maximum likelihood over given bins."""

    exponent: float
    level: float  # ln density at x = 0
    cost: float  # negative log-likelihood


def smearing(exponent: float, band: PowerSpectrum, inside: slice) -> Array:
    """Return the relative increase of a power law by the window: half the moment of its kernel times C''/C."""
    order = exponent**2 if band.kind == "C2D" else exponent * (exponent + 1)
    return np.asarray(0.5 * band.smear * order / band.wavenumber[inside] ** 2)


def likeliest(x: Array, band: PowerSpectrum, inside: slice) -> Slope:
    """Return the power law exp(level - exponent x) of the greatest likelihood in the bins `inside`.

    The cost ``sum freedom (ln m + P/m)`` with the best level inserted is convex in the exponent.
    """
    freedom, density = band.freedom[inside], band.density[inside]
    if not density.any():
        return mean_level(band, inside)  # no power: no slope
    total, mean_x = float(freedom.sum()), float(np.average(x, weights=freedom))
    exponent, lift = 2.0, np.zeros(x.shape)
    for _ in range(60):
        lift = smearing(exponent, band, inside)
        logs = np.full(x.shape, -np.inf)
        np.log(freedom * density / (1 + lift), out=logs, where=density > 0)
        logs += exponent * x
        highest = float(logs.max())
        weight = np.exp(logs - highest)
        weight /= weight.sum()
        centre = float(weight @ x)
        spread = float(weight @ (x - centre) ** 2)
        step = (mean_x - centre) / max(spread, 1e-12)
        # Far from the minimum a single bin may determine the curvature.
        step = min(max(step, -0.5), 0.5)
        last, exponent = exponent, min(max(exponent + step, 0.0), STEEPEST)
        if abs(exponent - last) < 1e-10:
            break
    norm = highest + math.log(np.exp(logs - highest).sum())
    level = norm - math.log(total)
    cost = total * level - exponent * total * mean_x + float(freedom @ np.log1p(lift)) + total
    return Slope(exponent, level, cost)


def mean_level(band: PowerSpectrum, inside: slice) -> Slope:
    """Return the level of maximum likelihood over the bins `inside`: a law without slope."""
    freedom = band.freedom[inside]
    total = float(freedom.sum())
    level = math.log(max(float(freedom @ band.density[inside]) / total, 1e-300))
    return Slope(0.0, level, total * (level + 1))


def slope_error(x: Array, bend: float, exponent: float, freedom: Array) -> float:
    """Return the standard error of the exponent, from the expected curvature of the likelihood."""
    bent = np.maximum(x, bend)
    columns = [np.ones(x.shape), -bent + bent.mean()]
    if math.isfinite(bend):
        columns.append(np.where(x < bend, -exponent, 0.0))  # d ln C2D / d ln bend
    gradient = np.stack(columns, axis=1)
    information = gradient.T @ (freedom[:, None] * gradient)
    return math.sqrt(float(np.linalg.pinv(information)[1, 1]))
