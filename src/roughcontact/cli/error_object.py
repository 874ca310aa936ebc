"""An error as one JSON object, for programs that asked for JSON.

It goes to standard output in place of the answer, so that a program finds exactly one JSON object there. The key
``error`` and the exit status distinguish error and answer. Standard error contains the line for people.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from roughcontact.cli.json_answer import emit

__all__ = ["emit_error", "kind_of"]

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
        What to do about it.
    place : str, optional
        Which option, argument or file it concerns.
    beside : mapping
        Facts that are known despite the error.
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
