"""Exponent and stiffness of rough squares as formulas of the Hurst exponent, fitted to E1; see `law.py`.

Run alone it prints the table of `roughcontact.theory.rough_square`: python reproduction/benchmarks/law_formula.py.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from law_ensembles import FOLDER, error, read, resampled, value
from law_tables import MIDDLE, Table, curves, e1_laws, load_at, percent, resolved, told
from scipy.optimize import least_squares
from scipy.stats import chi2

from roughcontact.theory.stiffness_laws import pohrt_popov, rough_square
from roughcontact.validation import Array

NAMES = ("a", "b", "c", "p", "q", "r")
START = (1 / 3, 0.4, 0.9, 0.07, 0.1, 1.2)


def exponent(hurst: Array, a: float, b: float, c: float) -> Array:
    """Return alpha."""
    return a + b / (1 + (hurst / c) ** 2)


def log_level(hurst: Array, p: float, q: float, r: float) -> Array:
    """Return ln k/(E* L) at the force `MIDDLE`."""
    return np.log(np.maximum(p + q * (1 - np.exp(-((hurst / r) ** 2))), 1e-9))


@dataclass(frozen=True)
class Fitted:
    """Coefficients, and how well the formulas hold.

    Parameters
    ----------
    found : array, shape (6,)
        a, b, c of alpha, and p, q, r of kappa.
    covariance : array, shape (6, 6)
        Of their errors, by drawing surfaces again.
    squares : tuple of float
        chi squared of alpha and of ln kappa, over their covariance along H.
    off : array, shape (2, hurst)
        What was computed less the formula, in standard errors of the former.
    """

    found: Array
    covariance: Array
    squares: tuple[float, ...]
    off: Array

    def likely(self) -> list[float]:
        """Return how often true formulas would lie off by as much, of both quantities."""
        return [float(chi2.sf(each, self.off.shape[1] - len(NAMES) // 2)) for each in self.squares]


def fitted(laws: xarray.Dataset) -> Fitted:
    """Fit both formulas by least squares over the covariance along H, which phases of all H share."""
    hurst, samples = laws["hurst"].to_numpy(), laws.attrs["samples"]
    more = samples / (samples - 1)
    tables = laws["alpha_mean"].to_numpy(), np.log(laws["k_mean"].to_numpy())
    every, squares, off = [], [], []
    for form, table, start in zip((exponent, log_level), tables, (START[:3], START[3:]), strict=True):
        covariance = np.cov(table[1:].T) * more
        # The inverse of a covariance from so many samples is too large by as much (Hartlap and others 2007).
        weights = np.linalg.inv(covariance) * (samples - hurst.size - 2) / (samples - 1)
        root = np.linalg.cholesky(weights).T
        lines = np.array([_fit(form, hurst, line, root, start) for line in table])
        misfit = table[0] - form(hurst, *lines[0])
        every.append(lines)
        squares.append(float(((root @ misfit) ** 2).sum()))
        off.append(misfit / np.sqrt(np.diag(covariance)))
    both = np.concatenate(every, axis=1)
    return Fitted(both[0], np.cov(both[1:].T) * more, tuple(squares), np.array(off))


def _fit(form: Any, hurst: Array, line: Array, root: Array, start: tuple[float, ...]) -> Array:
    return least_squares(lambda given: root @ (line - form(hurst, *given)), start, xtol=1e-12, ftol=1e-12).x


def formula(folder: Path = FOLDER) -> dict[str, Table | str]:
    """Return the formulas in words, and a table of what they give."""
    ensemble = read("e1-surfaces", folder)
    if ensemble is None:
        return {}
    laws = e1_laws(ensemble)
    hurst, samples = laws["hurst"].to_numpy(), laws.attrs["samples"]
    if samples < hurst.size + 3:  # fewer have no covariance to be inverted
        return {}
    found = fitted(laws)
    errors = np.sqrt(np.diag(found.covariance))
    misfit = value(laws["alpha_mean"]).to_numpy() - exponent(hurst, *found.found[:3])
    parts = [
        f"{name} = {told(one, error, 4 if error < 1e-2 else 3)}"
        for name, one, error in zip(NAMES, found.found, errors, strict=True)
    ]
    squares = [
        f"{each:.0f} for {words} (probability of a larger value by chance: {100 * chance:.1f} %)"
        for each, words, chance in zip(found.squares, ("alpha", "ln kappa"), found.likely(), strict=True)
    ]
    words = (
        f"alpha = a + b/(1 + (H/c)²) and kappa = p + q (1 - exp(-(H/r)²)), with {', '.join(parts)}, differ from "
        f"the table by at most {abs(found.off[0]).max():.1f} and {abs(found.off[1]).max():.1f} standard errors "
        f"({abs(misfit).max():.3f} in alpha). Mean curves differ from this formula by {within(ensemble, found)} in the "
        "window. The formula is an estimate: with the covariance over H, chi squared is "
        f"{' and '.join(squares)}, with {hurst.size - 3} degrees of freedom."
    )
    return {
        "formula": words,
        "formula-scatter": scattered(ensemble),
        "formula-values": values(hurst),
    }


def values(hurst: Array) -> tuple[list[str], list[list[str]]]:
    """Return what the law of the library gives at every Hurst exponent."""
    body = []
    for h in hurst:
        alpha, error = float(rough_square.exponent(h)), float(rough_square.exponent_error(h))
        kappa = float(rough_square.stiffness(MIDDLE, h, 1.0, 1.0, 1.0))
        relative = float(rough_square.relative_error(MIDDLE, h, 1.0, 1.0, 1.0))
        ratio = kappa / float(pohrt_popov.stiffness(MIDDLE, min(h, pohrt_popov.SMOOTH), 1.0, 1.0, 1.0))
        zeta = told(float(rough_square.prefactor(h)), float(rough_square.prefactor_error(h)), 2)
        line = [told(alpha, error), f"{1 / (h + 1):.3f}", told(kappa, kappa * relative, 4), zeta]
        body.append([f"{h:g}", *line, percent(ratio - 1, ratio * relative)])
    head = ["H", "alpha", "1/(H + 1)", "kappa", "zeta", f"kappa over the thesis' law at {MIDDLE:g}"]
    return head, body


def within(ensemble: xarray.Dataset, found: Fitted) -> str:
    """Return between which limits mean curves lie beside the formula, in their windows."""
    off = beside(ensemble, found.found)
    return f"{100 * float(off.min()):+.1f} to {100 * float(off.max()):+.1f} %"


def beside(ensemble: xarray.Dataset, coefficients: Array) -> xarray.DataArray:
    """Return mean curves over the formula, less one, in their windows."""
    force, stiffness, _ = curves(ensemble)
    mean = resampled(stiffness)
    hurst = ensemble["hurst"]
    law = np.exp(log_level(hurst, *coefficients[3:])) * (force / MIDDLE) ** exponent(hurst, *coefficients[:3])
    return (value(mean) / law - 1).where(resolved(ensemble, mean))


def scattered(ensemble: xarray.Dataset) -> str:
    """Return how far single surfaces scatter about the mean, at the force that is nearest to `MIDDLE`."""
    force, stiffness, _ = curves(ensemble)
    load = load_at(force, MIDDLE)
    one = stiffness.isel(load=load)
    share = 100 * one.std("sample", ddof=1) / one.mean("sample")
    return (
        f"Single surfaces scatter by {float(share.min()):.0f} to {float(share.max()):.0f} % about the mean at "
        f"{float(force[load]):.2g} E* h L, most at H = {float(share.idxmax('hurst')):g}."
    )


def table(laws: xarray.Dataset) -> list[tuple[str, ...]]:
    """Return H, alpha with its error, kappa with its relative one, and their correlation, as digits."""
    samples = laws.attrs["samples"]
    alpha, level = laws["alpha_mean"], np.log(laws["k_mean"])
    rows = []
    for place, h in enumerate(laws["hurst"].to_numpy()):
        one, two = (each.isel(hurst=place) for each in (alpha, level))
        correlation = float(np.corrcoef(one[1:], two[1:])[0, 1])
        rows.append(
            (
                f"{h:g}",
                f"{float(value(one)):.5f}",
                f"{float(error(one, samples)):.5f}",
                f"{float(np.exp(value(two))):.6f}",
                f"{float(error(two, samples)):.5f}",
                f"{correlation:.2f}",
            )
        )
    return rows


if __name__ == "__main__":
    surfaces = read("e1-surfaces")
    if surfaces is not None:
        print(*(f"    ({', '.join(row)})," for row in table(e1_laws(surfaces))), sep="\n")
