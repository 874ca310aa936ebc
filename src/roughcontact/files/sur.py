"""Digital Surf's format, ``.sur`` for maps and ``.pro`` for profiles, plain or compressed."""

from __future__ import annotations

import math
import struct
import zlib
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.files.file_bounds import BYTES_PER_POINT, require_memory
from roughcontact.files.file_errors import ContentError, damage
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.files.length_units import is_length, length_factor
from roughcontact.files.numbers import decode
from roughcontact.validation import Array

__all__ = ["read_sur"]

# The header: 512 bytes, little-endian, without gaps.
_HEADER = np.dtype(
    [
        ("magic", "S12"),
        *((name, "<i2") for name in ("byte_order", "objects", "version", "kind")),
        ("name", "S30"),
        ("operator", "S30"),
        *((name, "<i2") for name in ("material", "acquisition", "range", "special_points", "absolute")),
        ("reserved_1", "V8"),
        ("bits", "<i2"),
        *((name, "<i4") for name in ("lowest", "highest", "nx", "ny", "points")),
        *((name, "<f4") for name in ("dx", "dy", "dz")),
        *((name, "S16") for name in ("x_name", "y_name", "z_name")),
        *((name, "S16") for name in ("dx_unit", "dy_unit", "dz_unit", "x_unit", "y_unit", "z_unit")),
        *((name, "<f4") for name in ("x_ratio", "y_ratio", "z_ratio")),
        *((name, "<i2") for name in ("imprint", "inversion", "levelling")),
        ("reserved_2", "V12"),
        ("date", "<i2", 7),
        ("duration", "<f4"),
        ("packed", "<u4"),
        ("reserved_3", "V6"),
        *((name, "<u2") for name in ("comment", "private")),
        ("client", "V128"),
        *((name, "<f4") for name in ("x_offset", "y_offset", "z_offset")),
        ("reserved_4", "V34"),
    ]
)
_PROFILE, _SURFACE = 1, 2
_AGAIN = "copy the file again, or export it as X3P"


def read_sur(data: bytes) -> HeightMap:
    """Return the one map or profile of the file; its heights are whole numbers of a stated step."""
    header = _header(data)
    counts, unread = _counts(data, header)
    notes: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    if unread:
        warnings = (f"{unread} bytes at its end belong to no height: its header may be damaged",)
    missing = np.zeros(counts.shape, dtype=np.bool_)
    if header["special_points"] == 1:
        missing = counts == int(header["lowest"]) - 2
    outside = ~missing & ((counts < header["lowest"]) | (counts > header["highest"]))
    if outside.any():
        warnings = (*warnings, f"{int(outside.sum())} heights lie outside the range that its header states")
    heights: Array = np.where(missing, np.nan, counts * float(header["dz"]))
    if (inversion := int(header["inversion"])) in (1, 2, 3):
        # Modes 2 and 3 also mirror; read in the same way as by Gwyddion.
        heights = -{1: heights, 2: heights[:, ::-1], 3: heights[::-1]}[inversion]
        notes = (f"the file marks its heights as inverted (mode {inversion}): turned back",)
    steps = (float(header["dy"]), float(header["dx"]))
    units = (_text(header["dy_unit"]), _text(header["dx_unit"]))
    spacing: tuple[float, ...] | None = None
    if all(map(is_length, units)):
        spacing = (steps[0] * length_factor(units[0]), steps[1] * length_factor(units[1]))
    if header["kind"] == _PROFILE and len(heights) == 1:
        heights = heights[0]
        spacing = (steps[1] * length_factor(units[1]),) if is_length(units[1]) else None
    elif header["kind"] == _PROFILE:
        notes = (*notes, f"of type 1 (profile) with {len(heights)} lines: a map, as Gwyddion exports it")
    return HeightMap(
        as_heights(heights),
        "Digital Surf",
        channel=_text(header["z_name"]) or None,
        unit=_text(header["dz_unit"]) or None,
        spacing=spacing,
        notes=notes,
        warnings=warnings,
    )


def _header(data: bytes) -> Any:
    """Return the header; each statement that affects the data is checked."""
    if not data.startswith((b"DIGITAL SURF", b"DSCOMPRESSED")) or len(data) < _HEADER.itemsize:
        raise ContentError("it has no whole header of Digital Surf", _AGAIN)
    header = np.frombuffer(data, dtype=_HEADER, count=1)[0]
    if header["byte_order"] != 0 or header["objects"] != 1:
        raise ContentError(
            f"it holds {header['objects']} objects in byte order {header['byte_order']}, not one in order 0",
            "export one surface as X3P",
        )
    if header["kind"] not in (_PROFILE, _SURFACE):
        raise ContentError(
            f"it holds a study of type {header['kind']}, not a surface (2)", "give a map of heights"
        )
    ny, nx = int(header["ny"]), int(header["nx"])
    if header["bits"] not in (16, 32) or min(ny, nx) < 1 or ny * nx != header["points"]:
        raise ContentError(
            f"its header states {ny} x {nx} points of {header['bits']} bits, {header['points']} in all",
            _AGAIN,
        )
    if not all(math.isfinite(header[name]) and header[name] > 0 for name in ("dx", "dy", "dz")):
        steps = ", ".join(f"{header[name]:g}" for name in ("dx", "dy", "dz"))
        raise ContentError(f"its header states steps of {steps} (x, y, z)", _AGAIN)
    return header


def _counts(data: bytes, header: Any) -> tuple[npt.NDArray[np.int64], int]:
    """Return the whole numbers (ny, nx) after the header and its two appendices, and the number of bytes left."""
    dtype = np.dtype(f"<i{header['bits'] // 8}")
    expected = int(header["points"]) * dtype.itemsize
    rest = data[_HEADER.itemsize + int(header["comment"]) + int(header["private"]) :]
    unread = max(0, len(rest) - expected)
    if header["magic"] == b"DSCOMPRESSED":
        require_memory(BYTES_PER_POINT * int(header["points"]))
        rest, unread = _unpacked(rest, expected)
    if len(rest) < expected:
        raise ContentError(f"it holds {len(rest)} of {expected} bytes of heights: it is cut short", _AGAIN)
    counts = np.frombuffer(rest, dtype=dtype, count=int(header["points"])).astype(np.int64)
    return counts.reshape(int(header["ny"]), int(header["nx"])), unread


def _unpacked(packed: bytes, expected: int) -> tuple[bytes, int]:
    """Return the contents of the zlib streams after a table of their lengths, and the number of bytes after them.

    Each stream is checked by its checksum.
    """
    with damage("its compressed heights are damaged", _AGAIN, (struct.error, zlib.error, ValueError)):
        (streams,) = struct.unpack_from("<I", packed)
        place, parts, left = 4 + 8 * streams, [], expected
        for whole, part in struct.iter_unpack("<II", packed[4:place]):
            unpacker = zlib.decompressobj()
            parts.append(unpacker.decompress(packed[place : place + part], min(whole, left) + 1))
            if len(parts[-1]) != whole or not unpacker.eof:
                raise InputError(f"a stream holds {len(parts[-1])} bytes where its table states {whole}")
            place += part
            left -= min(whole, left)
    unpacked = b"".join(parts)
    return unpacked, len(packed) - place + max(0, len(unpacked) - expected)


def _text(field: bytes) -> str:
    return decode(field.split(b"\0")[0]).strip()
