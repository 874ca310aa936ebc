"""Read what was measured at a joint: a text with a column of pressures and one of stiffnesses or closures."""

from __future__ import annotations

import os
import re
import warnings
from dataclasses import dataclass
from typing import Literal

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.files.column_units import column_names, column_units
from roughcontact.files.content import content
from roughcontact.files.file_errors import ContentError, SurfaceWarning
from roughcontact.files.numbers import decode, parse_table
from roughcontact.files.quantity import LENGTH, PRESSURE, STIFFNESS_PER_AREA, parse
from roughcontact.validation import Array, shown

__all__ = ["JointTable", "read_joint_table"]

_NAMES = {
    "pressure": r"(nominal )?pressure|p",
    "stiffness": r"((interfacial|contact) )?stiffness( per area)?|k",
    "closure": r"closure",
    "reflection": r"reflection|r",
    "error": r"(standard )?errors?",
}
_KINDS = {"pressure": PRESSURE, "stiffness": STIFFNESS_PER_AREA, "closure": LENGTH}
_PURE = {None: 1.0, "": 1.0, "1": 1.0, "-": 1.0, "%": 0.01}  # units of a ratio
_LINES = {
    "stiffness": "pressure [MPa], stiffness [N/um/mm^2]",
    "closure": "pressure [MPa], closure [um]",
    "reflection": "pressure [MPa], reflection",
    "loads": "pressure [MPa]",
}


@dataclass(frozen=True, eq=False)
class JointTable:
    r"""What was measured at a joint, in SI.

    Attributes
    ----------
    quantity : str
        "stiffness", "closure" or "reflection"; "loads" for those of a measurement that is planned.
    pressures : array, shape (d,)
        Nominal pressures [Pa].
    values : array, shape (d,)
        K/A0 [Pa/m], closure [m] or size of the reflection [-]; of planned loads empty.
    given_errors : array, shape (d,), or None
        Standard errors, if the table has them: relative ones of a stiffness and of planned loads, otherwise in the unit
        of the values.

    Examples
    --------
    >>> import roughcontact as rc
    >>> with open("closure.csv", "w") as file:
    ...     _ = file.write("pressure [MPa], closure [um]\n7, 1.000\n15, 1.279\n")
    >>> rc.read_joint_table("closure.csv", "closure").values.tolist()
    [1e-06, 1.279e-06]
    """

    quantity: str
    pressures: Array
    values: Array
    given_errors: Array | None = None

    @property
    def errors(self) -> Array:
        """The standard errors.

        Raises
        ------
        ValueError
            If the table has none.
        """
        if self.given_errors is None:
            option, example = ("resolution", "10nm") if self.quantity == "closure" else ("errors", "5%")
            raise InputError(
                f"the table has no column of errors, and `{option}` is not given",
                f"give `{option}`, such as {example}, or add a column error",
                option,
            )
        return self.given_errors


def read_joint_table(
    path: str | os.PathLike[str],
    quantity: Literal["stiffness", "closure", "reflection", "loads"] = "stiffness",
    *,
    columns: str | None = None,
) -> JointTable:
    r"""Return the pressures and the measured values in a text, one load a line.

    The line above the numbers names the columns with their units, ``pressure [MPa], stiffness [N/um/mm^2]``. A column
    ``error`` holds standard errors, in per cent, as a fraction, or in the unit of the values.

    Parameters
    ----------
    path : str or path
        The file: columns separated by commas, semicolons, tabs or blanks.
    quantity : {"stiffness", "closure", "reflection", "loads"}
        The column to read beside the pressures: none for "loads".
    columns : str, optional
        Names and units of the columns, in place of the line in the file.

    Returns
    -------
    JointTable

    Raises
    ------
    ReadError
        If the file is missing or damaged, lacks a column, or states no unit.
    ValueError
        If the quantity is unknown.

    Warns
    -----
    SurfaceWarning
        If the file may be cut short.

    Examples
    --------
    >>> import roughcontact as rc
    >>> with open("joint.csv", "w") as file:
    ...     _ = file.write("pressure [MPa], stiffness [N/um/mm^2], error [%]\n5, 11, 5\n10, 21, 4\n")
    >>> table = rc.read_joint_table("joint.csv")
    >>> table.pressures.tolist(), (table.values / 1e12).tolist(), table.errors.tolist()
    ([5000000.0, 10000000.0], [11.0, 21.0], [0.05, 0.04])
    """
    if quantity not in _LINES:
        raise about("quantity", f"must be one of {', '.join(_LINES)}, not {shown(quantity)}")
    with content(path) as (file, data):
        table = parse_table(decode(data))
        lines = table.comments if columns is None else (columns,)
        count = table.values.shape[1]
        like = _LINES[quantity] + ", error [%]" * (count > 2)
        remedy = f"write such a line above the columns, or give columns='{like}'"
        places = _places(lines, count)
        wanted = ("pressure",) if quantity == "loads" else ("pressure", quantity)
        if missing := [name for name in wanted if name not in places]:
            instead = [name for name in _LINES if name in places and missing == [quantity]]
            raise _lacking(missing[0], instead, remedy)
        units = column_units(lines, count)
        read = {name: (table.values[:, place], units[place]) for name, place in places.items()}
        pressures, *others = (read[name][0] * _factor(name, read[name][1], remedy) for name in wanted)
        values = others[0] if others else np.empty(0)
        errors = _errors(*read["error"], values, quantity, remedy) if "error" in read else None
    for message in table.warnings:
        warnings.warn(f"{file}: {message}", SurfaceWarning, stacklevel=2)
    return JointTable(quantity, pressures, values, errors)


def _places(lines: tuple[str, ...], count: int) -> dict[str, int]:
    """Return the columns by what they hold, from the last line that names any."""
    for line in reversed(lines):
        names = column_names(line, count)
        found = {
            known: place
            for place, name in enumerate(names)
            for known, form in _NAMES.items()
            if re.fullmatch(form, name)
        }
        if found:
            return found
    return {}


def _lacking(name: str, others: list[str], remedy: str) -> ContentError:
    if others:
        message = f"it has no column of {name}, but one of {others[0]}"
        return ContentError(message, f"give quantity='{others[0]}'", "quantity")
    return ContentError(f"it has no column that is named {name}", remedy, "columns")


def _errors(values: Array, unit: str | None, of: Array, quantity: str, remedy: str) -> Array:
    """Return a column of errors: relative ones of a stiffness, otherwise in SI."""
    if quantity != "reflection" and unit in _PURE:
        return values * _PURE[unit] * (np.abs(of) if quantity == "closure" else 1.0)
    absolute = values * _factor(quantity, unit, remedy)
    return np.asarray(absolute / of if quantity == "stiffness" else absolute)


def _factor(name: str, unit: str | None, remedy: str) -> float:
    """Return a unit of a column in SI."""
    kind = _KINDS.get(name)
    if kind is None and unit in _PURE:
        return _PURE[unit]
    if kind is None:
        raise ContentError(f"the unit {unit!r} of the {name} is not that of a ratio", remedy, "columns")
    if unit is None:
        raise ContentError(f"it states no unit of the {name}", remedy, "columns")
    try:
        return parse(f"1 {unit}", kind)
    except InputError as error:
        raise ContentError(error.message, remedy, "columns") from error
