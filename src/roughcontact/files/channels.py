"""The channels of a file, and which of them is the height."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from roughcontact.files.file_errors import ReadError

__all__ = ["Channel", "describe", "names_a_height", "names_something_else", "pick"]

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


def names_a_height(name: str) -> bool:
    """Whether a channel's name speaks of heights."""
    return _HEIGHT.search(name) is not None and not names_something_else(name)


def names_something_else(name: str) -> bool:
    """Whether a channel's name speaks of another quantity."""
    return _OTHER.search(name) is not None


def describe(channels: Sequence[Channel]) -> str:
    """Return the channels in one line, with their sizes and units, for a message."""
    parts = []
    for channel in channels:
        points = " x ".join(map(str, channel.shape)) or "one number"
        unit = "no unit" if channel.unit is None else channel.unit
        parts.append(f"{channel.name!r} ({points}, {unit})")
    return ", ".join(parts)


def pick(channels: Sequence[Channel], wanted: str | int | None, file: str) -> int:
    """Return the position of the `wanted` channel (a name or a position), or of the only height.

    Raises
    ------
    ReadError
        If no channel fits, or if several do and none is wanted.
    """
    if wanted is None:
        heights = [k for k, channel in enumerate(channels) if channel.is_height]
        if len(heights) == 1:
            return heights[0]
        problem = "several channels may be heights" if heights else "no channel is a map of heights"
        remedy = (
            "pass channel= with the name of one of them" if heights else "give a file with a map of heights"
        )
        raise ReadError(file, f"{problem}: {describe(channels)}", remedy)
    if isinstance(wanted, int):
        if 0 <= wanted < len(channels):
            return wanted
    else:
        for same in (str.__str__, str.casefold):
            for k, channel in enumerate(channels):
                if same(channel.name) == same(wanted):
                    return k
    raise ReadError(
        file,
        f"it has no channel {wanted!r}, only {describe(channels)}",
        "pass channel= with one of these names",
    )
