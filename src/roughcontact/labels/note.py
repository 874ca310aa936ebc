"""What a reader of an answer should know: sentences, and how much each of them matters."""

from __future__ import annotations

from collections.abc import Iterable
from enum import IntEnum
from typing import NamedTuple

__all__ = ["Note", "Rank", "in_order"]


class Rank(IntEnum):
    """How much a note matters, the most important first; it stands where the note is made."""

    WRONG = 0
    """A number is wrong: it missed its tolerance, or the grid sets it."""
    DOUBTFUL = 1
    """A number may be wrong: a unit, a spike, a theory at its end."""
    LIMITED = 2
    """A number holds, for less than a reader may think."""
    USUAL = 3
    """What most maps have."""


class Note(NamedTuple):
    """A sentence for the reader of an answer."""

    rank: Rank
    text: str


def in_order(notes: Iterable[Note]) -> tuple[str, ...]:
    """Return the sentences of notes, each once: what makes a number wrong first, what is usual last."""
    return tuple(dict.fromkeys(note.text for note in sorted(notes, key=lambda note: note.rank)))
