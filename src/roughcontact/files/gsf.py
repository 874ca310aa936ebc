"""Gwyddion's simple field: lines ``name = value`` and the heights in single precision."""

from __future__ import annotations

import math
import re

import numpy as np

from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights, line_if_one_row
from roughcontact.files.length_units import is_length, length_factor
from roughcontact.files.numbers import decode

__all__ = ["read_gsf"]

_MARK = b"Gwyddion Simple Field 1.0"
_AGAIN = "export it from Gwyddion again"


def read_gsf(data: bytes) -> HeightMap:
    """Return the one map of the file, NaN where nothing was measured; numbers of points fit its length exactly."""
    if not data.startswith(_MARK):
        raise ContentError("it does not begin as a simple field of Gwyddion", "check its extension")
    # At least one zero ends the header; zeros fill it up to a multiple of four.
    end = data.find(b"\0")
    if end < 0:
        raise ContentError("no zero byte ends its header: it is cut short", _AGAIN)
    start = (end // 4 + 1) * 4
    fields = _fields(data[:end])
    shape = _count(fields, "YRes"), _count(fields, "XRes")
    expected = 4 * math.prod(shape)
    if data[end:start].strip(b"\0") or len(data) - start != expected:
        raise ContentError(
            f"its heights take {len(data) - start} bytes where {shape[0]} x {shape[1]} points need {expected}",
            _AGAIN,
        )
    heights = as_heights(np.frombuffer(data, "<f4", offset=start).reshape(shape))
    sides = _side(fields, "YReal"), _side(fields, "XReal")
    unit = fields.get("XYUnits", "")
    spacing, unclear = None, None
    if sides[0] is not None and sides[1] is not None:
        unclear = f"sides of {sides[1]:g} x {sides[0]:g} (x, y) in {repr(unit) if unit else 'no unit'}"
        if is_length(unit):
            factor = length_factor(unit)
            spacing = (sides[0] * factor / shape[0], sides[1] * factor / shape[1])
    return line_if_one_row(
        HeightMap(
            heights,
            "Gwyddion simple field",
            channel=fields.get("Title") or None,
            unit=fields.get("ZUnits") or None,
            spacing=spacing,
            unclear=unclear,
        )
    )


def _fields(header: bytes) -> dict[str, str]:
    fields: dict[str, str] = {}
    for line in decode(header).split("\n")[1:]:
        name, equals, value = (part.strip() for part in line.partition("="))
        if name and (not equals or name in fields):
            what = "states twice" if equals else "holds a line without ="
            raise ContentError(f"its header {what}: {name[:40]!r}", _AGAIN)
        fields[name] = value
    return fields


def _count(fields: dict[str, str], name: str) -> int:
    text = fields.get(name, "")
    digits = text.lstrip("0")
    # A positive whole number of up to ten digits.
    if re.fullmatch("[1-9][0-9]{0,9}", digits) is None:
        raise ContentError(f"its header states {text!r} for {name}", _AGAIN)
    return int(digits)


def _side(fields: dict[str, str], name: str) -> float | None:
    """Return a side in the unit of the file, or None: if its header lacks it, the side was not measured."""
    text = fields.get(name)
    if text is None:
        return None
    try:
        side = float(text)
    except ValueError:
        side = math.nan
    if not (math.isfinite(side) and side > 0):
        raise ContentError(f"its header states {text!r} for {name}", _AGAIN)
    return side
