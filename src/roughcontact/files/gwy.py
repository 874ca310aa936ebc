"""Gwyddion's own format, ``.gwy``: a tree of named values in which each channel is a field of heights and its mask."""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from roughcontact.errors import InputError
from roughcontact.files.choice import choose, holds_a_profile, marked
from roughcontact.files.file_errors import ContentError, damage
from roughcontact.files.heightmap import Channel, HeightMap, as_heights, line_if_one_row
from roughcontact.files.length_units import is_length, length_factor
from roughcontact.validation import Array

__all__ = ["list_gwy", "read_gwy"]

_MARK = b"GWYP"
_CHANNEL = re.compile(r"/(\d+)/data")
_ATOMS = {"b": "<b", "c": "<c", "i": "<i", "q": "<q", "d": "<d"}
_ARRAYS = {"C": 1, "I": 4, "Q": 8, "D": 8}  # bytes of an item
_AGAIN = "copy the file again, or export it from Gwyddion as text or X3P"


@dataclass(frozen=True, slots=True, eq=False)
class _Field:
    """A channel, its heights, its mask, and what the file states of its sides."""

    channel: Channel
    heights: Array
    mask: Array | None
    sides: str


def read_gwy(data: bytes, channel: str | int | None) -> HeightMap:
    """Return the height channel of the file; points under its mask are missing, as Gwyddion leaves them out."""
    fields = _fields(data)
    channels = marked([field.channel for field in fields])
    index, warnings = choose(channels, 0 if channel is None and holds_a_profile(channels) else channel)
    chosen, field = channels[index], fields[index]
    heights = field.heights
    notes: tuple[str, ...] = ()
    if field.mask is not None and (under := field.mask > 0.5).any():
        heights = np.where(under, np.nan, heights)
        notes = (f"{int(under.sum())} points under its mask count as missing",)
    spacing = None
    if chosen.size is not None:
        spacing = tuple(side / n for side, n in zip(chosen.size, heights.shape, strict=True))
    return line_if_one_row(
        HeightMap(
            as_heights(heights),
            "Gwyddion",
            channel=chosen.name,
            unit=chosen.unit,
            spacing=spacing,
            unclear=field.sides,
            notes=notes,
            warnings=warnings,
        )
    )


def list_gwy(data: bytes) -> tuple[Channel, ...]:
    """Return the channels of the file."""
    return marked([field.channel for field in _fields(data)])


def _fields(data: bytes) -> list[_Field]:
    if not data.startswith(_MARK):
        raise ContentError("it does not begin as a file of Gwyddion", "check its extension")
    with damage("its tree of values is damaged", _AGAIN, (ValueError, KeyError, TypeError, struct.error)):
        name, start, end = _object(data, len(_MARK), len(data))
        if name != "GwyContainer" or end != len(data):
            raise InputError(f"a {name} of {end - start} bytes in a file of {len(data)}")
        items = dict(_items(data, start, end))
        found = [
            _field(data, items, match[0], match[1]) for key in items if (match := _CHANNEL.fullmatch(key))
        ]
    if not found:
        raise ContentError("it holds no channel", "give a file of Gwyddion with a channel of heights")
    return found


def _field(data: bytes, items: dict[str, Any], key: str, number: str) -> _Field:
    heights, values = _values(data, items[key])
    mask = items.get(f"/{number}/mask")
    covered = None if mask is None else _values(data, mask)[0]
    if covered is not None and covered.shape != heights.shape:
        raise InputError(f"a mask of {covered.shape} points over {heights.shape}")
    lateral, unit = (_unit(data, values.get(name)) for name in ("si_unit_xy", "si_unit_z"))
    # Gwyddion ignores the sign of a side, and treats zero as a missing side.
    sides = tuple(abs(float(values.get(name, 0.0))) for name in ("yreal", "xreal"))
    size = None
    if is_length(lateral) and all(sides):
        size = tuple(side * length_factor(lateral or "") for side in sides)
    title = items.get(f"/{number}/data/title")
    return _Field(
        Channel(title if isinstance(title, str) else key, heights.shape, unit, size, is_height=False),
        heights,
        covered,
        f"sides of {sides[1]:g} x {sides[0]:g} (x, y) in {repr(lateral) if lateral else 'no unit'}",
    )


def _values(data: bytes, place: tuple[str, int, int]) -> tuple[Array, dict[str, Any]]:
    """Return the numbers (ny, nx) of a field, and its other values."""
    name, start, end = place
    values = dict(_items(data, start, end))
    nx, ny = values["xres"], values["yres"]
    kind, begin, count = values["data"]
    if name != "GwyDataField" or kind != "D" or min(nx, ny) < 1 or count != nx * ny:
        raise InputError(f"a {name} of {ny} x {nx} points with {count} numbers")
    return np.frombuffer(data, "<f8", count, begin).reshape(ny, nx), values


def _unit(data: bytes, place: tuple[str, int, int] | None) -> str | None:
    """Return the text of a unit, None where it is absent or empty."""
    if place is None:
        return None
    text = dict(_items(data, *place[1:])).get("unitstr")
    return text.strip() or None if isinstance(text, str) else None


def _items(data: bytes, place: int, end: int) -> Iterator[tuple[str, Any]]:
    """Return the items of an object by name: numbers and texts; for arrays and objects their kind and place."""
    while place < end:
        name, place = _text(data, place, end)
        kind, place = data[place : place + 1].decode("latin-1"), place + 1
        value: Any
        if kind in _ATOMS:
            (value,), size = struct.unpack_from(_ATOMS[kind], data, place), struct.calcsize(_ATOMS[kind])
            place += size
        elif kind == "s":
            value, place = _text(data, place, end)
        elif kind == "o":
            value = _object(data, place, end)
            place = value[2]
        elif kind in _ARRAYS:
            (count,) = struct.unpack_from("<I", data, place)
            value = (kind, place + 4, count)
            place += 4 + count * _ARRAYS[kind]
        elif kind in ("S", "O"):
            (count,), value, place = struct.unpack_from("<I", data, place), None, place + 4
            for _ in range(count):
                place = _text(data, place, end)[1] if kind == "S" else _object(data, place, end)[2]
        else:
            raise InputError(f"{name!r} is of the unknown kind {kind!r}")
        if place > end:
            raise InputError(f"{name!r} reaches beyond its object")
        yield name, value


def _object(data: bytes, place: int, end: int) -> tuple[str, int, int]:
    """Return the name of an object, and where its items begin and end."""
    name, place = _text(data, place, end)
    (size,) = struct.unpack_from("<I", data, place)
    if place + 4 + size > end:
        raise InputError(f"a {name} of {size} bytes reaches beyond the end: it is cut short")
    return name, place + 4, place + 4 + size


def _text(data: bytes, place: int, end: int) -> tuple[str, int]:
    """Return a text that a zero byte ends, and where the next value begins."""
    stop = data.find(b"\0", place, end)
    if stop < 0:
        raise InputError("a text has no end")
    return data[place:stop].decode(), stop + 1
