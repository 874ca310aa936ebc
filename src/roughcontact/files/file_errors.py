"""Errors and warnings about files: one error with a remedy, one warning about unusual contents."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from roughcontact.errors import InputError

__all__ = ["ContentError", "ReadError", "SurfaceWarning", "damage"]


class ContentError(InputError):
    """Bytes that a reader cannot turn into heights; `content` turns it into a `ReadError`, which names the file."""


@contextmanager
def damage(
    problem: str,
    remedy: str,
    kinds: tuple[type[Exception], ...] = (Exception,),
    said: Callable[[Exception], str] = str,
) -> Iterator[None]:
    """Turn errors of some kinds into a ContentError, with their text after the problem.

    Raises
    ------
    ContentError
        If the block raises such an error, or a ContentError.
    """
    try:
        yield
    except ContentError:
        raise
    except kinds as error:
        raise ContentError(f"{problem} ({said(error)})", remedy) from error


class ReadError(InputError):
    """A file that cannot be turned into a surface, or into a curve.

    Parameters
    ----------
    file : str
        Name of the file.
    problem : str
        What is wrong, with the value that is wrong.
    remedy : str
        What the user can do about it.
    place : str, optional
        The arguments that correct it, such as ``"unit, size"``.

    Examples
    --------
    >>> import roughcontact as rc
    >>> try:
    ...     rc.read("part.x3p")
    ... except rc.ReadError as error:
    ...     print(error)
    part.x3p: it cannot be opened (No such file or directory); check the path and the permissions
    """

    def __init__(self, file: str, problem: str, remedy: str | None, place: str | None = None) -> None:
        super().__init__(f"{file}: {problem}", remedy, place)
        self.args = file, problem, remedy, place  # for pickle, which rebuilds the error from them
        self.file = file
        self.problem = problem


class SurfaceWarning(UserWarning):
    """A file was read, but something about it is unusual and should be checked.

    Examples
    --------
    >>> import warnings
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> rc.write(rc.self_affine(rc.Grid((8, 8), 1.0), 0.8, 0.1, np.random.default_rng(1)), "map.npz")
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always", rc.SurfaceWarning)
    ...     surface = rc.read("map.npz")
    >>> print(str(caught[0].message).partition(";")[0])
    map.npz: a surface of 8 m x 8 m is unusual
    """
