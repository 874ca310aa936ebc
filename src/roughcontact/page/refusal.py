"""Why an order was refused, in words for a page: what is wrong, and which of its fields mends it."""

from __future__ import annotations

import re
from typing import Any

from roughcontact.files.file_errors import ReadError
from roughcontact.page.field_error import FieldError

__all__ = ["refusal"]

# The readers' remedies name keywords of Python; the page has fields of these names.
_KEYWORDS = {
    "poisson_ratio": "Poisson's ratio",
    "young_modulus": "Young's modulus",
    "short_cutoff": "the short cut-off",
    "long_cutoff": "the long cut-off",
}
_FIELDS = {"unit": "the unit of the heights", "size": "the width of the map", "channel": "the channel"}


def refusal(error: Exception) -> dict[str, Any]:
    """Return how an order ended that raised an error: refused, or with a mistake of this program."""
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
    if isinstance(error, ValueError | OSError):
        return {"how": "refused", "message": _sentence(str(error))}
    words = f"{type(error).__name__}: {error}"
    return {"how": "mistake", "message": f"This is a mistake in roughcontact, not in your input: {words}"}


def _sentence(text: str) -> str:
    """Return a message as a sentence."""
    text = " ".join(text.split())
    ended = text if text.endswith((".", "!", "?")) else f"{text}."
    return ended[:1].upper() + ended[1:]
