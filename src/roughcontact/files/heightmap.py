"""The contents of a file and its statements about a surface, before the user's keywords are applied."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.files.file_errors import ContentError
from roughcontact.validation import Array

__all__ = [
    *("Array", "Channel", "HeightMap", "as_heights", "describe", "names_a_height", "names_something_else"),
    *("line_if_one_row", "pick", "require_line", "require_map"),
]


_MAP = "give a two-dimensional map of heights, rows by columns"
_HEIGHT = re.compile(r"height|topograph|z.?axis|z.?sensor", re.IGNORECASE)
_OTHER = re.compile(
    r"phase|amplitude|deflection|friction|lateral|current|error|voltage|potential|adhesion|stiffness|modulus|force"
    r"|dissipation|intensity|reflect|colou?r|mask",
    re.IGNORECASE,
)


@dataclass(frozen=True, slots=True)
class Channel:
    """One channel of a file.

    Parameters
    ----------
    name : str
        Its name; the second of two equal names carries ``#2``.
    shape : tuple of int
        Number of points (ny, nx); one number for a profile.
    unit : str or float, optional
        Unit of its values, or metres per unit.
    size : tuple of float, optional
        Size (Ly, Lx) [m]; one length for a profile.
    is_height : bool
        Whether it can be read as heights.
    """

    name: str
    shape: tuple[int, ...]
    unit: str | float | None
    size: tuple[float, ...] | None
    is_height: bool


@dataclass(frozen=True, slots=True, eq=False)
class HeightMap:
    """Heights in the unit of the file, and everything else that the file states.

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
        Unit of the heights as the file states it, or metres per unit; None if it states none.
    spacing : tuple of float, optional
        Size of a cell (dy, dx) or (dx,) [m]; None if the file states none.
    steps : tuple of float, optional
        Size of a cell in the unit of the heights, if the file gives numbers without a unit.
    unclear : str, optional
        Statement of the file about its size that is not understood.
    periodic : bool or tuple of bool
        Whether the file states that the surface repeats itself.
    history : tuple of str
        The provenance that the file contains.
    notes, warnings : tuple of str
        Lines for the provenance; the warnings are also issued to the user.
    """

    heights: Array
    format: str
    channel: str | None = None
    unit: str | float | None = None
    spacing: tuple[float, ...] | None = None
    steps: tuple[float, ...] | None = None
    unclear: str | None = None
    periodic: bool | tuple[bool, ...] = False
    history: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()

    def as_channel(self) -> Channel:
        """Describe the heights as the only channel of a file."""
        shape, size = self.heights.shape, None
        if self.spacing is not None:
            size = tuple(step * n for step, n in zip(self.spacing, shape, strict=True))
        return Channel(self.channel or "heights", shape, self.unit, size, is_height=len(shape) == 2)


def as_heights(values: npt.NDArray[Any]) -> Array:
    """Return `values` as heights of a map (ny, nx) or of a line (n,), or refuse them."""
    if values.dtype.kind not in "fiu":
        raise ContentError(f"its values are of type {values.dtype}", "save the heights as real numbers")
    if values.ndim not in (1, 2):
        shape = " x ".join(map(str, values.shape)) or "one number"
        raise ContentError(f"it is {values.ndim}-dimensional ({shape})", _MAP)
    # A damaged file may hold signalling NaN or numbers beyond double precision.
    with np.errstate(all="ignore"):
        return values.astype(np.float64)


def line_if_one_row(found: HeightMap) -> HeightMap:
    """Return the map, or the profile if it holds a single row."""
    if found.heights.shape[0] != 1:
        return found
    spacing = None if found.spacing is None else found.spacing[1:]
    return replace(found, heights=found.heights[0], spacing=spacing)


def require_map(found: HeightMap) -> None:
    """Refuse anything that is not a map of at least 2 x 2 heights."""
    shape = found.heights.shape
    if len(shape) == 1:
        raise ContentError(f"it is a profile of {shape[0]} heights", f"{_MAP}, or use read_line")
    if min(shape) < 2:
        points = " x ".join(map(str, shape))
        raise ContentError(
            f"it holds {points} heights, which is not a map",
            "give a two-dimensional map of at least 2 x 2 heights, or use read_line",
        )


def require_line(found: HeightMap) -> None:
    """Refuse anything that is not a line of at least two heights."""
    shape = found.heights.shape
    if len(shape) != 1:
        points = " x ".join(map(str, shape))
        raise ContentError(f"it is a map of {points} heights, not a profile", "use read")
    if shape[0] < 2:
        raise ContentError(f"it holds {shape[0]} heights", "give a profile of at least 2 heights")


def names_a_height(name: str) -> bool:
    """Whether the name of a channel is that of heights."""
    return _HEIGHT.search(name) is not None and not names_something_else(name)


def names_something_else(name: str) -> bool:
    """Whether the name of a channel is that of another quantity."""
    return _OTHER.search(name) is not None


def describe(channels: Sequence[Channel]) -> str:
    """Return the channels in one line, with their sizes and units, for a message."""
    parts = []
    for channel in channels:
        points = " x ".join(map(str, channel.shape)) or "one number"
        unit = "no unit" if channel.unit is None else channel.unit
        parts.append(f"{channel.name!r} ({points}, {unit})")
    return ", ".join(parts)


def pick(channels: Sequence[Channel], wanted: str | int | None) -> int:
    """Return the position of the `wanted` channel (a name or a position), or of the only height.

    Raises
    ------
    ContentError
        If no channel fits, or if several fit and `wanted` is not given.
    """
    if wanted is None:
        heights = [k for k, channel in enumerate(channels) if channel.is_height]
        if len(heights) == 1:
            return heights[0]
        problem = "several channels may be heights" if heights else "no channel is a map of heights"
        remedy = "give a file with a map of heights"
        if channels:
            remedy = (
                f"pass channel= with the name of {'one of them' if heights else f'the heights, or {remedy}'}"
            )
        place = "channel" if channels else None
        raise ContentError(f"{problem}: {describe(channels) or 'it has none'}", remedy, place)
    if isinstance(wanted, int):
        if 0 <= wanted < len(channels):
            return wanted
    else:
        for same in (str.__str__, str.casefold):
            for k, channel in enumerate(channels):
                if same(channel.name) == same(wanted):
                    return k
    raise ContentError(
        f"it has no channel {wanted!r}, only {describe(channels)}",
        "pass channel= with one of these names",
        "channel",
    )
