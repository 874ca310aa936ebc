"""A column: name, unit and description of one quantity of an answer, wherever it appears."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from roughcontact.halfspace.operators.geometry import Geometry

__all__ = ["CELLS", "Column", "Table", "columns", "names_of", "shown_in", "stored_in"]

CELLS = "cells"
"""In the dimensions of a table: the axes of the grid."""


@dataclass(frozen=True, slots=True)
class Column:
    """One line of the table of an answer.

    Parameters
    ----------
    name : str
        In files, records and on the command line; the attribute of the answer has the same name as a rule.
    unit : str
        Unit in UDUNITS style, as the CF conventions require: ``"N m-1"``; ``"1"`` for a pure number.
        Empty for words.
    long_name : str
        The quantity in words, understandable in a file without context.
    shown : str
        Where it is displayed, words separated by blanks: ``"patch"`` and ``"joint"`` are tables of loads on a screen,
        for a free and for a periodic map; ``"path"`` is the table of a path of adhesive surfaces; ``"page"`` the table
        in the browser; ``"facts"`` the lines about one state.
    label : str
        The quantity on the axis of a picture and in a table, without its unit; by default its name.
    digits : str
        Number format in a table on a screen.
    """

    name: str
    unit: str
    long_name: str
    shown: str = ""
    label: str = ""
    digits: str = ".4g"

    def __post_init__(self) -> None:
        object.__setattr__(self, "label", self.label or self.name.replace("_", " "))

    def unit_on(self, geometry: Geometry) -> str:
        """Return its unit in a geometry."""
        if geometry is Geometry.LINE:
            return _ON_A_LINE.get(self.unit, self.unit)
        if geometry is Geometry.FOUNDATION and self.name != "modulus":
            return _ON_SPRINGS.get(self.unit, self.unit)
        return self.unit


Table: TypeAlias = Mapping[tuple[str, ...], tuple[Column, ...]]
"""The columns of an answer by the dimensions that their values have."""

# For a line contact, sums over the contact are per unit length.
_ON_A_LINE = {"N": "N m-1", "N m-1": "N m-2", "m2": "m", "m3": "m2", "J": "J m-1"}
# Springs carry a force per length, and touch over a length; their modulus stays a pressure.
_ON_SPRINGS = {"Pa": "N m-1", "m2": "m", "m3": "m2", "Pa m-1": "N m-2"}


def columns(table: str) -> tuple[Column, ...]:
    """Return the columns of a table in words: a line each, the fields of `Column` between bars."""
    return tuple(Column(*map(str.strip, line.split("|"))) for line in table.strip().splitlines())


def names_of(columns: Iterable[Column]) -> tuple[str, ...]:
    """Return the names of columns."""
    return tuple(column.name for column in columns)


def stored_in(answer: type, columns: Iterable[Column]) -> tuple[str, ...]:
    """Return the names of the columns that a curve holds as arrays; the other columns are computed from them."""
    return tuple(each.name for each in columns if answer.__annotations__.get(each.name) == "Array")


def shown_in(place: str, columns: Iterable[Column]) -> tuple[Column, ...]:
    """Return the columns that are shown in a place, see `Column`."""
    return tuple(column for column in columns if place in column.shown.split())
