"""The laws of rough squares at the computed Hurst exponents, and between them; see `rough_square`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import PchipInterpolator

from roughcontact.theory.stiffness_laws.rough_square_table import COLUMNS, TABLES
from roughcontact.validation import Array, require

__all__ = ["LEAST_STIFFNESS", "SquareLaws", "laws_of_cut"]

LEAST_STIFFNESS = 0.035  # k/(E* L) of 20 of 512 x 512 cells, below which single cells dominate
REFERENCE = 0.02  # F/(E* h L) at which the errors of exponent and level are almost uncorrelated


@dataclass(frozen=True, slots=True, eq=False)
class SquareLaws:
    """The values of one cut at the computed Hurst exponents, by name, and between them."""

    columns: Mapping[str, Array]

    def at(self, hurst: Array, name: str) -> Array:
        """Return a column at H, on straight lines between its values."""
        found: Array = np.interp(hurst, self.columns["hurst"], self.columns[name])
        return found

    def exponent(self, hurst: Array) -> Array:
        """Return alpha."""
        alpha: Array = self._smooth("exponent")(hurst)[()]
        return alpha

    def slope(self, hurst: Array) -> Array:
        """Return dalpha/dH."""
        slope: Array = self._smooth("exponent").derivative()(hurst)[()]
        return slope

    def level(self, hurst: Array) -> Array:
        """Return kappa, k/(E* L) at the reference force."""
        kappa: Array = self._smooth("level")(hurst)[()]
        return kappa

    def lowest(self, hurst: Array) -> Array:
        """Return the force F/(E* h L) at which k is the smallest resolved stiffness."""
        found: Array = REFERENCE * (LEAST_STIFFNESS / self.level(hurst)) ** (1 / self.exponent(hurst))
        return found

    def highest(self, hurst: Array) -> Array:
        """Return the highest force F/(E* h L)."""
        found: Array = np.exp(np.interp(hurst, self.columns["hurst"], np.log(self.columns["highest"])))
        return found

    def log_stiffness(self, force: ArrayLike, hurst: Array) -> Array:
        """Return ln k/(E* L) at F/(E* h L)."""
        k: Array = np.log(self.level(hurst)) + self.exponent(hurst) * np.log(np.asarray(force) / REFERENCE)
        return k

    def standard_error(self, force: ArrayLike, hurst: Array) -> Array:
        """Return the standard error of ln k at F/(E* h L)."""
        names = ("exponent_error", "level_error", "correlation")
        of_alpha, of_level, correlation = (self.at(hurst, each) for each in names)
        by_alpha = np.log(np.asarray(force) / REFERENCE) * of_alpha
        error: Array = np.sqrt(of_level**2 + 2 * correlation * of_level * by_alpha + by_alpha**2)
        return error

    def quantiles(self, force: Array, hurst: Array) -> tuple[Array, Array]:
        """Return the 5 and 95 % quantiles over the mean, on straight lines over ln F between the ends of the window."""
        low, high = np.log(self.lowest(hurst)), np.log(self.highest(hurst))
        part = (np.log(force) - low) / (high - low)
        first, last = (
            [self.at(hurst, f"{quantile}_{end}") for quantile in ("low", "high")] for end in ("first", "last")
        )
        ends = [a + (b - a) * part for a, b in zip(first, last, strict=True)]
        return ends[0], ends[1]

    def _smooth(self, name: str) -> PchipInterpolator:
        return PchipInterpolator(self.columns["hurst"], self.columns[name])


@cache
def laws_of_cut(cut: str) -> SquareLaws:
    """Return the laws of a cut; raise an error if there is none of this name."""
    require(cut in TABLES, f"there is no cut {cut!r}; there are {', '.join(TABLES)}", place="cut")
    return SquareLaws(dict(zip(COLUMNS, np.array(TABLES[cut]).T, strict=True)))
