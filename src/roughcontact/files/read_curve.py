"""Read a loading curve from a file that `write` has written."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from roughcontact.contact.curve import CURVE_POINTS, Curve
from roughcontact.contact.flow_curve import FlowCurve
from roughcontact.files.content import content
from roughcontact.files.file_errors import ContentError
from roughcontact.files.netcdf import StoredVariable, opened
from roughcontact.files.stored_columns import REMEDY, numbers_of, require_columns, sizes_of, statuses_of
from roughcontact.labels.column import names_of
from roughcontact.labels.contact_columns import CERTIFICATES, FLOW, SCALES
from roughcontact.labels.note import Note, Rank
from roughcontact.units import word_of

__all__ = ["read_curve"]

_ARRAYS = (*CURVE_POINTS, *names_of(CERTIFICATES))
_SCALES, _FLOW = names_of(SCALES), names_of(FLOW)


def read_curve(path: str | os.PathLike[str]) -> Curve:
    """Return the loading curve in a ``.nc`` file that `write` has written.

    Further columns of the file, such as theories and conductances, are ignored.

    Parameters
    ----------
    path : str or path
        The file.

    Returns
    -------
    Curve
        Identical to the last bit to the curve that was written.

    Raises
    ------
    ReadError
        If the file is missing, empty, damaged or holds no loading curve.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> rc.write(rc.loading_curve(ball, 1e9, forces=[1e-3, 2e-3]), "curve.nc")
    >>> len(rc.read_curve("curve.nc"))
    2
    """
    with content(path) as (_, data):
        if Path(path).suffix.casefold() != ".nc":
            raise ContentError("loading curves are read from NetCDF files (.nc) only", REMEDY)
        with opened(data) as (variables, attributes):
            return _curve(variables, attributes)


def _curve(variables: Mapping[str, StoredVariable], attributes: Mapping[str, Any]) -> Curve:
    if "jump_lost" in variables:
        raise ContentError("it holds a path of surfaces that stick", "read it with read_adhesive_curve")
    require_columns(variables, (*_ARRAYS, *_SCALES, "spots", "status"))
    geometry, sizes = sizes_of(variables, attributes)
    shape = variables["force"].shape
    values: dict[str, Any] = {name: numbers_of(variables, name, shape) for name in _ARRAYS}
    values |= {name: float(numbers_of(variables, name, ())) for name in _SCALES}
    hardness = float(numbers_of(variables, "hardness", ())) if "hardness" in variables else math.inf
    flow = None
    if _FLOW[0] in variables:
        require_columns(variables, _FLOW)
        flow = FlowCurve(*(numbers_of(variables, name, shape) for name in _FLOW))
    return Curve(
        **values,
        spots=numbers_of(variables, "spots", shape).astype(np.intp),
        status=statuses_of(variables["status"], shape),
        **sizes,
        geometry=geometry,
        hardness=hardness,
        flow=flow,
        measured={name: numbers_of(variables, name, shape) for name in _measured(attributes)},
        state_notes=tuple(map(_note, word_of(attributes.get("state_notes", "")).splitlines())),
    )


def _measured(attributes: Mapping[str, Any]) -> list[str]:
    """Return the names of the columns that measures have added."""
    return [word_of(name) for name in np.atleast_1d(attributes.get("measured", ())).tolist()]


def _note(line: str) -> tuple[float, Note]:
    """Return the force and the note of a line such as ``"wrong at 2.5: text"``."""
    load, _, text = line.partition(": ")
    rank, _, force = load.partition(" at ")
    if rank.upper() not in Rank.__members__:
        raise ContentError(f"its note {line[:60]!r} has no known rank", REMEDY)
    return float(force), Note(Rank[rank.upper()], text)
