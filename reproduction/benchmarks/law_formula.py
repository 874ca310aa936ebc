"""Exponent and stiffness of rough squares as formulas of the Hurst exponent, fitted to E8; see `law.py`.

Run alone it writes the table of `roughcontact.theory.rough_square`: python reproduction/benchmarks/law_formula.py.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from law_crest import by_cut, laws_of, table
from law_ensembles import FOLDER, ROOT, Values, read, value
from law_tables import MIDDLE, Table, told
from scipy.optimize import least_squares
from scipy.stats import chi2

from roughcontact.theory.stiffness_laws import rough_square
from roughcontact.validation import Array

NAMES = ("a", "b", "c", "p", "q", "r")
START = (1 / 3, 0.4, 0.9, 0.07, 0.1, 1.2)
LIBRARY = ROOT / "src" / "roughcontact" / "theory" / "stiffness_laws" / "rough_square_table.py"
MODULE = '''"""The law of rough squares as a table, for each cut and Hurst exponent; see `rough_square`.

H; the highest F/(E* h L); alpha and its standard error; kappa and its relative one; the correlation of both errors; the
largest misfit of the power law; the 5 and 95 % quantiles of single surfaces over the mean, at the first and the last
load; the standard deviation of the exponents of single surfaces.
Written by `python reproduction/benchmarks/law_formula.py`.
"""

from __future__ import annotations

from collections.abc import Mapping

__all__ = ["COLUMNS", "TABLES"]

COLUMNS = (
    *("hurst", "highest", "exponent", "exponent_error", "level", "level_error", "correlation", "misfit"),
    *("low_first", "high_first", "low_last", "high_last", "scatter"),
)
# fmt: off
TABLES: Mapping[str, tuple[tuple[float, ...], ...]] = {{
{tables}}}
'''


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


def fitted(hurst: Array, alpha: Values, level: Values) -> Fitted:
    """Fit both formulas by least squares over the covariance along H, which phases of all H share."""
    samples = alpha.attrs["samples"]
    more = samples / (samples - 1)
    every, squares, off = [], [], []
    tables = alpha.to_numpy(), np.log(level.to_numpy())
    for form, lines_of, start in zip((exponent, log_level), tables, (START[:3], START[3:]), strict=True):
        covariance = np.cov(lines_of[1:].T) * more
        # The inverse of a covariance from so many samples is too large by as much (Hartlap and others 2007).
        weights = np.linalg.inv(covariance) * (samples - hurst.size - 2) / (samples - 1)
        root = np.linalg.cholesky(weights).T
        lines = np.array([_fit(form, hurst, line, root, start) for line in lines_of])
        misfit = lines_of[0] - form(hurst, *lines[0])
        every.append(lines)
        squares.append(float(((root @ misfit) ** 2).sum()))
        off.append(misfit / np.sqrt(np.diag(covariance)))
    both = np.concatenate(every, axis=1)
    return Fitted(both[0], np.cov(both[1:].T) * more, tuple(squares), np.array(off))


def _fit(form: Any, hurst: Array, line: Array, root: Array, start: tuple[float, ...]) -> Array:
    return least_squares(lambda given: root @ (line - form(hurst, *given)), start, xtol=1e-12, ftol=1e-12).x


def formula(folder: Path = FOLDER) -> dict[str, Table | str]:
    """Return the formulas in words, and a table of what the library gives."""
    ensemble = read("e8-cut", folder)
    if (
        ensemble is None or ensemble.sizes["sample"] < ensemble.sizes["hurst"] + 3
    ):  # no covariance to be inverted
        return {}
    one = by_cut(ensemble)["interior"]
    alpha, level = (each.assign_attrs(samples=one.sizes["sample"]) for each in laws_of(one))
    hurst = one["hurst"].to_numpy()
    found = fitted(hurst, alpha, level)
    errors = np.sqrt(np.diag(found.covariance))
    misfit = value(alpha).to_numpy() - exponent(hurst, *found.found[:3])
    parts = [
        f"{name} = {told(number, error, 4 if error < 1e-2 else 3)}"
        for name, number, error in zip(NAMES, found.found, errors, strict=True)
    ]
    squares = [
        f"{each:.0f} for {words} (probability of a larger value by chance: {100 * chance:.1f} %)"
        for each, words, chance in zip(found.squares, ("alpha", "ln kappa"), found.likely(), strict=True)
    ]
    law = np.exp(log_level(one["hurst"], *found.found[3:]))
    law = law * (one["dimensionless_force"] / MIDDLE) ** exponent(one["hurst"], *found.found[:3])
    off = 100 * (value(one["mean"]) / law - 1).where(one["inside"])
    words = (
        f"alpha = a + b/(1 + (H/c)²) and kappa = p + q (1 - exp(-(H/r)²)), with {', '.join(parts)}, differ from "
        f"the interior values by at most {abs(found.off[0]).max():.1f} and {abs(found.off[1]).max():.1f} standard "
        f"errors ({abs(misfit).max():.3f} in alpha). Mean curves differ from it by {float(off.min()):+.1f} to "
        f"{float(off.max()):+.1f} % in the window. The formula is an estimate: with the covariance over H, chi squared "
        f"is {' and '.join(squares)}, with {hurst.size - 3} degrees of freedom."
    )
    return {"formula": words, "formula-values": values(hurst)}


def values(hurst: Array) -> Table:
    """Return what the law of the library gives at every Hurst exponent."""
    body = []
    for h in hurst:
        line = [f"{h:g}", f"{1 / (h + 1):.3f}"]
        for cut in ("interior", "period", "patch"):
            alpha = float(rough_square.exponent(h, cut=cut))
            error = float(rough_square.exponent_error(h, cut=cut))
            low = min(MIDDLE, float(rough_square.law(h, 1.0, 1.0, 1.0, cut=cut).domain[1]))
            at = (low, h, 1.0, 1.0, 1.0)
            k, relative = (
                float(each(*at, cut=cut)) for each in (rough_square.stiffness, rough_square.relative_error)
            )
            kappa = k * (MIDDLE / low) ** alpha
            line += [told(alpha, error), told(kappa, kappa * relative, 4)]
            if cut == "interior":
                ends = [float(each) / k - 1 for each in rough_square.single_range(*at, cut=cut)]
                line.append(f"{100 * ends[0]:+.0f} to {100 * ends[1]:+.0f} %")
        body.append(line)
    head = ["H", "1/(H + 1)", "alpha, interior", "kappa, interior", "single surfaces, interior"]
    return [*head, "alpha, period", "kappa, period", "alpha, patch", "kappa, patch"], body


def module(ensemble: xarray.Dataset) -> str:
    """Return the module of the library that holds the table."""
    rows = {cut: "".join(f"        {row},\n" for row in found) for cut, found in table(ensemble).items()}
    return MODULE.format(tables="".join(f'    "{cut}": (\n{each}    ),\n' for cut, each in rows.items()))


if __name__ == "__main__":
    surfaces = read("e8-cut")
    if surfaces is not None:
        LIBRARY.write_text(module(surfaces), encoding="utf-8", newline="\n")
