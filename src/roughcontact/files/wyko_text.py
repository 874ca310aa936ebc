"""Wyko's text: lines of name, type, length and value, then blocks; ``RAW_DATA`` holds heights in wavelengths."""

from __future__ import annotations

import math

from roughcontact.files.fields import number_of
from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.files.number_stream import grid_of

__all__ = ["read_wyko"]

_HEIGHTS = ("raw_data", "raw data", "sample_data", "opd")
_NANOMETRE, _MILLIMETRE = 1e-9, 1e-3


def read_wyko(text: str) -> HeightMap:
    """Return the heights of a text, its lines as rows; the wavelength is in nanometres, the side of a cell in mm."""
    lines = text.split("\n")
    parts = [[field.strip() for field in line.split("\t")] for line in lines]
    start = next((k for k, line in enumerate(parts) if line[0].casefold() in _HEIGHTS), None)
    if start is None:
        raise ContentError("it is a Wyko text without heights (RAW_DATA)", "export it with its raw data")
    stated = {line[0].casefold(): number_of(line[-1]) for line in parts[:start] if len(line) > 1}
    ny, nx = (stated.get(name, math.nan) for name in ("x size", "y size"))
    if not (1 <= ny <= 1e9 and 1 <= nx <= 1e9):
        raise ContentError("it states no X Size and Y Size", "export it again")
    fields = [field for line in lines[start + 1 : start + 1 + int(ny)] for field in line.split()]
    heights, notes, warnings = grid_of(fields, (int(ny), int(nx)))
    in_nanometres = lines[0].split()[-2:-1] == ["1"]  # the second of three flags
    waves = 1.0 if in_nanometres else stated.get("wavelength", math.nan) / stated.get("mult", 1.0)
    if not (math.isfinite(waves) and waves > 0):
        raise ContentError(f"it states a wavelength over Mult of {waves:g}", "export it again")
    side = abs(stated.get("pixel_size", math.nan)) * _MILLIMETRE
    return HeightMap(
        as_heights(heights),
        "Wyko text",
        unit=waves * _NANOMETRE,
        spacing=None if math.isnan(side) else (side, side * stated.get("aspect", 1.0)),
        notes=(*notes, "its lines, positions along its X, are the rows"),
        warnings=warnings,
    )
