"""The one JSON object that a command answers: printed, or kept by a command that asks for several answers."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

__all__ = ["emit", "kept"]

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
