"""The numbers of a contact with their errors, by sources, as a value, a table and a record."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias

from roughcontact.labels.labelled import plain_values
from roughcontact.labels.variables import VARIABLES

__all__ = ["ErrorBudget", "ErrorSource", "QuotedNumber"]

MANY_TIMES = 10  # a value: larger errors are shown as "> 1000 %"
ROUNDING = (
    1e-12  # of a value: smaller errors count as zero, and so do gaps that are smaller relative to the depth
)
SMALLEST = 5e-4  # of a number: smaller corrections are not listed in words
SAMPLED = ("interfacial_stiffness", "contact_area", "mean_gap")  # numbers that pictures show

Kind: TypeAlias = Literal["bias", "standard error", "order of magnitude", "unknown"]
InUnit: TypeAlias = Callable[[str, float], tuple[float, str]]


@dataclass(frozen=True, slots=True)
class ErrorSource:
    """One source of error.

    Attributes
    ----------
    name : str
        Name in words.
    kind : {"bias", "standard error", "order of magnitude", "unknown"}
        A bias is the change of a number if one step is done differently; it has a sign. A standard error is that of a
        mean over patches. An order of magnitude is a standard deviation from few values. The parts of an unknown source
        are NaN.
    how : str
        How the error was estimated, or why it is unknown.
    """

    name: str
    kind: Kind
    how: str

    def __str__(self) -> str:
        """Return the kind and the method of the estimate."""
        return self.how if self.kind == "unknown" else f"{self.kind}: {self.how}"


@dataclass(frozen=True, slots=True)
class QuotedNumber:
    """A number with its error from each source.

    Attributes
    ----------
    name : str
        Name as in a `Curve`.
    value : float
        Value in its SI unit; the mean over several patches. With noise it is corrected if `ErrorBudget.corrections`
        has the name.
    unit : str
        SI unit, ``"N m-1"``.
    parts : tuple of float
        Change of the number, or its standard error, for each source of the budget, in its unit.
    """

    name: str
    value: float
    unit: str
    parts: tuple[float, ...]

    @property
    def error(self) -> float:
        """The square root of the sum of the squares of the parts, in its unit; NaN if a part is unknown."""
        return math.hypot(*self.parts)

    @property
    def relative_error(self) -> float:
        """The error over the value."""
        return self.error / abs(self.value) if self.value else math.nan


@dataclass(frozen=True, slots=True, repr=False)
class ErrorBudget:
    """The numbers of a contact with their errors, by sources; ``budget["interfacial_stiffness"]`` is one number.

    Attributes
    ----------
    numbers : tuple of QuotedNumber
    sources : tuple of ErrorSource
    notes : tuple of str
        Sources that are left out, and the reasons, in sentences.
    bias_of_size : mapping of str to float
        Relative difference between the mean over four quarters of the map and the whole map, for the numbers that do
        not depend on the size of a map; empty if no quarter was pressed. It is neither an error nor a correction.
    corrections : mapping of str to float
        What was added to a number to remove the bias by noise, in its unit, for the numbers that were corrected.
    """

    numbers: tuple[QuotedNumber, ...]
    sources: tuple[ErrorSource, ...]
    notes: tuple[str, ...]
    bias_of_size: Mapping[str, float] = field(default_factory=dict)
    corrections: Mapping[str, float] = field(default_factory=dict)

    def __getitem__(self, name: str) -> QuotedNumber:
        """Return the number of a name; KeyError for a number without an error, such as the largest pressure."""
        for number in self.numbers:
            if number.name == name:
                return number
        names = ", ".join(number.name for number in self.numbers)
        raise KeyError(f"the budget has no error of {name!r}; it has those of {names}")

    def table(
        self, names: Sequence[str] | None = None, in_unit: InUnit | None = None
    ) -> tuple[list[str], list[list[str]]]:
        """Return header and rows of a table: each number with its error, and the part of each source.

        Parameters
        ----------
        names : sequence of str, optional
            Numbers to show; by default all.
        in_unit : function, optional
            ``in_unit(name, value)`` returns the factor from the SI unit and the unit to show; by default SI.

        Returns
        -------
        tuple of list
            Texts: the header, and a row for each number.
        """
        header = ["", "value", "error", "", "", *(source.name for source in self.sources)]
        rows = []
        for number in self.numbers:
            if names is not None and number.name not in names:
                continue
            factor, unit = (1.0, number.unit) if in_unit is None else in_unit(number.name, number.value)
            digits = _decimals(number.error * factor, number.value * factor)
            signs = ("+" if source.kind == "bias" else "" for source in self.sources)
            parts = zip(number.parts, signs, strict=True)
            rows.append(
                [
                    VARIABLES[number.name].label,
                    _text(number.value * factor, digits),
                    f"+- {_text(number.error * factor, digits)}",
                    "" if unit == "1" else unit,
                    _percent(number.relative_error),
                    *(_text(part * factor, digits, sign) for part, sign in parts),
                ]
            )
        return header, rows

    def to_record(self) -> dict[str, Any]:
        """Return the budget as plain values, for JSON.

        Returns
        -------
        dict
            Value, error and parts by the name of each number, with the sources, the bias of size, the corrections and
            the notes.
        """
        keys = [source.name.replace(" ", "_").replace("-", "") for source in self.sources]
        numbers = {
            each.name: {
                "value": plain_values(each.value),
                "error": plain_values(each.error),
                **dict(zip(keys, plain_values(each.parts), strict=True)),
                "unit": each.unit,
            }
            for each in self.numbers
        }
        sources = {
            key: {"kind": source.kind, "how": source.how}
            for key, source in zip(keys, self.sources, strict=True)
        }
        more = {
            key: {name: plain_values(value) for name, value in values.items()}
            for key, values in (("bias_of_size", self.bias_of_size), ("corrections", self.corrections))
        }
        return {**numbers, "sources": sources, **more, "notes": list(self.notes)}

    def facts(self) -> list[tuple[str, str]]:
        """Return a description of each source, the changes with the size of the map, and the corrections, in words.

        Returns
        -------
        list of tuple of str
            Names and sentences.
        """
        facts = [(source.name, str(source)) for source in self.sources]
        if self.bias_of_size:
            each = ", ".join(
                f"{VARIABLES[name].label} by {_percent(bias, '+')}"
                for name, bias in self.bias_of_size.items()
            )
            words = f"the numbers of quarters of the map differ from those of the map by: {each}; not part of the error"
            facts.append(("size of the map", words))
        changes = {name: part / (self[name].value - part) for name, part in self.corrections.items()}
        shown = [
            f"{VARIABLES[name].label} by {_percent(change, '+')}"
            for name, change in changes.items()
            if abs(change) > SMALLEST
        ]
        if shown:
            facts.append(("corrected", f"{', '.join(shown)}, for the bias of noise"))
        return facts

    @property
    def sampling(self) -> str:
        """The difference between maps of the surface, in a line for a picture; empty if the source is left out."""
        for place, source in enumerate(self.sources):
            if source.name == "sampling":
                parts = {number.name: number.parts[place] / number.value for number in self.numbers}
                shown = ", ".join(f"{VARIABLES[name].label} {_percent(parts[name])}" for name in SAMPLED)
                return source.how if source.kind == "unknown" else f"sampling, in order of magnitude: {shown}"
        return ""

    def __repr__(self) -> str:
        """Return the table in SI units, a description of each source, and the notes."""
        header, rows = self.table()
        lines = [header, *rows]
        widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
        table = [
            "  ".join(f"{cell:>{width}}" for cell, width in zip(line, widths, strict=True)).rstrip()
            for line in lines
        ]
        notes = (f"Note: {note}" for note in self.notes)
        return "\n".join((*table, *(f"{name}: {words}" for name, words in self.facts()), *notes))


def _decimals(error: float, value: float) -> int:
    """Return the decimals at which an error has two digits; without an error, those at which the value has four."""
    known = math.isfinite(error) and error > abs(value) * ROUNDING
    size = min(error, abs(value) or error) if known else abs(value)
    if not (math.isfinite(size) and size > 0):
        return 3
    return (1 if known else 3) - math.floor(math.log10(size))


def _text(value: float, decimals: int, sign: str = "") -> str:
    """Return a number with `decimals` decimals; as a power of ten if it is very small or large."""
    if not math.isfinite(value):
        return "infinite" if math.isinf(value) else "unknown"
    value = round(value, decimals) + 0.0  # no negative zero
    if -2 <= decimals <= 5:
        return f"{value:{sign}.{max(0, decimals)}f}"
    digits = decimals + math.floor(math.log10(abs(value))) if value else 0
    return f"{value:{sign}.{max(0, digits)}e}"


def _percent(part: float, sign: str = "") -> str:
    """Return a relative error with two digits, or a bias if `sign` is "+"."""
    if not math.isfinite(part):
        return "unknown"
    if part > MANY_TIMES:
        return f"> {100 * MANY_TIMES:.0f} %"
    return f"{100 * part:{sign}.{0 if abs(part) >= 0.0995 else 1}f} %"
