"""Something suspicious about a map, and what mends it."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Doubt"]


@dataclass(frozen=True, slots=True)
class Doubt:
    """What looks wrong, and the step of ``surface prepare`` that mends it.

    Parameters
    ----------
    kind : str
        What it is, in a word or two.
    words : str
        What was found.
    remedy : str
        What to do about it, in the options of the command line.
    step : tuple of str, optional
        The option to begin with and its value; None where no option mends it.
    """

    kind: str
    words: str
    remedy: str
    step: tuple[str, str] | None = None

    def __str__(self) -> str:
        return f"{self.kind}: {self.words}: {self.remedy}"
