"""What a file says about a surface, before the user's keywords are applied."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.files.errors import ReadError

__all__ = ["Array", "HeightMap", "as_heights"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class HeightMap:
    """Heights in the file's own unit, and whatever else the file states.

    Parameters
    ----------
    heights : array, shape (ny, nx)
        Heights in `unit`; the first row is the top of the picture; NaN where nothing was measured.
    format : str
        Name of the format, for the provenance.
    channel : str, optional
        Name of the channel in the file.
    unit : str or float, optional
        Unit of the heights as the file states it, or metres per unit; None where it is silent.
    spacing : tuple of float, optional
        Size of a cell (dy, dx) [m]; None where the file is silent.
    steps : tuple of float, optional
        Size of a cell (dy, dx) in the unit of the heights, where the file gives numbers without a unit.
    periodic : bool
        Whether the file says that the surface repeats itself.
    notes, doubts : tuple of str
        Lines for the provenance; doubts are spoken aloud as well.
    """

    heights: Array
    format: str
    channel: str | None = None
    unit: str | float | None = None
    spacing: tuple[float, float] | None = None
    steps: tuple[float, float] | None = None
    periodic: bool = False
    notes: tuple[str, ...] = ()
    doubts: tuple[str, ...] = ()


def as_heights(values: npt.NDArray[Any], file: str) -> Array:
    """Return `values` as a map of heights (ny, nx), or refuse it."""
    if values.dtype.kind not in "fiu":
        raise ReadError(file, f"its values are of type {values.dtype}", "save the heights as real numbers")
    if values.ndim != 2:
        shape = " x ".join(map(str, values.shape)) or "one number"
        what = "a line scan" if values.ndim == 1 else f"{values.ndim}-dimensional ({shape})"
        raise ReadError(file, f"it is {what}", "give a two-dimensional map of heights, rows by columns")
    if min(values.shape) < 2:
        shape = " x ".join(map(str, values.shape))
        raise ReadError(
            file,
            f"it holds {shape} heights, a line scan at most",
            "give a two-dimensional map of at least 2 x 2 heights",
        )
    with np.errstate(
        all="ignore"
    ):  # a damaged file may hold signalling NaN or numbers beyond double precision
        return values.astype(np.float64)
