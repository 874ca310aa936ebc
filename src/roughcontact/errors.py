"""Errors that the user can correct: what is wrong, what to do about it, and which argument or field it concerns."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

__all__ = [
    "InputError",
    "about",
    "correctable",
    "every",
    "in_place",
    "joined",
    "placed",
    "together",
    "within",
]


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
        self.parts: tuple[InputError, ...] = ()

    def __str__(self) -> str:
        return joined(self.message, self.remedy)


def joined(message: str, remedy: str | None) -> str:
    """Return a message and its remedy in one line."""
    return message if remedy is None else f"{message}{';' if ': ' in message else ':'} {remedy}"


def in_place(error: InputError) -> str:
    """Return an error in one line, its place in front."""
    if error.place is None:
        return str(error)
    return joined(f"{error.place}: {error.message}", error.remedy)


def every(error: InputError) -> tuple[InputError, ...]:
    """Return the error of each value that cannot be used."""
    return error.parts or (error,)


def together(found: Sequence[InputError]) -> InputError:
    """Return one error for several values that cannot be used; a single error is returned as it is."""
    if len(found) == 1:
        return found[0]
    whole = InputError("")
    whole.parts = tuple(found)
    _restate(whole)
    return whole


def _restate(whole: InputError) -> None:
    """Set the message and the place of an error about several values from its parts."""
    whole.message = "; ".join(map(in_place, whole.parts))
    whole.place = ", ".join(each.place for each in whole.parts if each.place) or None


def correctable(error: BaseException) -> InputError | None:
    """Return an `InputError`, or an error of the operating system with a file as an `InputError`.

    Any other error is a bug of this program; None is returned for it.
    """
    if isinstance(error, InputError):
        return error
    # typer ends quietly at a pipe whose reader has closed it.
    if isinstance(error, OSError) and error.filename is not None and not isinstance(error, BrokenPipeError):
        file = os.fsdecode(error.filename)
        return InputError(f"{file}: {error.strerror or error}", place=file)
    return None


def about(what: str, problem: str, remedy: str | None = None) -> InputError:
    """Return the error about an argument, such as ``"force [N]"`` or ``"the depth"``; its place is that name."""
    name = what.removeprefix("the ").partition(" [")[0]
    return InputError(f"{what} {problem}", remedy, name if name.isidentifier() else None)


@contextmanager
def placed(place: str) -> Iterator[None]:
    """Set the place of an `InputError` that the block raises, where only the caller has the name of the argument."""
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
        for each in every(error):
            names = [] if each.place is None else each.place.split(", ")
            each.place = ", ".join(f"{place}.{name}" for name in names) or place
        if error.parts:
            _restate(error)
        raise
