"""Ranges of values of a parameter, with equal differences or equal ratios."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from roughcontact.errors import InputError
from roughcontact.study.checked import Checked
from roughcontact.units import as_text

__all__ = ["Range"]

# Relative to the largest value: -0.5 + 4 * 0.15 must be exactly 0.1, also if the range is extended.
_DIGITS = 12
_MOST = 1_000_000
_HIT = 1e-9  # of a step: tolerance for rounding at the end of the range


_Number = Annotated[float | str, BeforeValidator(as_text)]


class Range(Checked):
    """A range that includes both ends, given by the number of values or by the step between them.

    Parameters
    ----------
    start, stop : float or str
        The ends; text with a unit if the parameter accepts it. A range by steps ends at the last value not beyond
        `stop`.
    count : int, optional
        Number of values.
    step : float or str, optional
        Difference from one value to the next; negative if `stop` is below `start`.
    spacing : "linear" or "log"
        Equal differences or equal ratios.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.study.Range(start=0.2, stop=0.8, step=0.2).values(float)
    (0.2, 0.4, 0.6, 0.8)
    >>> rc.study.Range(start=1, stop=100, count=3, spacing="log").values(float)
    (1.0, 10.0, 100.0)
    """

    start: _Number
    stop: _Number
    count: int | None = Field(default=None, ge=2, le=_MOST)
    step: _Number | None = None
    spacing: Literal["linear", "log"] = "linear"

    @model_validator(mode="after")
    def _one_way(self) -> Range:
        if (self.count is None) == (self.step is None):
            raise InputError("a range has either a count or a step", "give one of them")
        if self.step is not None and self.spacing == "log":
            raise InputError("a range in equal ratios has a count, not a step")
        return self

    def values(self, read: Callable[[Any], Any]) -> tuple[float, ...]:
        """Return the values of the range.

        Parameters
        ----------
        read : function
            Takes an end or the step as written and returns the number.

        Returns
        -------
        tuple of float
            From the start to the stop.

        Raises
        ------
        ValueError
            If the range is empty, or values in equal ratios are not of one sign.
        """
        start, stop = _number(read(self.start)), _number(read(self.stop))
        if self.count is None:
            step = read(self.step) if isinstance(self.step, str) else self.step
            return _by_steps(start, stop, _number(step))
        if start == stop:
            raise InputError(f"it starts and stops at {start:g}", "give the one value under parameters")
        if self.spacing == "log" and not start * stop > 0:
            raise InputError(
                f"equal ratios do not lead from {start:g} to {stop:g}: both ends must be above 0, or both below"
            )
        spaced = np.linspace if self.spacing == "linear" else np.geomspace
        between = spaced(start, stop, self.count)[1:-1]
        return (start, *_rounded(between, each=self.spacing == "log"), stop)


def _number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise InputError(f"{value!r} is not a number, and a range needs numbers", "write a list")
    return float(value)


def _by_steps(start: float, stop: float, step: float) -> tuple[float, ...]:
    if step == 0 or (stop - start) / step < 0:
        raise InputError(
            f"steps of {step:g} do not lead from {start:g} to {stop:g}", "give a step towards the stop"
        )
    steps = (stop - start) / step
    if steps >= _MOST:
        raise InputError(
            f"{steps:.3g} steps of {step:g} are too many", f"give a step above {abs(stop - start) / _MOST:g}"
        )
    count = math.floor(steps + _HIT) + 1
    return _rounded(start + step * np.arange(count))


def _rounded(values: np.typing.NDArray[np.floating[Any]], *, each: bool = False) -> tuple[float, ...]:
    """Return values rounded to twelve digits, relative to `each` or to the largest value."""
    if each or not values.any():
        return tuple(float(f"{value:.{_DIGITS}g}") for value in values)
    decimals = _DIGITS - 1 - math.floor(math.log10(float(np.abs(values).max())))
    return tuple(round(float(value), decimals) + 0.0 for value in values)  # 0.0 makes -0.0 positive
