"""The law of an interface as columns of numbers: text with units, and comma-separated values for MOOSE."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from roughcontact.evaluation.interface_table import InterfaceTable
from roughcontact.evaluation.interface_text import as_comments, facts, unloaded

__all__ = ["column_text", "moose_text"]


def column_text(table: InterfaceTable, remarks: Iterable[str] = ()) -> str:
    """Return all columns of a table in SI, between spaces, under two comments with names and units.

    Parameters
    ----------
    table : InterfaceTable
    remarks : iterable of str
        Additional comments.

    Returns
    -------
    str
        The text, which ``numpy.loadtxt`` reads, with a line end at its end.
    """
    columns = {name: each for name, each in table.to_dataset().data_vars.items() if each.ndim}
    head = [*facts(table), f"overclosure 0 is a mean gap of {table.zero_gap!r} m", *remarks]
    lines = [*as_comments(head, "#"), "# " + " ".join(map(str, columns))]
    lines.append("# " + " ".join(each.attrs["units"].replace(" ", "*") for each in columns.values()))
    rows = zip(*(each.values.tolist() for each in columns.values()), strict=True)
    return "\n".join([*lines, *(" ".join(map(repr, row)) for row in rows)]) + "\n"


def moose_text(table: InterfaceTable, remarks: Iterable[str] = ()) -> str:
    """Return rising columns for a ``PiecewiseLinear`` of MOOSE, from the gap at which the pressure begins.

    Parameters
    ----------
    table : InterfaceTable
    remarks : iterable of str
        Additional comments.

    Returns
    -------
    str
        The text, with a line end at its end.
    """
    columns = {
        "overclosure": (0.0, table.overclosure),
        "nominal_pressure": (0.0, table.pressure),
        "interfacial_stiffness_per_area": (table.stiffness[0], table.stiffness),
        **{name: (values[0], values) for name, values in table.tangential.items()},
        **{name: (unloaded(table, name), values) for name, values in table.conductances.items()},
    }
    head = [
        "SI units; for PiecewiseLinear with format = columns and xy_in_file_only = false",
        *facts(table),
        f"overclosure 0 is a mean gap of {table.zero_gap!r} m",
        *remarks,
    ]
    rows = np.transpose([np.append(*each) for each in columns.values()]).tolist()
    lines = [*as_comments(head, "#"), ",".join(columns), *(",".join(map(repr, row)) for row in rows)]
    return "\n".join(lines) + "\n"
