"""Read the pressure on the face of a joint: a list of points x, y, p."""

from __future__ import annotations

import os
import warnings

from roughcontact.errors import InputError
from roughcontact.files.content import content
from roughcontact.files.file_errors import ContentError, SurfaceWarning
from roughcontact.files.quantity import PRESSURE, parse
from roughcontact.files.xyz import read_xyz
from roughcontact.joints.pressure_field import PressureField

__all__ = ["read_pressure_field"]

_REMEDY = "write the points of a regular grid under a first line such as x [mm], y [mm], p [MPa]"


def read_pressure_field(path: str | os.PathLike[str]) -> PressureField:
    r"""Return the pressure field in a text of points x, y, p on a regular grid, such as finite elements export it.

    The first line names the columns with their units, ``x [mm], y [mm], p [MPa]``. A place of the grid without a point,
    or with the pressure ``nan``, is not part of the face.

    Parameters
    ----------
    path : str or path
        The file: columns separated by commas, semicolons, tabs or blanks.

    Returns
    -------
    PressureField
        The points are the centres of the cells, the row of the smallest y first.

    Raises
    ------
    ReadError
        If the file is missing or damaged, states no units, or its points are not on a regular grid.
    ValueError
        If a pressure is negative.

    Warns
    -----
    SurfaceWarning
        If the file may be cut short.

    Examples
    --------
    >>> import roughcontact as rc
    >>> with open("field.csv", "w") as file:
    ...     _ = file.write("x [mm], y [mm], p [MPa]\n")
    ...     for y in range(3):
    ...         file.writelines(f"{x}, {y}, {10 * x}\n" for x in range(3))
    >>> rc.read_pressure_field("field.csv")
    PressureField(3 x 3 cells, 90 N, at most 2e+07 Pa)
    """
    with content(path) as (file, data):
        found = read_xyz(data)
        if found.spacing is None or found.unit is None:
            raise ContentError("it does not state the units of x, y and p", _REMEDY)
        try:
            unit = parse(f"1 {found.unit}", PRESSURE)
        except InputError as error:
            raise ContentError(error.message, _REMEDY) from error
    for message in found.warnings:
        warnings.warn(f"{file}: {message}", SurfaceWarning, stacklevel=2)
    return PressureField(found.heights * unit, found.spacing)
