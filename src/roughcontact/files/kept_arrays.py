"""Arrays that a computation keeps, to be continued later: one file of NumPy, whole or not at all."""

from __future__ import annotations

import os
import zipfile
from collections.abc import Mapping
from typing import Any

import numpy as np

from roughcontact.files.aside import require_target, written_aside
from roughcontact.validation import Array

__all__ = ["keep_arrays", "kept_arrays"]


def kept_arrays(path: str | os.PathLike[str]) -> dict[str, Array]:
    """Return the arrays of a file by name; none if there is no file, or a damaged one.

    Raises
    ------
    WriteError
        If the file cannot be replaced later.
    """
    target = require_target(path)
    try:
        with target.open("rb") as stream, np.load(stream, allow_pickle=False) as file:
            return dict(file)
    except (OSError, ValueError, EOFError, zipfile.BadZipFile):
        return {}


def keep_arrays(path: str | os.PathLike[str], arrays: Mapping[str, Any]) -> None:
    """Replace the arrays of a file.

    Raises
    ------
    WriteError
        If it cannot be written.
    """
    with written_aside(path) as aside, aside.open("wb") as file:
        np.savez(file, **arrays)
