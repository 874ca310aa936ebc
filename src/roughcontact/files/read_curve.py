"""Read a loading curve back from the file that `write` made of it."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.contact.curve import Curve
from roughcontact.contact.flow_curve import FlowCurve
from roughcontact.files.content import content
from roughcontact.files.file_errors import ContentError
from roughcontact.files.netcdf import StoredVariable, opened
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.variables import CURVE_POINTS, CURVE_SCALES, FLOW_POINTS
from roughcontact.solver.control import Status

__all__ = ["read_curve"]

_ARRAYS = (*CURVE_POINTS, "residual", "stiffness_residual")
_SIZES = ("lengths", "spacing", "periodic")
_REMEDY = "give a .nc file that rc.write, or the command line, made of a curve"


def read_curve(path: str | os.PathLike[str]) -> Curve:
    """Return the loading curve in a ``.nc`` file that `write` made of it.

    Columns that others have added to the file, such as theories and conductances, are passed over.

    Parameters
    ----------
    path : str or path
        The file.

    Returns
    -------
    Curve
        To the last bit the one that was written.

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
            raise ContentError("loading curves are read from NetCDF files (.nc) only", _REMEDY)
        with opened(data) as (variables, attributes):
            return _curve(variables, attributes)


def _curve(variables: Mapping[str, StoredVariable], attributes: Mapping[str, Any]) -> Curve:
    _require(variables, (*_ARRAYS, *CURVE_SCALES, *_SIZES, "spots", "status"))
    kind = _word(attributes.get("geometry", ""))
    if kind not in {geometry.value for geometry in Geometry}:
        raise ContentError(f"its geometry is {kind!r}", _REMEDY)
    geometry = Geometry(kind)
    shape, axes = variables["force"].shape, (len(geometry.axes),)
    values: dict[str, Any] = {name: _numbers(variables, name, shape) for name in _ARRAYS}
    values |= {name: float(_numbers(variables, name, ())) for name in CURVE_SCALES}
    sizes = {name: _numbers(variables, name, axes).tolist() for name in _SIZES}
    hardness = float(_numbers(variables, "hardness", ())) if "hardness" in variables else math.inf
    flow = None
    if FLOW_POINTS[0] in variables:
        _require(variables, FLOW_POINTS)
        flow = FlowCurve(*(_numbers(variables, name, shape) for name in FLOW_POINTS))
    return Curve(
        **values,
        spots=_numbers(variables, "spots", shape).astype(np.intp),
        status=_statuses(variables["status"], shape),
        lengths=tuple(sizes["lengths"]),
        spacing=tuple(sizes["spacing"]),
        periodic=tuple(bool(value) for value in sizes["periodic"]),
        geometry=geometry,
        hardness=hardness,
        flow=flow,
    )


def _require(variables: Mapping[str, StoredVariable], names: Iterable[str]) -> None:
    missing = [name for name in names if name not in variables]
    if missing or variables["force"].dimensions != ("load",):
        raise ContentError(f"it holds no loading curve: no {', '.join(missing or ['loads'])}", _REMEDY)


def _numbers(
    variables: Mapping[str, StoredVariable], name: str, shape: tuple[int, ...]
) -> npt.NDArray[np.float64]:
    variable = variables[name]
    if variable.shape != shape or variable.dtype.kind not in "biuf":
        raise ContentError(
            f"its {name} of shape {variable.shape} and type {variable.dtype} is not that of a curve",
            _REMEDY,
        )
    # As they were written: a NaN of ours is no mark of a missing value.
    return np.asarray(variable.load(), dtype=np.float64)


def _statuses(variable: StoredVariable, shape: tuple[int, ...]) -> tuple[Status, ...]:
    words = [_word(value) for value in variable.load().reshape(-1).tolist()]
    known = {status.value: status for status in Status}
    unknown = [word for word in words if word not in known]
    if unknown or len(words) != shape[0]:
        raise ContentError(f"its status is {unknown or len(words)}, which is not that of a curve", _REMEDY)
    return tuple(known[word] for word in words)


def _word(value: Any) -> str:
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)
