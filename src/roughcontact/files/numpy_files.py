"""Heights saved by NumPy, ``.npy`` and ``.npz``: headers are checked before anything is allocated."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from io import BytesIO
from typing import IO, Any

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.files.aside import written_aside
from roughcontact.files.bare_table import heights_alone
from roughcontact.files.file_bounds import unzip
from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import Channel, HeightMap, as_heights, pick
from roughcontact.slabs.agreement import by_each, by_first, entered_by_first
from roughcontact.slabs.slab_array import SlabArray
from roughcontact.surface.surface import Surface
from roughcontact.units import word_of

__all__ = [
    "NpyHeader",
    "list_npz",
    "npy_bytes",
    "npz_bytes",
    "read_npy",
    "read_npy_header",
    "read_npz",
    "whole_npy_header",
    "write_npy",
]

# Keys beside the heights that give the numbers their meaning: lengths in metres, first axis y.
_MEANINGS = ("spacing", "size", "unit", "periodic", "history", "mask")
_MAGIC = b"\x93NUMPY"
_LONGEST = 10_000  # bytes of a header, as in NumPy
# NumPy evaluates the header as Python; arrays of numbers need only these characters, which cannot cause warnings.
# Python 2 wrote 3L.
_DESCR = re.compile(r"""['"]descr['"]\s*:\s*['"]([<>|=]?[biufcSUVmM?]\d*(?:\[\w+\])?)['"]""")
_ORDER = re.compile(r"""['"]fortran_order['"]\s*:\s*(True|False)""")
_SHAPE = re.compile(r"""['"]shape['"]\s*:\s*\(((?:\d{1,18}L?\s*,\s*)*(?:\d{1,18}L?\s*)?)\)""")


@dataclass(frozen=True, slots=True)
class NpyHeader:
    """Type and shape of an array, and the position of its values in the file."""

    dtype: np.dtype[Any]
    shape: tuple[int, ...]
    fortran: bool
    offset: int

    @property
    def points(self) -> int:
        """Number of values."""
        return math.prod(self.shape)

    @property
    def size(self) -> int:
        """Size of header and values [bytes]."""
        return self.offset + self.points * self.dtype.itemsize

    def array(self, data: bytes) -> npt.NDArray[Any]:
        """Return the values in `data`, the whole file, without a copy."""
        values: npt.NDArray[Any] = np.ndarray(
            self.shape, self.dtype, data, self.offset, order="F" if self.fortran else "C"
        )
        return values


def read_npy_header(stream: IO[bytes]) -> NpyHeader:
    """Return the header at the beginning of `stream`.

    Raises
    ------
    ValueError
        If it is damaged, or of an array of objects or named fields.
    """
    start = stream.read(12)
    version = start[6:8]
    if not start.startswith(_MAGIC) or version not in (b"\1\0", b"\2\0", b"\3\0"):
        raise InputError("it does not begin as one")
    wide = version != b"\1\0"
    length = int.from_bytes(start[8:12] if wide else start[8:10], "little")
    offset = length + (12 if wide else 10)
    if length > _LONGEST:
        raise InputError(f"a header of {length} bytes")
    text = (start + stream.read(offset - len(start)))[:offset].decode("latin-1")
    found = [pattern.search(text) for pattern in (_DESCR, _ORDER, _SHAPE)]
    if len(text) < offset or None in found:
        raise InputError("its header is damaged, or of values of no plain type")
    descr, order, shape = (match[1] for match in found if match is not None)
    counts = tuple(int(n.strip().rstrip("L")) for n in shape.split(",") if n.strip())
    try:
        dtype = np.dtype(descr)
    except TypeError as error:
        raise InputError(f"values of type {descr}") from error
    return NpyHeader(dtype, counts, order == "True", offset)


def read_npy(data: bytes) -> HeightMap:
    """Return the one array of a ``.npy`` file; it states neither unit nor size.

    Points, and coordinates beside the heights, are separated from the heights, see ``heights_alone``.
    """
    return heights_alone(HeightMap(as_heights(_array(data)), "npy"))


def read_npz(data: bytes, channel: str | int | None) -> HeightMap:
    """Return one array of a ``.npz`` file.

    The array is `channel`, or the one named ``heights``, or the only map in the file. The keys ``unit`` (a
    name or metres per unit), ``spacing`` (dy, dx) [m], ``size`` (Ly, Lx) [m], ``periodic`` (one truth value, or
    one an axis), ``history`` (lines of text) and ``mask`` (true where not measured, as in NumPy) give its meaning, if
    they are present. Under another key than ``heights`` numbers may be points, or hold coordinates.
    """
    arrays = _arrays(data)
    names = _channels(arrays)
    if channel is None and "heights" in arrays:
        channel = "heights"
    chosen = names[pick(names, channel)].name
    heights = as_heights(arrays[chosen])
    unit, mask = arrays.get("unit"), arrays.get("mask", np.array(False))
    covered = mask.astype(bool) if mask.shape == heights.shape else np.zeros((), dtype=bool)
    masked = f"its key 'mask' marks {np.count_nonzero(covered)} points, which are read as missing"
    found = HeightMap(
        np.where(covered, np.nan, heights),
        "npz",
        channel=chosen,
        unit=None if unit is None else _unit(unit),
        spacing=_spacing(arrays, heights.shape),
        periodic=_periodic(arrays, heights.ndim),
        history=_history(arrays),
        warnings=(masked,) if covered.any() else (),
    )
    return found if chosen == "heights" else heights_alone(found)


def list_npz(data: bytes) -> tuple[Channel, ...]:
    """Return the arrays of a ``.npz`` file, without the keys of its metadata."""
    arrays = _arrays(data)
    unit = _unit(arrays["unit"]) if "unit" in arrays else None
    found = []
    for channel in _channels(arrays):
        size = None
        if channel.is_height and (spacing := _spacing(arrays, channel.shape)) is not None:
            size = tuple(step * n for step, n in zip(spacing, channel.shape, strict=True))
        found.append(
            Channel(channel.name, channel.shape, unit if channel.is_height else None, size, channel.is_height)
        )
    return tuple(found)


def whole_npy_header(stream: IO[bytes], size: int) -> NpyHeader:
    """Return the header of an array that fills a file of `size` bytes exactly, without pickled objects.

    Raises
    ------
    ContentError
        If it does not fill the file.
    """
    try:
        header = read_npy_header(stream)
        if header.size > size:
            raise InputError(f"it holds {size} of {header.size} bytes")
    except (ValueError, OverflowError) as error:
        raise _not_whole(error) from error
    if header.size < size:
        raise ContentError(
            f"{size - header.size} bytes follow the array of {header.shape}: its header is damaged",
            "save it again with numpy.save",
        )
    return header


def _array(data: bytes) -> npt.NDArray[Any]:
    """Return the array in the bytes of a ``.npy`` file."""
    header = whole_npy_header(BytesIO(data), len(data))
    try:
        return header.array(data)
    except (ValueError, OverflowError) as error:
        raise _not_whole(error) from error


def _not_whole(error: Exception) -> ContentError:
    return ContentError(
        f"it is not a whole NumPy array ({error})",
        "save it again with numpy.save, without objects or names of fields",
    )


def _arrays(data: bytes) -> dict[str, npt.NDArray[Any]]:
    members = unzip(data, lambda member: member.endswith(".npy"))
    if not members:
        raise ContentError("it holds no array", "save it with numpy.savez")
    return {name.removesuffix(".npy"): _array(content) for name, content in members.items()}


def _channels(arrays: Mapping[str, npt.NDArray[Any]]) -> tuple[Channel, ...]:
    return tuple(
        Channel(name, a.shape, None, None, a.ndim == 2 and min(a.shape) >= 2 and a.dtype.kind in "fiu")
        for name, a in arrays.items()
        if name not in _MEANINGS
    )


def _unit(value: npt.NDArray[Any]) -> str | float:
    """Return the unit that the file states: a name, or metres per unit."""
    if value.size == 1 and value.dtype.kind in "US":
        return word_of(value.reshape(-1)[0])
    if value.size == 1 and value.dtype.kind in "fiu":
        return float(value.reshape(-1)[0])
    raise ContentError(
        f"its key 'unit' holds {value!r}", "save one name such as 'um', or one number of metres"
    )


def _periodic(arrays: Mapping[str, npt.NDArray[Any]], ndim: int) -> bool | tuple[bool, ...]:
    """Return whether the file states that the surface repeats itself: one value, or one for each axis."""
    value = arrays.get("periodic", np.array(False))
    if value.size not in (1, ndim) or value.dtype.kind not in "biu":
        raise ContentError(f"its key 'periodic' holds {value!r}", "save one truth value, True or False")
    words = tuple(bool(word) for word in value.reshape(-1))
    return words if len(words) == ndim else words[0]


def _history(arrays: Mapping[str, npt.NDArray[Any]]) -> tuple[str, ...]:
    value = arrays.get("history", np.array([], dtype="U1"))
    if value.dtype.kind != "U":
        raise ContentError(f"its key 'history' is of type {value.dtype}", "save lines of text")
    return tuple(map(str, value.flat))


def _spacing(arrays: Mapping[str, npt.NDArray[Any]], shape: tuple[int, ...]) -> tuple[float, ...] | None:
    """Return the cell (dy, dx) or (dx,) [m] from the key ``spacing`` or ``size``; one number serves all axes."""
    for key in ("spacing", "size"):
        if key in arrays:
            value = arrays[key]
            if value.dtype.kind not in "fiu" or value.size not in (1, len(shape)):
                raise ContentError(
                    f"its key {key!r} holds {value!r}", "save one number of metres, or two (y, x)"
                )
            given = tuple(float(v) for v in np.broadcast_to(value.reshape(-1), len(shape)))
            if key == "spacing":
                return given
            # One length is the width of square pixels, as in the keyword `size` of `read`.
            counts = (shape[-1],) * len(shape) if value.size == 1 else shape
            return tuple(length / n for length, n in zip(given, counts, strict=True))
    return None


def npy_bytes(surface: Surface) -> bytes:
    """Return the heights of a surface as a ``.npy`` file."""
    stream = BytesIO()
    np.save(stream, surface.heights)
    return stream.getvalue()


def write_npy(heights: SlabArray, path: str | os.PathLike[str]) -> None:
    """Write heights in slabs like ``numpy.save``: each process writes its rows."""
    functions, mine = heights.functions, np.ascontiguousarray(heights.local, "<f8")
    before = heights.edges[functions.rank] * math.prod(heights.shape[1:]) * mine.itemsize

    with entered_by_first(functions.communicator, lambda: written_aside(path)) as aside:

        def begin() -> int:
            with open(aside, "wb") as file:
                header = {"descr": "<f8", "fortran_order": False, "shape": heights.shape}
                np.lib.format.write_array_header_1_0(file, header)
                start = file.tell()
                file.truncate(start + heights.size * mine.itemsize)
            return start

        start = by_first(functions.communicator, begin)

        def write() -> None:
            with open(aside, "r+b") as file:
                file.seek(start + before)
                file.write(mine.data if mine.size else b"")

        by_each(functions.communicator, write)


def npz_bytes(surface: Surface) -> bytes:
    """Return a surface with all its metadata as a ``.npz`` file."""
    stream = BytesIO()
    np.savez_compressed(
        stream,
        heights=surface.heights,
        spacing=np.array(surface.grid.spacing),
        unit=np.array("m"),
        periodic=np.array(surface.grid.periodic),
        history=np.array(surface.provenance, dtype=np.str_),
    )
    return stream.getvalue()
