"""The amount of output on standard error."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

__all__ = ["is_quiet", "quietly"]

_QUIET = ContextVar("quiet", default=False)


def is_quiet() -> bool:
    """Return whether only errors and notes on wrong numbers are printed."""
    return _QUIET.get()


@contextmanager
def quietly(wanted: bool) -> Iterator[None]:
    """Leave out remarks in this block if `wanted`; notes and errors are still printed."""
    token = _QUIET.set(wanted)
    try:
        yield
    finally:
        _QUIET.reset(token)
