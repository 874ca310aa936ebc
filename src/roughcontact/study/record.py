"""A stored case: its row, and its record as JSON, which is exact to the last bit."""

from __future__ import annotations

import hashlib
import json
import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.errors import about

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    import xarray

__all__ = ["COLUMNS", "Row", "checksum", "decode", "encode", "require_record", "residual_of"]

_KINDS, _HELD = "biufU", "truth values, whole and real numbers of up to 64 bits, and words"
COLUMNS = (
    *("key", "sample", "parameters", "status", "message", "seconds", "version", "residual", "record"),
    "checksum",
)
# Variables with another name in stores of earlier builds: keys of cases do not depend on these names.
_RENAMED = {"largest_pressure": "max_pressure", "largest_tension": "max_tension"}
_ATTRIBUTES = (str, int, float, bool, np.bool_, np.integer)


def require_record(record: Any, fields: Iterable[str] = ()) -> None:
    """Raise an error for a result that cannot be stored as the record of a case.

    Raises
    ------
    TypeError, ValueError
        If it is not a dataset, lacks one of its `fields`, or holds values other than numbers and words.
    """
    import xarray

    if not isinstance(record, xarray.Dataset):
        raise TypeError(f"a case returns an xarray.Dataset, not {type(record).__name__}")
    for name in fields:
        if name not in record.data_vars:
            raise about("the record", f"lacks {name!r}, which the case declares as a field")
    for place, variable in record.variables.items():
        if variable.dtype.kind not in _KINDS or (variable.dtype.kind == "f" and variable.dtype.itemsize > 8):
            raise TypeError(f"{place!r} has the type {variable.dtype}, but a record can only hold {_HELD}")
        _require_attributes(repr(place), variable.attrs)
    _require_attributes("the record", record.attrs)


def _require_attributes(name: str, attributes: Mapping[Any, Any]) -> None:
    for key, value in attributes.items():
        if not isinstance(value, _ATTRIBUTES):
            raise TypeError(f"the attribute {key!r} of {name} is {value!r}: give a number or words")


def encode(record: xarray.Dataset) -> str:
    """Return a record as JSON: floats with the shortest digits that restore them, NaN and Infinity by name."""
    whole = {
        "coords": {str(name): _encoded(values.variable) for name, values in record.coords.items()},
        "data": {str(name): _encoded(values.variable) for name, values in record.data_vars.items()},
        "attrs": record.attrs,
    }
    return json.dumps(whole, separators=(",", ":"), default=_plain)


def decode(text: str) -> xarray.Dataset:
    """Return the record from a text of `encode`; variables have their current names."""
    import xarray

    whole = json.loads(text)
    return xarray.Dataset(
        {_RENAMED.get(name, name): _decoded(each) for name, each in whole["data"].items()},
        {name: _decoded(each) for name, each in whole["coords"].items()},
        whole["attrs"],
    )


def residual_of(record: xarray.Dataset) -> float | None:
    """Return the certificate of a record, the largest value of its variable ``residual``; None if it has none."""
    if "residual" not in record.variables or record["residual"].size == 0:
        return None
    largest = float(record["residual"].max())
    return None if math.isnan(largest) else largest


def _encoded(variable: xarray.Variable) -> dict[str, Any]:
    return {
        "dims": list(variable.dims),
        "dtype": variable.dtype.str,
        "values": variable.values.tolist(),
        "shape": list(variable.shape),
        "attrs": variable.attrs,
    }


def _decoded(each: Mapping[str, Any]) -> tuple[Any, ...]:
    values = np.array(each["values"], dtype=each["dtype"]).reshape(each["shape"])
    return each["dims"], values, each["attrs"]


def _plain(value: Any) -> Any:
    """Return a NumPy number, which attributes may be, as a Python number."""
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"{value!r} cannot be stored")


@dataclass(frozen=True, slots=True)
class Row:
    """A stored case.

    Parameters
    ----------
    key : str
    sample : int
    parameters : dict
        In SI, including defaults.
    status : "done" or "failed"
    message : str
        Why the case failed; empty otherwise.
    seconds : float
        Wall time of the computation.
    version : str
        Version of roughcontact.
    residual : float or None
        Certificate.
    text : str or None
        The record as JSON.

    Examples
    --------
    >>> import roughcontact as rc
    >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "hurst": 0.8, "loads": 3}
    >>> rc.study.run(rc.study.Study(name="few", case="curve", parameters=fixed), "few").done
    1
    >>> with rc.study.Store.open("few") as store:
    ...     [row] = store.rows()
    >>> row.status, row.parameters["rms"], row.record["stiffness"].sizes["load"]
    ('done', 1e-06, 3)
    """

    key: str
    sample: int
    parameters: dict[str, Any]
    status: str
    message: str
    seconds: float
    version: str
    residual: float | None
    text: str | None = field(repr=False)

    @property
    def record(self) -> xarray.Dataset | None:
        """The record without its fields, read from its text; None for a failed case."""
        return None if self.text is None else decode(self.text)

    @classmethod
    def of(cls, values: tuple[Any, ...]) -> Row | None:
        """Return the row from the values in a database.

        Parameters
        ----------
        values : tuple
            The values of ``COLUMNS``.

        Returns
        -------
        Row or None
            None if the checksum is wrong.

        Examples
        --------
        >>> import roughcontact as rc
        >>> rc.study.Row.of(("key", 0, "{}", "failed", "why", 1.0, "0.1.0", None, None, "another checksum")) is None
        True
        """
        *content, found = values
        if found != checksum(tuple(content)):
            return None
        content[2] = json.loads(content[2])
        return cls(*content)


def checksum(values: tuple[Any, ...]) -> str:
    """Return a checksum of all values except the last, which detects changes on the disk."""
    return hashlib.sha256(json.dumps(values).encode()).hexdigest()[:16]
