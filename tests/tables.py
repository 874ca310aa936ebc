"""Tables of comma-separated values."""

import contextlib

import pandas


def read_table(path):
    """Return a table by the names of its columns, without their units, which are its attribute ``units``."""
    table = pandas.read_csv(path, dtype=str, keep_default_na=False)
    parts = [title.removesuffix("]").partition(" [") for title in table.columns]
    table.columns = [name for name, _, _ in parts]
    for name in table:
        with contextlib.suppress(ValueError):  # words
            table[name] = [float(each) for each in table[name]]  # pandas of before 3 drops the last digits
    table.attrs["units"] = {name: unit for name, _, unit in parts if unit}
    return table
