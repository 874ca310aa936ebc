"""The border of functions of numbers: what is no number, or does not fit, is refused by the name of its parameter.

Theories use it, and so do all other rooms.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import fields
from functools import wraps
from typing import Any, ParamSpec, TypeVar

import numpy as np

from roughcontact.theory.tools.domain import number, require, scalar

__all__ = ["fitting", "numeric", "require_numbers"]

P = ParamSpec("P")
R = TypeVar("R")

# Annotations as they are written, every module postponing them: of arrays that are broadcast, of single numbers, and of
# whole ones.
ARRAYS = {"npt.ArrayLike", "float | Array"}
NUMBERS = {"float"}
WHOLE = {"int"}
OPTIONAL = " | None"


def numeric(function: Callable[P, R]) -> Callable[P, R]:
    """Check the arguments of a function by the annotations of its parameters, before it sees them.

    ``float`` wants one number, ``int`` a whole one, ``npt.ArrayLike`` and ``float | Array`` numbers or arrays that can
    be broadcast; none takes NaN. With ``| None`` they may be None. Whatever else is annotated is passed on, as are all
    values as given: their range is the function's own affair.

    Raises
    ------
    ValueError
        From the decorated function: the parameter, what it is to be and what it is; or the shapes that do not fit.
    """
    parameters = inspect.signature(function).parameters
    names = tuple(parameters)
    kinds = {name: str(parameter.annotation) for name, parameter in parameters.items()}
    wanted = {
        name: kind for name, kind in kinds.items() if kind.removesuffix(OPTIONAL) in ARRAYS | NUMBERS | WHOLE
    }

    @wraps(function)
    def checked(*args: P.args, **kwargs: P.kwargs) -> R:
        given = dict(zip(names, args, strict=False)) | kwargs
        shapes = {}
        for name, value in given.items():
            if name in wanted and not (value is None and wanted[name].endswith(OPTIONAL)):
                shapes[name] = _shape(value, name, wanted[name].removesuffix(OPTIONAL))
        fitting(shapes)
        return function(*args, **kwargs)

    return checked


def require_numbers(body: Any) -> None:
    """Refuse a dataclass one of whose fields of type ``float`` or ``int`` holds anything else than one such number.

    Raises
    ------
    ValueError
        Naming the field.
    """
    for field in fields(body):
        value, kind = getattr(body, field.name), str(field.type)
        if kind.removesuffix(OPTIONAL) in NUMBERS | WHOLE and not (value is None and kind.endswith(OPTIONAL)):
            _shape(value, field.name, kind.removesuffix(OPTIONAL))


def fitting(shapes: Mapping[str, tuple[int, ...]]) -> None:
    """Refuse shapes that cannot be broadcast against each other, with the names of what has them.

    Raises
    ------
    ValueError
        If they do not fit.
    """
    try:
        np.broadcast_shapes(*shapes.values())
    except ValueError as error:
        told = ", ".join(f"{name} {shape}" for name, shape in shapes.items() if shape)
        raise ValueError(f"give numbers or arrays of one shape; these shapes do not fit: {told}") from error


def _shape(value: Any, name: str, kind: str) -> tuple[int, ...]:
    """Return the shape of a value, which must be numbers."""
    x = number(value, name) if kind in ARRAYS else np.asarray(scalar(value, name))
    if kind in WHOLE:
        require(np.isfinite(x) and x % 1 == 0, f"{name} must be a whole number, not {value}")
    require(~np.isnan(x), f"{name} must be a number, not nan")
    return np.shape(x)
