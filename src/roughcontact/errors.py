"""Errors that the user can correct: what is wrong, what to do about it, and which argument or field it concerns."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["InputError", "placed", "within"]


class InputError(ValueError):
    """A value that cannot be used; the error names the value, its place and the remedy.

    Parameters
    ----------
    message : str
        What is wrong, with the value that is wrong.
    remedy : str, optional
        What to do about it, in the imperative.
    place : str, optional
        The argument or field it concerns: a name, or a dotted path such as ``"preparation.short_cutoff"``. Several are
        separated by commas: ``"unit, size"``.

    Examples
    --------
    >>> import roughcontact as rc
    >>> try:
    ...     rc.Grid((64, 64), spacing="1um")
    ... except rc.InputError as error:
    ...     print(error.place)
    spacing
    """

    def __init__(self, message: str, remedy: str | None = None, place: str | None = None) -> None:
        super().__init__(message, remedy, place)  # all in `args`, so that the error can be pickled
        self.message = message
        self.remedy = remedy
        self.place = place

    def __str__(self) -> str:
        if self.remedy is None:
            return self.message
        return f"{self.message}{';' if ': ' in self.message else ':'} {self.remedy}"


@contextmanager
def placed(place: str) -> Iterator[None]:
    """Set the place of an `InputError` that is raised inside: of what the block checks, the caller names the place."""
    try:
        yield
    except InputError as error:
        error.place = place
        raise


@contextmanager
def within(place: str) -> Iterator[None]:
    """Put `place` in front of the place of an `InputError` that is raised inside: the error concerns a part of it."""
    try:
        yield
    except InputError as error:
        parts = [] if error.place is None else error.place.split(", ")
        error.place = ", ".join(f"{place}.{part}" for part in parts) or place
        raise
