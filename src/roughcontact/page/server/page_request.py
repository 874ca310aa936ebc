"""One thing that a page asks of its worker."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from roughcontact.errors import InputError
from roughcontact.page.jobs.reduced import as_seen, factor_for
from roughcontact.page.jobs.session_cache import SessionCache, UploadedFile
from roughcontact.page.recipe import PageRecipe
from roughcontact.validation import Array

__all__ = ["Job", "PageRequest", "Send", "send_map"]


class Send(Protocol):
    """Sends a message on its way."""

    def __call__(self, header: Mapping[str, Any], data: bytes = b"") -> None:
        """Send a header of plain values, and bytes."""
        ...


@dataclass(frozen=True, slots=True)
class PageRequest:
    """What is asked for.

    Parameters
    ----------
    recipe : PageRecipe
    files : mapping of str to UploadedFile
        By the names under which the server keeps them.
    more : mapping
        What else the job needs to know.
    """

    recipe: PageRecipe
    files: Mapping[str, UploadedFile]
    more: Mapping[str, Any]

    @property
    def file(self) -> str:
        """How the user calls the measured file."""
        name = getattr(self.recipe.source, "file", "")
        return self.files[name].name if name in self.files else "FILE"

    @property
    def path(self) -> Path:
        """Where the measured file lies.

        Raises
        ------
        ValueError
            If the server has none of that name.
        """
        name = getattr(self.recipe.source, "file", "")
        if name not in self.files:
            raise InputError("the server has no such file any more", "drop it again")
        return self.files[name].path

    def whole(self, name: str, usual: int, most: int) -> int:
        """Return a whole number that the page states, between 1 and `most`."""
        given = self.more.get(name, usual)
        return min(max(given, 1), most) if isinstance(given, int) else usual


Job = Callable[[PageRequest, SessionCache, Send], None]


def send_map(send: Send, name: str, field: Array, most: int, *, lowest: bool = False, **more: Any) -> None:
    """Send a map in single precision, no side longer than `most`, its highest values kept, or its `lowest`."""
    import numpy as np

    factor = factor_for(field.shape, most)
    seen = np.ascontiguousarray(as_seen(field, factor, lowest=lowest), dtype="<f4")
    known = seen[~np.isnan(seen)]
    ends = [float(known.min()), float(known.max())] if known.size else [0.0, 0.0]
    header = {
        "type": "map",
        "map": name,
        "shape": seen.shape,
        "cells": field.shape,
        "factor": factor,
        "ends": ends,
    }
    send({**header, **more}, seen.tobytes())
