"""The SHA-256 of a file."""

from __future__ import annotations

import hashlib
from functools import lru_cache
from pathlib import Path

from roughcontact.files.file_errors import ReadError
from roughcontact.files.standard_streams import standard, standard_input

__all__ = ["fingerprint"]


def fingerprint(path: Path) -> str:
    """Return the SHA-256 of a file, or of standard input.

    Raises
    ------
    ReadError
        If it cannot be read.
    """
    if standard(path) is not None:
        return hashlib.sha256(standard_input(path)).hexdigest()
    try:
        stands = path.stat()
        return _digest(path, stands.st_mtime_ns, stands.st_size)
    except OSError as error:
        remedy = "give the name of a file that exists"
        raise ReadError(str(path), error.strerror or str(error), remedy) from error


@lru_cache(maxsize=1024)  # each combination of a study names the same files
def _digest(path: Path, changed: int, size: int) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
