"""How much a command says on standard error beside its answer."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

__all__ = ["is_quiet", "quietly"]

_QUIET = ContextVar("quiet", default=False)


def is_quiet() -> bool:
    """Return whether only what makes a number wrong is to be said."""
    return _QUIET.get()


@contextmanager
def quietly(wanted: bool) -> Iterator[None]:
    """Leave out remarks in this block where it is `wanted`; notes and errors are printed all the same."""
    token = _QUIET.set(wanted)
    try:
        yield
    finally:
        _QUIET.reset(token)
