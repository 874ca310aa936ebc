"""Errors of requests in words for a page: the problem, the remedy, and the fields concerned."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import Any

from roughcontact.errors import InputError, correctable, every
from roughcontact.files.file_errors import ReadError
from roughcontact.page.forms import label_of, names_of_fields
from roughcontact.recipe.preparation import Preparation, masks_named
from roughcontact.recipe.recipe_fields import specs

__all__ = ["on_the_page", "refusal"]

# Arguments of Python without a field of the same name.
_ARGUMENTS = {
    "poisson_ratio": "Poisson",
    "young_modulus": "Young",
    "by loading_loop": "by a loop of loads",
    "rc.Solid(210e9, 0.3)": "210 GPa and 0.3",
}
_LACKING = {
    "unit": "Unit (of the heights)",
    "size": "Size (the width of the map)",
    "channel": "Channel",
}
_OPTION = re.compile(r"--([a-z][a-z0-9-]*)")
_ASIDE = re.compile(r" \(([^()]*--[^()]*)\)")  # a method and an option in brackets
_METHOD = re.compile(r"\b(\w+)\(\)(?: and (?=--))?")
_FIELD = re.compile(r"`(\w+)`")
_ARGUMENT = re.compile(r"\b(pass )?([a-z]+(?:_[a-z]+)*)= ?")
_READER = re.compile(r"\bread(_line)?\b")
_NAME = re.compile(r"\b[a-z]+2?_[a-z_]+\b")


def refusal(error: Exception) -> dict[str, Any]:
    """Return the outcome of a request that raised an error: refused, or a defect of this program."""
    found = correctable(error)
    if found is None:
        words = f"{type(error).__name__}: {error}"
        return {"how": "mistake", "message": f"This is a mistake in roughcontact, not in your input: {words}"}
    if isinstance(error, OSError):  # the folder belongs to the server: the user has only seen the name
        message = found.message.replace(str(found.place), f"the file {Path(str(found.place)).name}")
        return {"how": "refused", "message": _sentence(message)}
    faults = [_fault(each) for each in every(found)]
    words = " ".join(each["message"] for each in faults)
    return {
        "how": "refused",
        "message": words,
        "places": [at for each in faults for at in each["places"]],
    } | ({"faults": faults})


def on_the_page(text: str) -> str:
    """Return a message of the library in the words of the page, with the labels of its fields."""
    text = masks_named(text, "Mask ")
    text = _ASIDE.sub(lambda found: f" ({' and '.join(map(_option, _OPTION.findall(found[1])))})", text)
    text = _METHOD.sub(lambda found: "" if found[0].endswith("and ") else _step(found[1]), text)
    for python, words in _ARGUMENTS.items():
        text = text.replace(python, words)
    text = _ARGUMENT.sub(_argument, text)
    text = _OPTION.sub(lambda found: _option(found[1]), text)
    text = _FIELD.sub(lambda found: label_of(found[1]), text)
    return _NAME.sub(lambda found: label_of(found[0]) if found[0] in _names() else found[0], text)


def _fault(error: InputError) -> dict[str, Any]:
    """Return an error and its remedy in sentences, and the fields concerned."""
    places = [] if error.place is None else error.place.split(", ")
    message, remedy = error.message, error.remedy
    if isinstance(error, ReadError):
        message, fields = error.problem, [place.rpartition(".")[2] for place in places]
        if lacking := [_LACKING[name] for name in fields if name in _LACKING]:
            remedy = f"Fill in {' and '.join(lacking)}."
        elif remedy is not None and _READER.search(remedy):
            remedy = (
                "choose line or winkler as `profile`" if "line" in remedy else "choose \u2013 as `profile`"
            )
            places = ["contact.profile"]
    sentences = [_sentence(each) for each in (message, remedy) if each]
    return {"message": " ".join(sentences), "places": places}


def _option(words: str) -> str:
    """Return the label of the field of an option; the option itself if no form contains the field."""
    name = words.replace("-", "_")
    return label_of(name) if name in _names() else f"--{words}"


def _argument(found: re.Match[str]) -> str:
    """Return the label of the field of an argument of Python."""
    name = found[2]
    return f"{'fill in ' if found[1] else ''}{label_of(name)} " if name in _names() else found[0]


def _step(method: str) -> str:
    """Return the label of the step of a method of surfaces."""
    labels = (label_of(each.name) for each, spec in specs(Preparation) if spec.step.method == method)
    return next(labels, f"{method}()")


_names = cache(names_of_fields)


def _sentence(text: str) -> str:
    """Return a message as a sentence in the words of the page."""
    text = " ".join(on_the_page(text).split())
    ended = text if text.endswith((".", "!", "?")) else f"{text}."
    return ended[:1].upper() + ended[1:]
