"""Why a request was refused, in words for a page: what is wrong, what to do, and which of its fields it concerns."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from roughcontact.errors import correctable
from roughcontact.files.file_errors import ReadError
from roughcontact.recipe.preparation import masks_named

__all__ = ["on_the_page", "refusal"]

# What the library says by names and calls of Python.
_WORDS = {
    "poisson_ratio": "Poisson's ratio",
    "young_modulus": "Young's modulus",
    "short_cutoff": "the short cut-off",
    "long_cutoff": "the long cut-off",
    "pass channel= for another": "choose another under Channel",
    "take them out by masked()": "crop them away",
    "unit=": "the unit of the heights",
    "size=": "the width",
}
_LACKING = {"unit": "the unit of the heights", "size": "the width of the map", "channel": "the channel"}


def refusal(error: Exception) -> dict[str, Any]:
    """Return how a request ended that raised an error: refused, or with a mistake of this program."""
    found = correctable(error)
    if found is None:
        words = f"{type(error).__name__}: {error}"
        return {"how": "mistake", "message": f"This is a mistake in roughcontact, not in your input: {words}"}
    if isinstance(error, OSError):  # its folder is the server's: the user knows the name alone
        return _refused(found.message.replace(str(found.place), f"the file {Path(str(found.place)).name}"))
    places = [] if found.place is None else found.place.split(", ")
    message, remedy = found.message, found.remedy
    if isinstance(found, ReadError):
        message, fields = found.problem, [place.rpartition(".")[2] for place in places]
        if lacking := [_LACKING[name] for name in fields if name in _LACKING]:
            remedy = f"Give {' and '.join(lacking)}."
        elif remedy is not None and "read_line" in remedy:
            remedy = "The page presses maps: for a profile use roughcontact curve FILE --profile line."
    return _refused(message, remedy) | {"places": places}


def on_the_page(text: str) -> str:
    """Return what the library says, in the words of the page: fields by their labels."""
    text = masks_named(text, "Mask ")
    for python, words in _WORDS.items():
        text = re.sub(re.escape(python), words, text, flags=re.IGNORECASE)
    return re.sub(r"`(\w+)`", lambda field: field[1].replace("_", " "), text)


def _refused(message: str, remedy: str | None = None) -> dict[str, Any]:
    advice = {} if remedy is None else {"remedy": _sentence(on_the_page(remedy))}
    return {"how": "refused", "message": _sentence(on_the_page(message))} | advice


def _sentence(text: str) -> str:
    """Return a message as a sentence."""
    text = " ".join(text.split())
    ended = text if text.endswith((".", "!", "?")) else f"{text}."
    return ended[:1].upper() + ended[1:]
