"""Columns of a curve in a NetCDF file: checks that they exist and are numbers, words or outcomes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.files.file_errors import ContentError
from roughcontact.files.netcdf import StoredVariable
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.solver.control import Status
from roughcontact.units import word_of

__all__ = ["REMEDY", "numbers_of", "require_columns", "sizes_of", "statuses_of", "word_of"]

REMEDY = "give a .nc file of a curve that rc.write, or the command line, has written"


def require_columns(variables: Mapping[str, StoredVariable], names: Iterable[str]) -> None:
    """Refuse a file that lacks one of these columns.

    Raises
    ------
    ContentError
        If a column is missing, or no variable lies along ``load``.
    """
    missing = [name for name in names if name not in variables]
    if missing or variables["force"].dimensions != ("load",):
        raise ContentError(f"it holds no loading curve: no {', '.join(missing or ['loads'])}", REMEDY)


def numbers_of(
    variables: Mapping[str, StoredVariable], name: str, shape: tuple[int, ...]
) -> npt.NDArray[np.float64]:
    """Return the numbers of a column, as they were written."""
    variable = variables[name]
    if variable.shape != shape or variable.dtype.kind not in "biuf":
        raise ContentError(
            f"its {name} of shape {variable.shape} and type {variable.dtype} is not that of a curve",
            REMEDY,
        )
    # Unchanged: a NaN in a curve is not a mark of a missing value.
    return np.asarray(variable.load(), dtype=np.float64)


def statuses_of(variable: StoredVariable, shape: tuple[int, ...]) -> tuple[Status, ...]:
    """Return the outcomes in a column of names."""
    words = [word_of(value) for value in variable.load().reshape(-1).tolist()]
    known = {status.value: status for status in Status}
    unknown = [word for word in words if word not in known]
    if unknown or len(words) != shape[0]:
        raise ContentError(f"its status is {unknown or len(words)}, which is not that of a curve", REMEDY)
    return tuple(known[word] for word in words)


def sizes_of(
    variables: Mapping[str, StoredVariable], attributes: Mapping[str, Any]
) -> tuple[Geometry, dict[str, Any]]:
    """Return the kind of the cells, and the sides, the spacing and the periodicity of their grid."""
    kind = word_of(attributes.get("geometry", ""))
    if kind not in {geometry.value for geometry in Geometry}:
        raise ContentError(f"its geometry is {kind!r}", REMEDY)
    geometry = Geometry(kind)
    require_columns(variables, ("lengths", "spacing", "periodic"))
    sizes = {
        name: tuple(numbers_of(variables, name, (len(geometry.axes),)).tolist())
        for name in ("lengths", "spacing", "periodic")
    }
    return geometry, sizes | {"periodic": tuple(bool(value) for value in sizes["periodic"])}
