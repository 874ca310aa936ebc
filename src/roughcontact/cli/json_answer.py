"""The answer of a command, or its error, as one JSON object; an error has the key ``error``.

It goes to standard output, and may be kept by a command that asks for several answers. Standard error holds the lines
for people.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from types import MappingProxyType
from typing import Any

__all__ = ["emit", "emit_error", "kept", "kind_of"]

# By class, the nearest first; the names are those that a program can rely on.
_KINDS = {
    "UsageError": "usage",
    "ReadError": "read",
    "WriteError": "write",
    "StoreError": "store",
    "StudyError": "study",
    "WorkersError": "workers",
    "OSError": "file",
    "MemoryError": "memory",
    "ValueError": "value",
}

_KEPT: ContextVar[list[Mapping[str, Any]] | None] = ContextVar("kept", default=None)


def emit(record: Any) -> None:
    """Print an answer as one line of JSON on standard output, or keep it within `kept`."""
    answers = _KEPT.get()
    if answers is None:
        sys.stdout.write(json.dumps(record, allow_nan=False, ensure_ascii=True) + "\n")
        sys.stdout.flush()
    else:
        answers.append(record)


@contextmanager
def kept() -> Iterator[list[Mapping[str, Any]]]:
    """Keep the answers of the block in a list."""
    answers: list[Mapping[str, Any]] = []
    token = _KEPT.set(answers)
    try:
        yield answers
    finally:
        _KEPT.reset(token)


def emit_error(
    kind: str,
    message: str,
    status: int,
    remedy: str | None = None,
    place: str | None = None,
    beside: Mapping[str, Any] = MappingProxyType({}),
) -> None:
    """Print an error as one JSON object on standard output.

    Parameters
    ----------
    kind : str
        What kind of error it is, in one word.
    message : str
        What is wrong.
    status : int
        The exit status of the program.
    remedy : str, optional
        How to correct it.
    place : str, optional
        The option, argument or file that it concerns.
    beside : mapping
        Further entries of the object.
    """
    record = {
        "kind": kind,
        "message": message,
        "remedy": remedy,
        "place": place,
        "exit_status": status,
    }
    emit({"error": record, **beside})


def kind_of(error: BaseException) -> str:
    """Return the kind of an error in one word."""
    return next(_KINDS[each.__name__] for each in type(error).__mro__ if each.__name__ in _KINDS)
