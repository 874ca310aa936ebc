"""What a file says about a surface, before the user's keywords are applied."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.files.file_errors import ReadError

__all__ = ["Array", "HeightMap", "as_heights", "require_line", "require_map"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class HeightMap:
    """Heights in the file's own unit, and whatever else the file states.

    Parameters
    ----------
    heights : array, shape (ny, nx) or (n,)
        Heights of a map or of a profile in `unit`; the first row is the top of the picture; NaN where nothing
        was measured.
    format : str
        Name of the format, for the provenance.
    channel : str, optional
        Name of the channel in the file.
    unit : str or float, optional
        Unit of the heights as the file states it, or metres per unit; None where it is silent.
    spacing : tuple of float, optional
        Size of a cell (dy, dx) or (dx,) [m]; None where the file is silent.
    steps : tuple of float, optional
        Size of a cell in the unit of the heights, where the file gives numbers without a unit.
    periodic : bool or tuple of bool
        Whether the file says that the surface repeats itself.
    history : tuple of str
        The provenance that the file itself carries.
    notes, doubts : tuple of str
        Lines for the provenance; doubts are spoken aloud as well.
    """

    heights: Array
    format: str
    channel: str | None = None
    unit: str | float | None = None
    spacing: tuple[float, ...] | None = None
    steps: tuple[float, ...] | None = None
    periodic: bool | tuple[bool, ...] = False
    history: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    doubts: tuple[str, ...] = ()


def as_heights(values: npt.NDArray[Any], file: str) -> Array:
    """Return `values` as heights of a map (ny, nx) or of a line (n,), or refuse them."""
    if values.dtype.kind not in "fiu":
        raise ReadError(file, f"its values are of type {values.dtype}", "save the heights as real numbers")
    if values.ndim not in (1, 2):
        shape = " x ".join(map(str, values.shape)) or "one number"
        raise ReadError(file, f"it is {values.ndim}-dimensional ({shape})", _MAP)
    # A damaged file may hold signalling NaN or numbers beyond double precision.
    with np.errstate(all="ignore"):
        return values.astype(np.float64)


def require_map(found: HeightMap, file: str) -> None:
    """Refuse what is no map of at least 2 x 2 heights."""
    shape = found.heights.shape
    if len(shape) == 1:
        raise ReadError(file, f"it is a profile of {shape[0]} heights", f"{_MAP}, or use read_line")
    if min(shape) < 2:
        points = " x ".join(map(str, shape))
        raise ReadError(
            file,
            f"it holds {points} heights, a profile at most",
            "give a two-dimensional map of at least 2 x 2 heights, or use read_line",
        )


def require_line(found: HeightMap, file: str) -> None:
    """Refuse what is no line of at least two heights."""
    shape = found.heights.shape
    if len(shape) != 1:
        points = " x ".join(map(str, shape))
        raise ReadError(file, f"it is a map of {points} heights, no profile", "use read")
    if shape[0] < 2:
        raise ReadError(file, f"it holds {shape[0]} heights", "give a profile of at least 2 heights")


_MAP = "give a two-dimensional map of heights, rows by columns"
