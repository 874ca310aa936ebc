"""What the thesis says, word for word, what is found here, and whether the two agree."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt
import xarray

from roughcontact_thesis.ruling import Ruling

__all__ = [
    "Kind",
    "Verdict",
    "Verdicts",
    "beside",
    "counted",
    "listed",
    "plus_minus",
    "series",
    "signed",
    "spanned",
]

Kind = Literal["claim", "assumption", "method", "misprint", "theory", "answer"]
"""A claim about rough contacts; an assumption that the thesis states as one; a claim about definitions and methods; a
printed number or formula; a theory of others; or an answer to a question that the thesis asks."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """One claim of the thesis beside what was computed.

    Parameters
    ----------
    claim : str
        What is claimed, in our words.
    quote : str
        What the thesis says, word for word; a formula where it says it by one.
    source : str
        Section, equation or figure of the quote.
    found : str
        What is found here, with its error and what it was found from.
    ruling : Ruling
        The verdict, and how it was reached.
    kind : str

    Examples
    --------
    >>> import roughcontact_thesis
    >>> found = roughcontact_thesis.module("fig41")
    >>> verdict, *_ = roughcontact_thesis.verdicts(found, found.case())
    >>> verdict.source, verdict.word
    ('section A.1.1, fig. 41', 'holds')
    """

    claim: str
    quote: str
    source: str
    found: str
    ruling: Ruling
    kind: Kind = "claim"

    @property
    def word(self) -> str:
        """The verdict in a word or two, with where it holds if it does so in part."""
        return self.ruling.words


Verdicts = Iterator[Verdict]
"""What a figure says, a claim after the other."""


def spanned(values: npt.ArrayLike, form: str) -> str:
    """Return the smallest and the largest of some numbers in words; NaN are none."""
    numbers = np.asarray(values, dtype=np.float64)
    there = numbers[np.isfinite(numbers)]
    return " to ".join(signed(each, form) for each in (there.min(), there.max())) if there.size else "none"


def beside(deviations: npt.ArrayLike) -> str:
    """Return in words how far numbers lie from a law, from parts of it less one: "10% below to 15% above"."""
    numbers = np.asarray(deviations, dtype=np.float64)
    there = numbers[np.isfinite(numbers)]
    if not there.size:
        return "nowhere"
    low, high = sorted((float(there.min()), float(there.max())), key=abs)
    sides = ["below" if each < 0 else "above" for each in (low, high)]
    if sides[0] == sides[1]:
        return f"{abs(low):.0%} to {abs(high):.0%} {sides[0]}"
    return f"{abs(there.min()):.0%} below to {abs(there.max()):.0%} above"


def signed(value: float, form: str) -> str:
    """Return a number in words; one that is rounded to zero has no sign."""
    words = f"{value:{form}}"
    return words if set(words) & set("123456789") else words.lstrip("+-")


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
