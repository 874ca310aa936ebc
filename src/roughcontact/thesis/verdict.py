"""What the thesis says in numbers, what is found here, and whether the two agree."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import xarray

__all__ = ["Verdict", "Verdicts", "counted", "judged", "listed", "plus_minus", "series", "spanned"]


@dataclass(frozen=True, slots=True)
class Verdict:
    """One claim of the thesis beside what was computed.

    Parameters
    ----------
    claim : str
        What is claimed, in words.
    thesis : str
        The number in the text.
    found : str
        The number found here, with its error and what it was found from.
    holds : bool or None
        None where the text states too little to say so.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.thesis.Verdict("the stiffness saturates", "1.1419", "1.1518", False).word
    'does not hold'
    """

    claim: str
    thesis: str
    found: str
    holds: bool | None

    @property
    def word(self) -> str:
        """The verdict in a word or two."""
        return {True: "holds", False: "does not hold", None: "open"}[self.holds]


Verdicts = Iterator[Verdict]
"""What a figure says, a claim after the other."""


def judged(deviation: npt.ArrayLike, error: npt.ArrayLike, tolerance: float) -> bool | None:
    """Return whether all deviations stay within a tolerance, as far as their standard errors let one say.

    None where one is outside, but by less than three standard errors, and where there is none. Deviations that are
    NaN say nothing.
    """
    away, errors = np.broadcast_arrays(np.abs(np.asarray(deviation, dtype=np.float64)), np.nan_to_num(error))
    if not np.isfinite(away).any():
        return None
    if not (away > tolerance).any():
        return True
    return False if (away > tolerance + 3 * errors).any() else None


def spanned(values: npt.ArrayLike, form: str) -> str:
    """Return the smallest and the largest of some numbers in words; NaN are none."""
    numbers = np.asarray(values, dtype=np.float64)
    there = numbers[np.isfinite(numbers)]
    return f"{there.min():{form}} to {there.max():{form}}" if there.size else "none"


def series(values: npt.ArrayLike, form: str = ".3f", between: str = ", ") -> str:
    """Return numbers in words, one after the other."""
    return between.join(f"{float(value):{form}}" for value in np.asarray(values, dtype=np.float64))


def plus_minus(averages: xarray.Dataset, name: str, form: str = ".2f") -> str:
    """Return a mean with its standard error in words; of one sample the mean alone."""
    value, error = float(averages[name]), float(averages[f"{name}_error"])
    spread = "" if math.isnan(error) else f" ± {error:{form.replace('+', '')}}"
    return f"{value:{form}}{spread}"


def listed(
    averages: xarray.Dataset, name: str, along: str, form: str = ".2f", words: str = "H = {:g}"
) -> str:
    """Return the means of a variable with their errors in words, and for which value along a dimension each is."""
    each = ((value, averages.sel({along: value})) for value in averages[along].values)
    return ", ".join(f"{plus_minus(one, name, form)} at {words.format(value)}" for value, one in each)


def counted(averages: xarray.Dataset, what: str = "samples") -> str:
    """Return how many samples of how many cells averages are from, in words."""
    return f"{averages.attrs['surfaces']} {what} of {averages.attrs['cells']}² cells"
