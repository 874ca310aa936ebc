"""What a reader of an error budget should know where one source is nearly all of an error, in sentences."""

from __future__ import annotations

from collections.abc import Sequence
from types import MappingProxyType

from roughcontact.evaluation.error_budget import ErrorSource, QuotedNumber
from roughcontact.labels.variables import VARIABLES

__all__ = ["notes_on_sources"]

ALL = 0.9  # of an error, from one source
LARGE = 0.1  # of a number: an error that is worth a sentence
REMEDIES = MappingProxyType(
    {
        "grid": "The cells are too large for this load: take a finer map.",
        "short cut-off": "The shortest waves of the map make it: quote the shortest wave with the number, or name that "
        "of the instrument (short_cutoff, --shortest-wave).",
        "levelling": "The longest waves are about as long as the map, and a quadratic form takes them away: measure a "
        "larger map, or find out whether the form is that of the instrument.",
        "patches": "The patches differ by as much: take more or larger ones.",
    }
)
OTHERWISE = ("_per_area", "_fraction")  # endings of names: numbers that are others over the area


def notes_on_sources(numbers: Sequence[QuotedNumber], sources: Sequence[ErrorSource]) -> list[str]:
    """Return a sentence for each source that is nearly all of a large error, with the numbers and the remedy."""
    notes = []
    for place, source in enumerate(sources):
        made = [
            f"{VARIABLES[number.name].label} ({100 * number.relative_error:.0f} %)"
            for number in numbers
            if not number.name.endswith(OTHERWISE)
            and abs(number.parts[place]) >= ALL * number.error
            and number.relative_error >= LARGE
        ]
        if made:
            words = f"Nearly all of the error of {', '.join(made)} is that of {source.name}."
            notes.append(f"{words} {REMEDIES[source.name]}")
    return notes
