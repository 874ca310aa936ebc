"""SDF, the format of ISO 25178-71 and of the BCR proposal before it: ``.sdf``, binary or text, in metres."""

from __future__ import annotations

import math
import re
import struct

import numpy as np
import numpy.typing as npt

from roughcontact.files.file_bounds import BYTES_PER_POINT, require_memory
from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights, line_if_one_row
from roughcontact.files.numbers import decode, unended
from roughcontact.validation import Array

__all__ = ["read_sdf"]

_MARK = re.compile(rb"([ab])(ISO|BCR)-([012])\.0")
_TYPES = ("u1", "<u2", "<u4", "<f4", "i1", "<i2", "<i4", "<f8")
_COUNTS = ("NumPoints", "NumProfiles")
_STEPS = ("Xscale", "Yscale", "Zscale")
_FLAGS = ("Compression", "DataType", "CheckType")
_NAMES = (*_COUNTS, *_STEPS, *_FLAGS)
_WORDS = 34  # bytes: the manufacturer and two dates
_OLYMPUS = struct.pack("<2I", 5, 1)  # after the header of files that Olympus software writes
_MISSING = {"bad", "nan"}
_AGAIN = "copy the file again, or export it as X3P"


def read_sdf(data: bytes) -> HeightMap:
    """Return the one map or profile of the file, with its first profile as the first row."""
    mark = _MARK.match(data)
    if mark is None:
        raise ContentError(
            "it does not begin with aISO-1.0, bISO-1.0, aBCR-1.0 or bBCR-1.0", "check its extension"
        )
    binary, old = mark[1] == b"b", mark[2] == b"BCR"
    header, start, text = _binary_header(data, mark) if binary else _text_header(data)
    shape, steps = _checked(header)
    dtype = np.dtype(_TYPES[int(header["DataType"])])
    require_memory(BYTES_PER_POINT * math.prod(shape))
    values, warnings = _binary(data, start, shape, dtype) if binary else _listed(text, shape)
    missing, remarks = _not_measured(values, dtype, old)
    with np.errstate(all="ignore"):
        heights = np.where(missing, np.nan, values * steps[2])
    return line_if_one_row(
        HeightMap(
            as_heights(heights),
            f"SDF {mark[0].decode()}",
            unit="m",
            spacing=(steps[1], steps[0]),
            warnings=(*warnings, *remarks),
        )
    )


def _binary_header(data: bytes, mark: re.Match[bytes]) -> tuple[dict[str, float], int, str]:
    """Return the numbers of a binary header, and where it ends."""
    layout = struct.Struct("<2I4d3B" if mark[3] == b"2" else "<2H4d3B")
    start = mark.end() + _WORDS
    if len(data) < start + layout.size:
        raise ContentError("it ends within its header: it is cut short", _AGAIN)
    nx, ny, dx, dy, dz, _, *flags = layout.unpack_from(data, start)
    header = dict(zip(_NAMES, (nx, ny, dx, dy, dz, *flags), strict=True))
    return header, start + layout.size, ""


def _text_header(data: bytes) -> tuple[dict[str, float], int, str]:
    """Return the numbers of a header in text, by name, and the text after it; a ; begins a comment."""
    text = re.sub(r";[^\n]*", "", decode(data))
    end = re.search(r"^[ \t]*\*", text, re.MULTILINE)
    if end is None:
        raise ContentError("no line with * ends its header: it is cut short", _AGAIN)
    found: dict[str, float] = {}
    for line in text[: end.start()].split("\n")[1:]:
        name, _, value = (part.strip() for part in line.partition("="))
        key = next((key for key in _NAMES if key.casefold() == name.casefold()), None)
        if key is None:
            continue
        if key in found:
            raise ContentError(f"its header states {key} twice", _AGAIN)
        try:
            found[key] = float(value.replace("_", "?"))
        except ValueError:
            raise ContentError(f"its header states {value!r} for {key}", _AGAIN) from None
    if lacking := [key for key in _NAMES if key not in found]:
        raise ContentError(f"its header lacks {', '.join(lacking)}", _AGAIN)
    return found, 0, text[end.end() :]


def _checked(header: dict[str, float]) -> tuple[tuple[int, int], tuple[float, float, float]]:
    """Return (ny, nx) and the steps (x, y, z) [m] of a header; refuse values that are not supported."""
    for name in (*_COUNTS, *_FLAGS):
        least = 1 if name in _COUNTS else 0
        if not (header[name] >= least and header[name] == int(header[name])):
            raise ContentError(f"its header states {header[name]:g} for {name}", _AGAIN)
    for name in ("Compression", "CheckType"):
        if header[name] != 0:
            raise ContentError(f"its header states {header[name]:g} for {name}, not 0", "export it as X3P")
    if header["DataType"] >= len(_TYPES):
        raise ContentError(f"its heights are of type {header['DataType']:g}, not one of 0 to 7", _AGAIN)
    for name in _STEPS:
        # The distance between profiles has no meaning if there is only one.
        alone = name == "Yscale" and header["NumProfiles"] == 1
        if not alone and not (math.isfinite(header[name]) and header[name] > 0):
            raise ContentError(f"its header states {header[name]:g} for {name}", _AGAIN)
    dx, dy, dz = (header[name] for name in _STEPS)
    return (int(header["NumProfiles"]), int(header["NumPoints"])), (dx, dy, dz)


def _binary(
    data: bytes, start: int, shape: tuple[int, int], dtype: np.dtype[np.generic]
) -> tuple[Array, tuple[str, ...]]:
    """Return the numbers after a binary header, and a warning if other bytes than a text follow them."""
    size = math.prod(shape) * dtype.itemsize
    if data[start:].startswith(_OLYMPUS) and len(data) - start == size + len(_OLYMPUS):
        start += len(_OLYMPUS)
    rest = data[start + size :]
    if len(data) < start + size:
        raise ContentError(
            f"it holds {len(data) - start} of {size} bytes of heights: it is cut short", _AGAIN
        )
    warnings: tuple[str, ...] = ()
    if rest and not (rest.isascii() and re.match(rb"\s*[*<\w]", rest) and len(rest) > dtype.itemsize):
        warnings = (f"{len(rest)} bytes at its end belong to no height: its header may be damaged",)
    with np.errstate(all="ignore"):
        values = np.frombuffer(data, dtype, math.prod(shape), start).reshape(shape).astype(np.float64)
    return values, warnings


def _listed(text: str, shape: tuple[int, int]) -> tuple[Array, tuple[str, ...]]:
    """Return the numbers between the end of a header and the next ``*``, NaN for ``BAD``."""
    body, ended, _ = text.partition("*")
    entries = body.split()
    if len(entries) != math.prod(shape):
        raise ContentError(
            f"it holds {len(entries)} heights where its header states {shape[0]} x {shape[1]}", _AGAIN
        )
    values = []
    for index, entry in enumerate(entries):
        try:
            values.append(math.nan if entry.casefold() in _MISSING else float(entry.replace("_", "?")))
        except ValueError:
            raise ContentError(f"its height {index + 1} is {entry[:30]!r}, not a number", _AGAIN) from None
    return np.array(values).reshape(shape), () if ended else unended(text)


def _not_measured(
    values: Array, dtype: np.dtype[np.generic], old: bool
) -> tuple[npt.NDArray[np.bool_], tuple[str, ...]]:
    """Return the points that carry the mark of their type, and a warning if other readers treat that mark as a height.

    ISO 25178-71 uses the lowest number, for unsigned ones the highest; the BCR proposal uses the highest, but files
    with its mark and the lowest number exist. A range of 256 steps leaves no room for a mark that all readers agree
    on.
    """
    missing = np.isnan(values)
    if dtype.kind == "f":
        # In text the lowest and highest numbers are rounded.
        return missing | (np.abs(values) > (1 - 1e-6) * float(np.finfo(dtype.name).max)), ()
    limits = np.iinfo(dtype.name)
    lowest, highest = values == limits.min, values == limits.max
    if dtype.itemsize == 1:
        count = int(np.count_nonzero(highest if dtype.kind == "u" else lowest))
        end = limits.max if dtype.kind == "u" else limits.min
        return missing, (
            (f"{count} points hold {end}, which may mark what was not measured, and are read as heights",)
            if count
            else ()
        )
    if dtype.kind == "u":
        return missing | highest, ()
    if not old:
        return missing | lowest, ()
    count = int(np.count_nonzero(lowest | highest))
    warning = f"{count} points hold the lowest or highest number of their type and count as not measured"
    return missing | lowest | highest, (warning,) if count else ()
