"""Read a curve of detachment from a file that `write` has written."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import numpy as np

from roughcontact.adhesion.detachment import Detachment
from roughcontact.adhesion.detachment_curve import CURVE_POINTS, DetachmentCurve
from roughcontact.adhesion.detachment_dataset import DETACHMENT_NAMES
from roughcontact.files.content import content
from roughcontact.files.file_errors import ContentError
from roughcontact.files.netcdf import StoredVariable, opened
from roughcontact.files.stored_columns import (
    REMEDY,
    numbers_of,
    require_columns,
    sizes_of,
    statuses_of,
)
from roughcontact.units import word_of

__all__ = ["read_detachment_curve"]

_SCALES = ("modulus", "nominal_area", "rms", "preload_too_small")


def read_detachment_curve(path: str | os.PathLike[str]) -> DetachmentCurve:
    """Return the curve of detachment in a ``.nc`` file that `write` has written.

    Parameters
    ----------
    path : str or path
        The file.

    Returns
    -------
    DetachmentCurve
        Identical to the last bit to the curve that was written.

    Raises
    ------
    ReadError
        If the file is missing, empty, damaged or holds no such curve.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-rings.radii**2 / 2e-5, rings)
    >>> curve = rc.detachment_curve(rc.press(ball, 1e8, depth=2e-8), 10e-3)
    >>> rc.write(curve, "detachment.nc")
    >>> rc.read_detachment_curve("detachment.nc").detachments == curve.detachments
    True
    """
    with content(path) as (_, data):
        if Path(path).suffix.casefold() != ".nc":
            raise ContentError("curves of stuck surfaces are read from NetCDF files (.nc) only", REMEDY)
        with opened(data) as (variables, attributes):
            return _curve(variables, attributes)


def _curve(variables: Mapping[str, StoredVariable], attributes: Mapping[str, Any]) -> DetachmentCurve:
    names = {column.name: name for column, name in DETACHMENT_NAMES.items()}
    needed = (*CURVE_POINTS, *_SCALES, *names, "detached_at", "work_of_adhesion", "status")
    require_columns(variables, needed)
    geometry, sizes = sizes_of(variables, attributes)
    shape, count = variables["force"].shape, variables["detached_at"].shape
    control: Literal["depth", "force"] = "force" if word_of(attributes.get("control")) == "force" else "depth"
    events = [numbers_of(variables, name, count).tolist() for name in names]
    rows = [dict(zip(names.values(), row, strict=True)) for row in zip(*events, strict=True)]
    scales: dict[str, Any] = {name: float(numbers_of(variables, name, ())) for name in _SCALES}
    work = numbers_of(variables, "work_of_adhesion", variables["work_of_adhesion"].shape)
    notes = word_of(attributes.get("notes", ""))
    points: dict[str, Any] = {name: numbers_of(variables, name, shape) for name in CURVE_POINTS}
    return DetachmentCurve(
        **points,
        status=statuses_of(variables["status"], shape),
        detachments=tuple(Detachment(**row | {"cells": int(row["cells"])}) for row in rows),
        detached_at=tuple(int(at) for at in numbers_of(variables, "detached_at", count)),
        notes=tuple(notes.splitlines()),
        control=control,
        work=float(work) if work.ndim == 0 else work,
        tolerance=float(np.ravel(attributes.get("tolerance", np.nan))[0]),
        **scales | {"preload_too_small": bool(scales["preload_too_small"])},
        **sizes,
        geometry=geometry,
    )
