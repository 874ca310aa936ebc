"""Heights outside NumPy: functions that need NumPy get a copy, or refuse them with a message."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import wraps
from typing import Any, TypeVar

from roughcontact.arrays import is_numpy, on_host
from roughcontact.errors import InputError
from roughcontact.slabs.exchange import is_in_slabs

__all__ = ["analysed_on_host", "on_host_only", "on_host_or_in_slabs"]


F = TypeVar("F", bound=Callable[..., Any])


def on_host_only(function: F) -> F:
    """Return a function of surfaces that refuses heights which are not in NumPy's memory."""
    return _refusing(function, lambda heights: True)


def on_host_or_in_slabs(function: F) -> F:
    """Return a function of surfaces that refuses heights which are neither in NumPy's memory nor in slabs."""
    return _refusing(function, lambda heights: not is_in_slabs(heights))


def _refusing(function: F, refused: Callable[[Any], bool]) -> F:
    @wraps(function)
    def checked(*args: Any, **kwargs: Any) -> Any:
        surfaces: tuple[Any, ...] = (*args, *kwargs.values())
        for given in surfaces:
            if _is_elsewhere(given) and refused(given.heights):
                raise InputError(
                    f"{function.__name__} is for heights in NumPy's memory, not a {type(given.heights).__name__}",
                    "prepare the surface first, then put its heights on the device",
                )
        return function(*args, **kwargs)

    return checked  # type: ignore[return-value]


def analysed_on_host(function: F) -> F:
    """Return a function of surfaces that gets heights of another library as a copy in NumPy's memory.

    For functions that return numbers and NumPy arrays. Heights in slabs are refused: no process holds all of them.
    """

    @wraps(function)
    def there(*args: Any, **kwargs: Any) -> Any:
        if not any(map(_is_elsewhere, (*args, *kwargs.values()))):
            return function(*args, **kwargs)

        def copied(given: Any) -> Any:
            if not _is_elsewhere(given):
                return given
            if is_in_slabs(given.heights):
                raise InputError(
                    f"{function.__name__} is for surfaces that one process holds",
                    "gather the heights first, rc.Surface(surface.heights.gathered(), surface.grid)",
                )
            return replace(given, heights=on_host(given.heights))

        return function(*map(copied, args), **{name: copied(given) for name, given in kwargs.items()})

    return there  # type: ignore[return-value]


def _is_elsewhere(given: Any) -> bool:
    """Return whether this is a surface whose heights are an array of another library than NumPy."""
    heights = getattr(given, "heights", None)
    return heights is not None and not is_numpy(heights)
