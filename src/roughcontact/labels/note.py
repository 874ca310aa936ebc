"""Notes on an answer: sentences, and the importance of each."""

from __future__ import annotations

from collections.abc import Iterable
from enum import IntEnum
from typing import NamedTuple

__all__ = ["Note", "Rank", "in_order"]


class Rank(IntEnum):
    """The importance of a note, the most important first; it is set where the note is made."""

    WRONG = 0
    """A number is wrong: it missed its tolerance, or it is set by the grid."""
    DOUBTFUL = 1
    """A number may be wrong: a unit, a spike, a theory beyond its range."""
    LIMITED = 2
    """A number is right, but its scope is smaller than a reader may think."""
    USUAL = 3
    """A property of most maps."""


class Note(NamedTuple):
    """A sentence for the reader of an answer."""

    rank: Rank
    text: str


def in_order(notes: Iterable[Note]) -> tuple[str, ...]:
    """Return the sentences of notes, each once: errors first, usual properties last."""
    return tuple(dict.fromkeys(note.text for note in sorted(notes, key=lambda note: note.rank)))
