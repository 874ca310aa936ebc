"""Notes on an error budget in which one source contributes nearly all of an error."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType

from roughcontact.evaluation.error_budget import ErrorSource, QuotedNumber
from roughcontact.labels.variables import VARIABLES

__all__ = ["note_on_size", "notes_on_sources"]

ALL = 0.9  # of an error, from one source
LARGE = 0.1  # of a number: smaller errors get no note
SMALL = 0.2  # of K/A0, from the map to its quarters: a map that is small for its load
REMEDIES = MappingProxyType(
    {
        "grid": "The cells are too large for this load: take a finer map.",
        "short cut-off": "The shortest waves of the map cause it: quote the shortest wave with the number, or that "
        "of the instrument (short_cutoff, --shortest-wave).",
        "levelling": "The longest waves are about as long as the map, and a quadratic form removes them: measure a "
        "larger map, or check whether the form is that of the instrument.",
        "sampling": "Other maps of this surface differ by about as much: measure a larger map, or several.",
        "noise": "Measure with less noise, for example as the mean of several repeats.",
        "noise bias": "Measure with less noise, for example as the mean of several repeats.",
        "patches": "The patches differ by as much: take more or larger ones.",
    }
)
OTHERWISE = ("_per_area", "_fraction")  # endings of names: other numbers over the area


def note_on_size(bias_of_size: Mapping[str, float]) -> Iterator[str]:
    """Yield a sentence where the stiffness per area of the quarters shows that the map is small for its load."""
    bias = bias_of_size.get("interfacial_stiffness_per_area", 0.0)
    if SMALL < abs(bias) < math.inf:
        yield (
            f"The map is small for this load: K/A0 of its quarters differs by {100 * bias:+.0f} %. A larger map or "
            "several maps would show the stiffness of the joint."
        )


def notes_on_sources(numbers: Sequence[QuotedNumber], sources: Sequence[ErrorSource]) -> list[str]:
    """Return a note for each source that contributes nearly all of a large error, with the numbers and the remedy."""
    known = [place for place, source in enumerate(sources) if source.kind != "unknown"]
    error = "error" if len(known) == len(sources) else "known error"
    sizes = [math.hypot(*(number.parts[place] for place in known)) for number in numbers]
    notes = []
    for place in known:
        made = [
            f"{VARIABLES[number.name].label} ({100 * size / abs(number.value):.0f} %)"
            for number, size in zip(numbers, sizes, strict=True)
            if not number.name.endswith(OTHERWISE)
            and abs(number.parts[place]) >= ALL * size
            and size >= LARGE * abs(number.value) > 0
        ]
        if made:
            words = f"Nearly all of the {error} of {', '.join(made)} comes from {sources[place].name}."
            notes.append(f"{words} {REMEDIES[sources[place].name]}")
    return notes
