"""One case as it is stored."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from roughcontact.study.record import decode

if TYPE_CHECKING:
    import xarray

__all__ = ["COLUMNS", "Row", "checksum"]

COLUMNS = (
    *("key", "sample", "parameters", "status", "message", "seconds", "version", "residual", "record"),
    "checksum",
)


@dataclass(frozen=True, slots=True)
class Row:
    """One case as it is stored.

    Parameters
    ----------
    key : str
    sample : int
    parameters : dict
        In SI, those with their default included.
    status : "done" or "failed"
    message : str
        Why it failed, empty otherwise.
    seconds : float
        Wall time of the computation.
    version : str
        Of roughcontact.
    residual : float or None
        Certificate.
    text : str or None
        The record as JSON.
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
        """The record without its fields, read from its text; None of a failed case."""
        return None if self.text is None else decode(self.text)

    @classmethod
    def of(cls, values: tuple[Any, ...]) -> Row | None:
        """Return the row of the values of `COLUMNS`, or None if they do not fit their checksum."""
        *content, found = values
        if found != checksum(tuple(content)):
            return None
        content[2] = json.loads(content[2])
        return cls(*content)


def checksum(values: tuple[Any, ...]) -> str:
    """Return what tells that one of the values before the last has changed on the disk."""
    return hashlib.sha256(json.dumps(values).encode()).hexdigest()[:16]
