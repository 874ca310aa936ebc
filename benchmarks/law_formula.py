"""Exponent and stiffness of rough squares as formulas of the Hurst exponent, fitted to E1; see `law.py`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray
from law_ensembles import FOLDER, read, resampled, value
from law_tables import MIDDLE, curves, e1_laws, load_at, markdown, percent, resolved, told
from scipy.optimize import curve_fit

from roughcontact.validation import Array

Form = Callable[..., Array]


def exponent(hurst: Array, a: float, b: float) -> Array:
    """Return alpha: 1/3, that of one smooth crest, for large H."""
    return 1 / 3 + a / (1 + (hurst / b) ** 2)


def level(hurst: Array, c: float, d: float, e: float) -> Array:
    """Return k/(E* L) at the force `MIDDLE`."""
    return c + d / (1 + (e / hurst) ** 2)


@dataclass(frozen=True)
class Fitted:
    """Coefficients with their standard errors, and those of the formula's values.

    Parameters
    ----------
    found, errors : array, shape (coefficients,)
    values, value_errors : array, shape (hurst,)
        Of the formula.
    off : array, shape (hurst,)
        What was computed less the formula, in standard errors of the former.
    """

    found: Array
    errors: Array
    values: Array
    value_errors: Array
    off: Array


def fitted(form: Form, start: tuple[float, ...], hurst: Array, replicates: Array, samples: int) -> Fitted:
    """Fit a formula to every replicate, each Hurst exponent weighted by its error: what is shared counts once."""
    more = (samples / (samples - 1)) ** 0.5
    spread = replicates[1:].std(axis=0, ddof=1) * more
    every = np.array([curve_fit(form, hurst, line, start, spread, maxfev=20_000)[0] for line in replicates])
    values = np.array([form(hurst, *each) for each in every])
    errors, value_errors = (each[1:].std(axis=0, ddof=1) * more for each in (every, values))
    return Fitted(every[0], errors, values[0], value_errors, (replicates[0] - values[0]) / spread)


def formula(folder: Path = FOLDER) -> dict[str, str]:
    """Return the formulas in words, and a table of what they give."""
    ensemble = read("e1-surfaces", folder)
    if ensemble is None:
        return {}
    laws = e1_laws(ensemble)
    hurst, samples = laws["hurst"].to_numpy(), laws.attrs["samples"]
    if samples < 2:
        return {}
    alpha = fitted(exponent, (0.4, 0.8), hurst, laws["alpha_mean"].to_numpy(), samples)
    # Logarithms: errors are relative.
    k = fitted(_log_level, (0.07, 0.1, 1.0), hurst, np.log(laws["k_mean"].to_numpy()), samples)
    a, b = (told(*pair) for pair in zip(alpha.found, alpha.errors, strict=True))
    c, d, e = (told(*pair, digits) for *pair, digits in zip(k.found, k.errors, (4, 4, 3), strict=True))
    words = (
        f"k/(E\\* L) = kappa (F/({MIDDLE:g} E\\* h L))^alpha, alpha = 1/3 + a/(1 + (H/b)²), kappa = c + d/(1 + "
        f"(e/H)²), with a = {a}, b = {b}, c = {c}, d = {d}, e = {e}; zeta = kappa {MIDDLE:g}^-alpha. For H from "
        f"{hurst[0]:g} to {hurst[-1]:g}, forces from where 20 cells of 512² carry to 0.07 E\\* h L. Both lie at most "
        f"{abs(alpha.off).max():.1f} (alpha) and {abs(k.off).max():.1f} (kappa) standard errors beside what "
        f"was computed, and mean curves {within(ensemble, alpha.values, np.exp(k.values))} beside the formula at any "
        "force of the window."
    )
    body = [
        [
            f"{h:g}",
            told(one, spread),
            f"{1 / (h + 1):.3f}",
            told(np.exp(y), np.exp(y) * r, 4),
            percent(*_law(h, y, r)),
        ]
        for h, one, spread, y, r in zip(
            hurst, alpha.values, alpha.value_errors, k.values, k.value_errors, strict=True
        )
    ]
    head = ["H", "alpha", "1/(H + 1)", "kappa", f"kappa over the thesis' law at {MIDDLE:g}"]
    return {
        "formula": words,
        "formula-scatter": scattered(ensemble),
        "formula-values": markdown((head, body)),
    }


def within(ensemble: xarray.Dataset, alpha: Array, kappa: Array) -> str:
    """Return between which limits mean curves lie beside the formula, in their windows."""
    force, stiffness, _ = curves(ensemble)
    mean = resampled(stiffness)
    law = (force / MIDDLE) ** xarray.DataArray(alpha, dims="hurst") * xarray.DataArray(kappa, dims="hurst")
    off = (value(mean) / law - 1).where(resolved(ensemble, mean))
    return f"{100 * float(off.min()):+.1f} to {100 * float(off.max()):+.1f} %"


def scattered(ensemble: xarray.Dataset) -> str:
    """Return how far single surfaces scatter about the mean, at the force that is nearest to `MIDDLE`."""
    force, stiffness, _ = curves(ensemble)
    load = load_at(force, MIDDLE)
    one = stiffness.isel(load=load)
    share = 100 * one.std("sample", ddof=1) / one.mean("sample")
    return (
        f"Single surfaces scatter by {float(share.min()):.0f} to {float(share.max()):.0f} % about the mean at "
        f"{float(force[load]):.2g} E\\* h L, most at H = {float(share.idxmax('hurst')):g}."
    )


def _log_level(hurst: Array, c: float, d: float, e: float) -> Array:
    return np.log(np.maximum(level(hurst, c, d, e), 1e-9))


def _law(hurst: float, log_level: float, relative: float) -> tuple[float, float]:
    """Return kappa over that of the thesis' law, less one, with its error."""
    ratio = float(np.exp(log_level) / (1.7 / (hurst + 1) * MIDDLE ** (1 / (hurst + 1))))
    return ratio - 1, ratio * relative
