"""Read a path of adhesive contact from a file that `write` has written."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import numpy as np

from roughcontact.adhesion.adhesive_curve import CURVE_POINTS, AdhesiveCurve
from roughcontact.adhesion.attraction import LAWS, Adhesion
from roughcontact.adhesion.quasi_static import Jump
from roughcontact.adhesion.state_dataset import jump_columns
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
from roughcontact.validation import Array

__all__ = ["read_adhesive_curve"]

_SCALES = ("modulus", "nominal_area", "rms", "summit_radius")
_SCALARS = (*_SCALES, "unresolved", "adhesion_range", "allow_unresolved")


def read_adhesive_curve(path: str | os.PathLike[str]) -> AdhesiveCurve:
    """Return the path of adhesive contact in a ``.nc`` file that `write` has written.

    Parameters
    ----------
    path : str or path
        The file.

    Returns
    -------
    AdhesiveCurve
        Identical to the last bit to the curve that was written.

    Raises
    ------
    ReadError
        If the file is missing, empty, damaged or holds no such path.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-rings.radii**2 / 2e-5, rings)
    >>> loop = rc.adhesive_loop(ball, 1e8, rc.Adhesion(work=10e-3, range=4e-9), depth=10e-9, points=4)
    >>> rc.write(loop, "loop.nc")
    >>> rc.read_adhesive_curve("loop.nc").jumps == loop.jumps
    True
    """
    with content(path) as (_, data):
        if Path(path).suffix.casefold() != ".nc":
            raise ContentError("paths of surfaces that stick are read from NetCDF files (.nc) only", REMEDY)
        with opened(data) as (variables, attributes):
            return _loop(variables, attributes)


def _loop(variables: Mapping[str, StoredVariable], attributes: Mapping[str, Any]) -> AdhesiveCurve:
    if "interfacial_stiffness" in variables:
        raise ContentError("it holds a curve of surfaces that do not stick", "read it with read_curve")
    control: Literal["depth", "force"] = "force" if "jump_force_bracket" in variables else "depth"
    names = {column.name: name for column, name in jump_columns(control).items()}
    needed = (*CURVE_POINTS, *_SCALARS, *names, "jumped", "work_of_adhesion", "branch", "status", "spacing")
    require_columns(variables, needed)
    geometry, sizes = sizes_of(variables, attributes)
    shape, count = variables["force"].shape, variables[f"jump_{control}_bracket"].shape
    points: dict[str, Any] = {name: numbers_of(variables, name, shape) for name in CURVE_POINTS}
    scalars: dict[str, Any] = {name: float(numbers_of(variables, name, ())) for name in _SCALARS}
    columns = {each: numbers_of(variables, name, count).tolist() for name, each in names.items()}
    branches = [word_of(value) for value in variables["branch"].load().reshape(-1).tolist()]
    if len(branches) != shape[0] or not set(branches) <= {"approach", "retreat"}:
        raise ContentError(f"its branches are {', '.join(sorted(set(branches)))}", REMEDY)
    return AdhesiveCurve(
        **points,
        approach=np.array([word == "approach" for word in branches]),
        jumps=tuple(
            Jump(**_with_truths(dict(zip(columns, row, strict=True))))
            for row in zip(*columns.values(), strict=True)
        ),
        jumped=tuple(int(at) for at in numbers_of(variables, "jumped", count)),
        unresolved=bool(scalars["unresolved"]),
        status=statuses_of(variables["status"], shape),
        control=control,
        adhesion=_adhesion(variables, attributes, scalars),
        tolerance=float(np.ravel(attributes.get("tolerance", np.nan))[0]),
        **{name: scalars[name] for name in _SCALES},
        **sizes,
        geometry=geometry,
    )


def _with_truths(row: dict[str, Any]) -> dict[str, Any]:
    return row | {name: bool(row[name]) for name in ("approach", "ambiguous")}


def _adhesion(
    variables: Mapping[str, StoredVariable], attributes: Mapping[str, Any], scalars: Mapping[str, float]
) -> Adhesion:
    law: Any = word_of(attributes.get("law", ""))
    if law not in LAWS:
        raise ContentError(f"its law of adhesion is {law!r}", REMEDY)
    work = variables["work_of_adhesion"]
    values: Array = numbers_of(variables, "work_of_adhesion", work.shape)
    try:
        return Adhesion(
            float(values) if values.ndim == 0 else values,
            scalars["adhesion_range"],
            law,
            bool(scalars["allow_unresolved"]),
        )
    except ValueError as error:
        raise ContentError(str(error), REMEDY) from error
