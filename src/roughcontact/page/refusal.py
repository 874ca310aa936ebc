"""Why a request was refused, in words for a page: what is wrong, and which of its fields mends it."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

from roughcontact.files.file_errors import ReadError
from roughcontact.files.own_errors import is_ours
from roughcontact.page.field_error import FieldError

__all__ = ["refusal"]

# Errors of the library name keywords of Python; the page has fields of these names.
_KEYWORDS = {
    "poisson_ratio": "Poisson's ratio",
    "young_modulus": "Young's modulus",
    "short_cutoff": "the short cut-off",
    "long_cutoff": "the long cut-off",
}
_FIELDS = {"unit": "the unit of the heights", "size": "the width of the map", "channel": "the channel"}


def refusal(error: Exception) -> dict[str, Any]:
    """Return how a request ended that raised an error: refused, or with a mistake of this program."""
    if isinstance(error, FieldError):
        end = refusal(error.error) | {"field": error.field}
        for keyword, words in _KEYWORDS.items():
            end["message"] = re.sub(keyword, words, end["message"], flags=re.IGNORECASE)
        return end | {"message": _sentence(end["message"])}
    if isinstance(error, ReadError):
        lacking = [name for name in _FIELDS if re.search(rf"\b{name}=", error.remedy)]
        remedy = error.remedy
        if lacking:
            remedy = f"Give {' and '.join(_FIELDS[name] for name in lacking)}."
        elif "read_line" in remedy:
            remedy = "The page presses maps: for a profile use roughcontact curve FILE --profile line."
        return {
            "how": "refused",
            "message": _sentence(error.problem),
            "remedy": _sentence(remedy),
            "lacking": lacking,
        }
    if isinstance(error, ValueError | OSError) and is_ours(error):
        return {"how": "refused", "message": _sentence(_words(error))}
    words = f"{type(error).__name__}: {error}"
    return {"how": "mistake", "message": f"This is a mistake in roughcontact, not in your input: {words}"}


def _words(error: ValueError | OSError) -> str:
    """Return a message without the folder in which the server keeps the file: its user knows the name alone."""
    if isinstance(error, OSError) and error.filename is not None:
        return f"the file {Path(os.fsdecode(error.filename)).name}: {error.strerror or error}"
    return str(error)


def _sentence(text: str) -> str:
    """Return a message as a sentence."""
    text = " ".join(text.split())
    ended = text if text.endswith((".", "!", "?")) else f"{text}."
    return ended[:1].upper() + ended[1:]
