"""Read a measured surface from a file."""

from __future__ import annotations

import hashlib
import os
import warnings

from roughcontact.files.assemble import Length, Size, assemble, cell_of
from roughcontact.files.dispatch import content, height_map
from roughcontact.files.errors import SurfaceWarning
from roughcontact.files.units import length_factor
from roughcontact.surface.surface import Surface

__all__ = ["read"]


def read(
    path: str | os.PathLike[str],
    *,
    channel: str | int | None = None,
    unit: Length | None = None,
    size: Size | None = None,
    periodic: bool | tuple[bool, bool] | None = None,
) -> Surface:
    """Return the surface in a file: heights [m], rows from the top of the picture, NaN where not measured.

    ``.npy``, ``.npz``, ``.txt``, ``.csv``, ``.tsv``, ``.asc``, ``.xyz`` and ``.x3p`` are read strictly; every
    other format needs SurfaceTopography, ``pip install roughcontact[formats]``.

    Parameters
    ----------
    path : str or path
        The file.
    channel : str or int, optional
        Name of the channel, or its position counted from 0. Without it the height is found by name and unit.
    unit : str or float, optional
        Unit of the heights in the file, such as ``"nm"``, or metres per unit. It goes before what the file
        states.
    size : length or pair of lengths, optional
        Width Lx of a map of square cells, or ``(Ly, Lx)``: numbers [m] or texts such as ``"10 um"``. Lengths
        are those of all cells, ``n * spacing``. It goes before what the file states.
    periodic : bool or pair of bool, optional
        Whether the surface repeats itself (along y and x). Without it the file decides; one that is silent
        is read as free.

    Returns
    -------
    Surface
        Not levelled; its provenance names the file, the format, the channel and the start of its SHA-256.

    Raises
    ------
    ReadError
        If the file is missing, empty, damaged, not a map, or silent about a unit or size not given here.
    ValueError
        If `unit` or `size` is not a length.

    Warns
    -----
    SurfaceWarning
        If several channels may be meant, or if the size or the heights are hardly those of a surface.
    """
    if unit is not None:
        length_factor(unit)  # a wrong keyword is refused before the file is touched
    if size is not None:
        cell_of(size, (1, 1))
    file, data = content(path)
    found = height_map(data, file, channel)
    digest = hashlib.sha256(data).hexdigest()[:16]
    surface, doubts = assemble(found, file, digest, unit=unit, size=size, periodic=periodic)
    for doubt in doubts:
        warnings.warn(f"{file}: {doubt}", SurfaceWarning, stacklevel=2)
    return surface
