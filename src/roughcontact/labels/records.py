"""The loads of a curve one by one, as records."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import MISSING, fields
from typing import Any, TypeVar

import numpy as np

__all__ = ["records"]

T = TypeVar("T")


def records(kind: type[T], curve: Any, more: Any = None) -> Iterator[T]:
    """Yield the loads of a curve in their order, each as a record of a dataclass.

    Parameters
    ----------
    kind : type
        Each of its fields has the name of a column of the curve; those with a default are columns of `more`.
    curve : object
        Object with the columns as attributes.
    more : object, optional
        Object with further columns; without it their fields keep the default.
    """
    sources = {each.name: curve if each.default is MISSING else more for each in fields(kind)}  # type: ignore[arg-type]
    columns = {name: getattr(source, name) for name, source in sources.items() if source is not None}
    plain = [each.tolist() if isinstance(each, np.ndarray) else each for each in columns.values()]
    for values in zip(*plain, strict=True):
        yield kind(**dict(zip(columns, values, strict=True)))
