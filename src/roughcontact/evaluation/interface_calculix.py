"""The law of an interface as lines for CalculiX: what its version 2.20 reads, and reads right.

Version 2.20 uses a table of pressures only in node-to-surface contact, and conducts heat right only in
surface-to-surface contact. There it takes a straight line or an exponential. So there are two surface interactions.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from roughcontact.errors import InputError
from roughcontact.evaluation.interface_table import InterfaceTable
from roughcontact.evaluation.interface_text import (
    UNIT_SYSTEMS,
    as_comments,
    facts,
    friction_facts,
    stick_slope,
    unloaded,
)
from roughcontact.validation import Array

__all__ = ["calculix_text"]

# Lines of a table and of a conductance that version 2.20 has places for, with the one without load: it reads more
# without an error, and overwrites other numbers.
_LINES, _CONDUCTANCES = 200, 20
_APART = 1e-10  # smallest difference of overclosures, in the units of the file: closer lines are moved apart


def calculix_text(table: InterfaceTable, remarks: Iterable[str] = (), *, units: str = "SI") -> str:
    """Return two surface interactions for CalculiX: ``ROUGH`` with the table, ``ROUGHEXP`` with an exponential law.

    Parameters
    ----------
    table : InterfaceTable
    remarks : iterable of str
        Additional comments.
    units : {"SI", "mm"}
        Metres, newtons, pascals; or millimetres, newtons, megapascals.

    Returns
    -------
    str
        The text, with a line end at its end.

    Raises
    ------
    ValueError
        If the overclosures are too small for CalculiX in these units.
    """
    words, (stress, length, thermal, _) = UNIT_SYSTEMS[units]
    metre, _, pascal, *_ = words.split(", ")
    closing = table.overclosure * length
    rows = _spread(_apart(closing.tolist()), _LINES - 1)
    if len(rows) < 2:
        raise InputError(
            f"the closings of all loads are less than {_APART:g} {metre} apart, and CalculiX would move them",
            "write the table in millimetres: units='mm', or `table` calculix-mm",
            "units",
        )
    # Least squares of the closing, for p = p0 exp(closing/decay).
    decay, start = np.polyfit(np.log(table.pressure * stress), closing, 1)
    touching = math.exp(-start / decay)
    misfit = np.abs(decay * np.log(table.pressure * stress) + start - closing).max()
    stiffness = np.abs(table.pressure * length / (decay * table.stiffness) - 1).max()
    straight = replace(table, pressure=table.pressure[rows]).chord_error
    head = [
        f"units: {words}",
        *facts(table, units),
        f"overclosure 0 is a mean gap of {table.zero_gap * length!r}",
        f"ROUGH is for contact pairs of TYPE=NODE TO SURFACE, without heat: straight lines between {len(rows)} loads, "
        f"at most {straight:.2%} above a pressure that grows exponentially; above the last line CalculiX keeps the "
        "pressure constant and finds no equilibrium",
        "ROUGHEXP is for contact pairs of TYPE=SURFACE TO SURFACE, also with heat: an exponential law, whose closing "
        f"differs by at most {misfit:.3g} {metre} from the table, and whose stiffness by at most {stiffness:.1%}; the "
        f"gap is open below {touching:.6g} {pascal}, the pressure at overclosure 0",
        "CalculiX 2.20 finds no equilibrium with a table in surface-to-surface contact, and its node-to-surface "
        "contact takes a wrong conductance",
    ]
    friction = []
    if table.friction is not None:
        head += friction_facts(table, units)
        friction = ["*FRICTION", _line(table.friction, stick_slope(table) * stress / length)]
    lines = [
        "*SURFACE INTERACTION, NAME=ROUGH",
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR",
        *_table(table.pressure[rows] * stress, closing[rows]),
        *friction,
        "*SURFACE INTERACTION, NAME=ROUGHEXP",
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL",
        _line(decay * math.log(100), touching),  # the first is the distance at which 1 % is left
        *friction,
    ]
    for name in ("thermal_conductance_per_area", "joint_conductance_per_area"):
        if name in table.conductances:
            few = _spread(range(len(table)), _CONDUCTANCES - 1)
            values, start = table.conductances[name][few] * thermal, unloaded(table, name) * thermal
            lines += ["*GAP CONDUCTANCE", *_table(values, table.pressure[few] * stress, start)]
            head += [
                f"*GAP CONDUCTANCE has {len(few)} of {len(table)} loads: CalculiX 2.20 misreads more than "
                f"{_CONDUCTANCES} lines without an error; above the last line the conductance is constant",
                "CalculiX warns that ROUGH and ROUGHEXP have no conductivity, as for every interaction: ignore this",
            ]
    return "\n".join([*as_comments([*head, *remarks], "**"), *lines]) + "\n"


def _apart(closing: Iterable[float]) -> list[int]:
    """Return the rows that CalculiX does not move."""
    kept, last = [], 0.0
    for row, value in enumerate(closing):
        if value - last >= _APART:
            kept.append(row)
            last = value
    return kept


def _spread(rows: Sequence[int], most: int) -> list[int]:
    """Return at most `most` rows, evenly spread, with the first and the last one."""
    return [rows[round(k)] for k in np.linspace(0, len(rows) - 1, min(most, len(rows))).tolist()]


def _table(first: Array, second: Array, start: float = 0.0) -> Iterator[str]:
    """Yield lines of two numbers, those without load first."""
    yield _line(start, 0.0)
    yield from map(_line, first.tolist(), second.tolist())


def _line(first: float, second: float) -> str:
    """Return two numbers in 19 characters each: CalculiX reads 20 and drops the rest, even of an exponent."""
    return f"{first:.13e}, {second:.13e}"
