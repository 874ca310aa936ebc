"""Every other format, through SurfaceTopography, whose results are all checked."""

from __future__ import annotations

import codecs
import logging
import math
import re
import sys
from collections.abc import Iterator
from contextlib import closing, contextmanager
from contextvars import ContextVar
from dataclasses import replace
from typing import Any

import numpy as np

from roughcontact.files.bare_table import heights_alone
from roughcontact.files.block_ends import left_behind_blocks
from roughcontact.files.choice import AS_TEXT, choose, marked
from roughcontact.files.file_bounds import BYTES_PER_POINT, BoundedStream, require_memory
from roughcontact.files.file_errors import ContentError, damage
from roughcontact.files.hdf5 import is_hdf5, opened_hdf5
from roughcontact.files.heightmap import Channel, HeightMap, as_heights
from roughcontact.files.length_units import is_length, length_factor
from roughcontact.files.matlab import require_whole
from roughcontact.files.nanoscope import height_factors
from roughcontact.validation import Array

__all__ = ["NOT_FOREIGN", "brief", "list_foreign", "read_foreign", "unlogged", "without_reader"]


# Formats with a reader in this package: under another extension SurfaceTopography would use a more lenient reader.
_OURS = {
    **{"npy": ".npy", "npz": ".npz", "x3p": ".x3p"},
    **{"nc": ".nc", "sur": ".sur", "gwy": ".gwy", "sdf": ".sdf", "tmd": ".tmd"},
}
_TEXTS = {"asc", "matrix", "xyz"}
NOT_FOREIGN = {*_OURS, *_TEXTS}  # formats that SurfaceTopography could read but is not used for
# Formats without a mark at the beginning, whose readers also accept bytes of others: used only for their extension.
_UNMARKED = {".hgt": "hgt", ".nms": "nms"}
# Formats whose lateral size comes out wrong (by 1e6): the size must be given.
_SIZE_UNRELIABLE = {"nms"}
# Containers of bare matrices, whose rows are the rows of the picture; all other formats have the indices [x, y].
_MATRICES = {"mat", "h5"}
# Formats without a checksum whose last channel ends at the end of the file, which reveals a damaged number of points.
_FILLED = {"di", "metropro", "mi", "wsxm"}
# Formats whose factor from counts to heights is a product of positive numbers: a wavelength, an obliquity, a share.
_UPRIGHT = {"metropro"}
# Number of bytes within which every format with a mark has its mark.
_BEGINNING = 512
# Their log messages about a damaged file, up to megabytes, are of no use to the user. Only messages of this thread
# during reading are suppressed: the settings of the process stay as they are.
_TALKATIVE = ("tifffile", "igor2.binarywave")
_READING: ContextVar[bool] = ContextVar("_READING", default=False)
# Of all texts, only those in UTF-16 hold zero bytes; the library recognises them by these marks.
_WIDE = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_EXPORT = "export it as X3P, Gwyddion text or .npz"
_REMEDY = f"check that the file is whole, or {_EXPORT}"


def _unless_reading(_: logging.LogRecord) -> bool:
    return not _READING.get()


for _name in _TALKATIVE:
    logging.getLogger(_name).addFilter(_unless_reading)


class _Binary(BoundedStream):
    """The content of a file that is no text.

    The library tries its readers of texts many times before it tries those of other formats.
    """

    calls = 10_000  # no reader takes lines, and one follows a page of a TIFF that names itself until they are used up

    def read1(self, size: int | None = -1, /) -> bytes:
        """Raise an error in a reader of texts, which ends it; readers of other formats do not call this."""
        raise RuntimeError("it is not a text: it holds zero bytes")


def read_foreign(kind: str, data: bytes, channel: str | int | None) -> HeightMap:
    """Return the height channel of a file in any format that SurfaceTopography reads.

    The channel is `channel`, or the first whose name and unit are those of a height; the library's default
    is never taken.
    """
    with _opened(kind, data) as (reader, stream):
        channels = _channels(reader, stream)
        index, warnings = choose(channels, channel)
        found = _map(reader, index, channels[index])
        if isinstance(factor := _factor(reader, stream, index), str):
            found = replace(found, unclear=factor)
        if reader.format() in _MATRICES:
            found = heights_alone(found)
        return replace(found, warnings=(*warnings, *found.warnings, *_left_over(reader, stream)))


def list_foreign(kind: str, data: bytes) -> tuple[Channel, ...]:
    """Return the channels of a file in any format that SurfaceTopography reads."""
    with _opened(kind, data) as (reader, stream):
        return _channels(reader, stream)


@contextmanager
def _opened(kind: str, data: bytes) -> Iterator[tuple[Any, BoundedStream]]:
    """Yield SurfaceTopography's reader of the bytes, and the stream it reads; any error becomes a ContentError."""
    if kind not in _UNMARKED and not is_hdf5(data) and not any(data[:_BEGINNING]):
        raise ContentError(
            f"its first {min(len(data), _BEGINNING)} bytes are zeros, which no format known here begins with",
            "copy the file again",
        )
    try:
        from SurfaceTopography.IO import open_topography
    except ImportError as error:
        raise without_reader("SurfaceTopography", error) from error
    # Bytes in memory leave no file open if a reader fails half-way.
    name = "surface" + kind if re.fullmatch(r"\.[a-z0-9_-]+", kind) else "surface"
    has_zeros = b"\0" in data
    stream = (_Binary if has_zeros and not data.startswith(_WIDE) else BoundedStream)(data, name)
    hint = "" if has_zeros else "name a text of numbers .txt; "
    if kind in (".toml", ".json"):
        hint = "a job or a result is repeated by 'roughcontact run'; "
    with damage("it cannot be read", hint + _REMEDY, said=brief):  # any of forty readers may raise any error
        require_whole(data)
        if is_hdf5(data):
            with opened_hdf5(data):
                pass
        # Damaged numbers are detected later, in the heights.
        with (
            unlogged(),
            np.errstate(all="ignore"),
            closing(open_topography(stream, format=_UNMARKED.get(kind))) as reader,
        ):
            _accept(str(reader.format()), kind)
            yield reader, stream


def without_reader(package: str, error: Exception, otherwise: str = "") -> ContentError:
    """Return the error about a package that cannot be imported, with the command that installs it."""
    wanted = package if package == "imagecodecs" else "'roughcontact[formats]'"
    return ContentError(
        f"its format needs the package {package}, which cannot be imported ({error})",
        f"{otherwise}run: {sys.executable} -m pip install {wanted}",
    )


@contextmanager
def unlogged() -> Iterator[None]:
    """Suppress the log messages of the libraries that read files, in this thread."""
    reading = _READING.set(True)
    try:
        yield
    finally:
        _READING.reset(reading)


def brief(error: Exception) -> str:
    """Return the kind of an error and the first line of its text."""
    if type(error).__name__ == "CannotDetectFileFormat":
        return "its format is not recognised"
    lines = str(error).strip().splitlines()
    return f"{type(error).__name__}: {lines[0][:120]}" if lines else type(error).__name__


def _accept(format_name: str, kind: str) -> None:
    """Refuse files that SurfaceTopography reads too leniently."""
    unmarked = {name: suffix for suffix, name in _UNMARKED.items()}
    if format_name in _TEXTS:
        raise ContentError(
            "its extension does not fit its format: it is a text of numbers",
            f"rename it to .txt if it is a matrix or a profile, to .xyz if it is a list of points; or {_EXPORT}",
        )
    suffix = _OURS.get(format_name) or unmarked.get(format_name)
    if suffix is not None and not (format_name in unmarked and kind == suffix):
        raise ContentError(
            f"its extension does not fit its format, which may be {suffix}",
            f"rename it to {suffix} if it has this format; or {_EXPORT}",
        )


def _channels(reader: Any, stream: BoundedStream) -> tuple[Channel, ...]:
    """Return the channels with checked units; heights are recognised by name and unit."""
    found: list[Channel] = []
    for index, info in enumerate(reader.channels):
        lateral, unit = _units(info)
        points = tuple(int(n) for n in info.nb_grid_pts or ())
        shape = points if reader.format() in _MATRICES else points[::-1]
        sizes = info.physical_sizes
        size = None
        factor = _factor(reader, stream, index)
        if sizes is not None and len(sizes) == 2 and is_length(lateral) and not isinstance(factor, str):
            metres = length_factor(lateral)  # type: ignore[arg-type]  # a length, so not None
            size = (float(sizes[1]) * metres * factor, float(sizes[0]) * metres)
        found.append(Channel(str(info.name), shape, unit, size, is_height=False))
    if not found:
        raise ContentError("it holds no channel that can be read", _EXPORT)
    return marked(found)


def _factor(reader: Any, stream: BoundedStream, index: int) -> float | str:
    """Return the correction factor of the height of a map as stated by the library, or why it is not known."""
    if reader.format() in _SIZE_UNRELIABLE:
        return "a size whose unit its reader gets wrong"
    return height_factors(stream.getvalue())[index] if reader.format() == "di" else 1.0


def _units(info: Any) -> tuple[str | None, str | None]:
    """Return the lateral unit and the unit of the values, in that order if a pair of units is stated."""
    if isinstance(info.unit, tuple):
        lateral, values = (*info.unit, None, None)[:2]
        return lateral, values
    # Values that are lengths are converted to the lateral unit by the library; other values keep their own.
    other = info.data_unit
    return info.unit, other if other is not None and not is_length(other) else info.unit


def _left_over(reader: Any, stream: BoundedStream) -> tuple[str, ...]:
    """Return a warning if the channels that the header announces do not end at the end of the file."""
    if left := left_behind_blocks(reader.format(), stream.getvalue()):
        where = f"{left} bytes before" if left > 0 else "beyond"
        return (f"its blocks end {where} the end of the file: it may be damaged",)
    if reader.format() not in _FILLED:
        return ()
    stream.forget()
    try:
        _heights(reader, len(reader.channels) - 1)
    except Exception:  # as above, any error
        return ("its last channel is not all there: it is cut short, or its header is damaged",)
    if stream.unread == 0:
        return ()
    return (f"{stream.unread} bytes at its end belong to no channel: its header may be damaged",)


def _heights(reader: Any, index: int) -> Array:
    """Return the values of a channel as the library indexes them, NaN where nothing was measured."""
    info = reader.channels[index]
    # The library requires a size if the file has none; it is not used.
    missing = {"physical_sizes": tuple(info.nb_grid_pts)} if info.physical_sizes is None else {}
    topography = reader.topography(channel_index=index, **missing)
    return np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), math.nan)


def _map(reader: Any, index: int, channel: Channel) -> HeightMap:
    if len(channel.shape) != 2:
        raise ContentError(f"channel {channel.name!r} is a profile", AS_TEXT)
    require_memory(BYTES_PER_POINT * math.prod(channel.shape))
    info = reader.channels[index]
    if reader.format() in _UPRIGHT and not info.height_scale_factor > 0:
        raise ContentError(f"its header states a factor of {info.height_scale_factor:g} for heights", _REMEDY)
    heights = _heights(reader, index)
    if reader.format() not in _MATRICES:
        heights = heights.T
    if heights.shape != channel.shape:
        raise ContentError(
            f"its header announces {channel.shape} points and its data hold {heights.shape}", _REMEDY
        )
    spacing = None
    if channel.size is not None:
        spacing = (channel.size[0] / channel.shape[0], channel.size[1] / channel.shape[1])
    return HeightMap(
        as_heights(heights),
        f"{reader.format()} by SurfaceTopography",
        channel=channel.name,
        unit=channel.unit,
        spacing=spacing,
        periodic=bool(info.is_periodic),
        notes=("a bare matrix: its rows are rows of the picture",) if reader.format() in _MATRICES else (),
    )
