"""Every other format, through SurfaceTopography: nothing that it reports is taken on trust."""

from __future__ import annotations

import logging
import math
import re
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from contextvars import ContextVar
from dataclasses import replace
from typing import Any

import numpy as np

from roughcontact.files.file_bounds import BYTES_PER_POINT, BoundedStream, require_memory
from roughcontact.files.file_errors import ContentError
from roughcontact.files.hdf5 import is_hdf5, opened_hdf5
from roughcontact.files.heightmap import (
    Channel,
    HeightMap,
    as_heights,
    describe,
    names_a_height,
    names_something_else,
    pick,
)
from roughcontact.files.length_units import is_length, length_factor
from roughcontact.validation import Array

__all__ = ["NOT_FOREIGN", "list_foreign", "read_foreign"]


# Formats with a reader of ours: under another extension the library would fall back to a lenient reader.
_OURS = {
    **{"npy": ".npy", "npz": ".npz", "x3p": ".x3p"},
    **{"nc": ".nc", "sur": ".sur"},
}
_TEXTS = {"asc", "matrix", "xyz"}
NOT_FOREIGN = {*_OURS, *_TEXTS}  # what the library reads and is not asked to
# Formats without a mark of their own, which therefore claim foreign bytes: taken only under their extension.
_UNMARKED = {".hgt": "hgt", ".nms": "nms"}
# Formats whose lateral size comes out wrong (by 1e6): the size must be given.
_SIZE_UNRELIABLE = {"nms"}
# Containers of bare matrices, whose rows are the rows of the picture; all other formats are indexed [x, y].
_MATRICES = {"mat", "h5"}
# Formats without a checksum whose last channel ends where the file ends: so a damaged number of points shows.
_FILLED = {"di", "metropro", "mi", "tmd", "wsxm"}
# Formats whose factor from counts to heights is a product of positive numbers: a wavelength, an obliquity, a share.
_UPRIGHT = {"metropro"}
# What these say about a damaged file, up to megabytes of it, is not for the user. Only what they log while we read is
# left out, in this thread: the settings of the process stay as they are.
_TALKATIVE = ("tifffile", "igor2.binarywave")
_READING: ContextVar[bool] = ContextVar("_READING", default=False)
_REMEDY = "check that the file is whole, or export it as X3P, Gwyddion text or .npz"
_AS_TEXT = "give a map of heights, or export the profile as a text of two columns, places and heights"


def _unless_reading(_: logging.LogRecord) -> bool:
    return not _READING.get()


for _name in _TALKATIVE:
    logging.getLogger(_name).addFilter(_unless_reading)


def read_foreign(kind: str, data: bytes, channel: str | int | None) -> HeightMap:
    """Return the height channel of a file in any format that SurfaceTopography knows.

    The channel is `channel`, or the first whose name and unit are those of a height; the library's default
    is never taken.
    """
    with _opened(kind, data) as (reader, stream):
        channels = _channels(reader)
        index, doubts = _choose(channels, channel)
        found = _map(reader, index, channels[index])
        return replace(found, doubts=(*doubts, *_left_over(reader, stream, found.heights.shape[1])))


def list_foreign(kind: str, data: bytes) -> tuple[Channel, ...]:
    """Return the channels of a file in any format that SurfaceTopography knows."""
    with _opened(kind, data) as (reader, _):
        return _channels(reader)


@contextmanager
def _opened(kind: str, data: bytes) -> Iterator[tuple[Any, BoundedStream]]:
    """Give the library's reader of the bytes, and what it reads; whatever goes wrong becomes a ContentError."""
    try:
        from SurfaceTopography.IO import open_topography
    except ImportError as error:
        raise ContentError(
            f"its format needs the package SurfaceTopography, which cannot be imported ({error})",
            f"run: {sys.executable} -m pip install 'roughcontact[formats]'",
        ) from error
    # Bytes in memory leave no open file behind when a reader gives up half-way.
    stream = BoundedStream(data, "surface" + kind if re.fullmatch(r"\.[a-z0-9_-]+", kind) else "surface")
    reading = _READING.set(True)
    try:
        if is_hdf5(data):
            with opened_hdf5(data):
                pass
        # What is odd about damaged numbers shows in the heights.
        with (
            np.errstate(all="ignore"),
            closing(open_topography(stream, format=_UNMARKED.get(kind))) as reader,
        ):
            _accept(str(reader.format()), kind)
            yield reader, stream
    except ContentError:
        raise
    except Exception as error:  # any reader of forty may fail in any way on a damaged file
        hint = "" if b"\0" in data else "name a text of numbers .txt; "
        raise ContentError(f"it cannot be read ({_brief(error)})", hint + _REMEDY) from error
    finally:
        _READING.reset(reading)


def _brief(error: Exception) -> str:
    if type(error).__name__ == "CannotDetectFileFormat":
        return "its format is not recognised"
    lines = str(error).strip().splitlines()
    return f"{type(error).__name__}: {lines[0][:120]}" if lines else type(error).__name__


def _accept(format_name: str, kind: str) -> None:
    """Refuse what the other library reads too readily."""
    unmarked = {name: suffix for suffix, name in _UNMARKED.items()}
    if format_name in _TEXTS:
        raise ContentError(
            "its extension hides its format: it is a text of numbers",
            f"rename it to .txt if it is a matrix or a profile, to .xyz if it is a list of points; {_REMEDY}",
        )
    suffix = _OURS.get(format_name) or unmarked.get(format_name)
    if suffix is not None and not (format_name in unmarked and kind == suffix):
        raise ContentError(
            f"its extension hides its format: it can only be taken for {suffix}",
            f"rename it to {suffix} if that is what it is; {_REMEDY}",
        )


def _channels(reader: Any) -> tuple[Channel, ...]:
    """Return the channels with units that are checked; heights are known by name and unit."""
    found: list[Channel] = []
    seen: Counter[str] = Counter()
    for info in reader.channels:
        lateral, unit = _units(info)
        points = tuple(int(n) for n in info.nb_grid_pts or ())
        shape = points if reader.format() in _MATRICES else points[::-1]
        sizes = info.physical_sizes
        size = None
        if (
            sizes is not None
            and len(sizes) == 2
            and is_length(lateral)
            and reader.format() not in _SIZE_UNRELIABLE
        ):
            factor = length_factor(lateral)  # type: ignore[arg-type]  # a length, so not None
            size = (float(sizes[1]) * factor, float(sizes[0]) * factor)
        name = str(info.name)
        seen[name] += 1
        label = name if seen[name] == 1 else f"{name}#{seen[name]}"
        found.append(Channel(label, shape, unit, size, is_height=False))
    if not found:
        raise ContentError("it holds no channel", _REMEDY)
    return tuple(replace(c, is_height=_is_height(c, found)) for c in found)


def _units(info: Any) -> tuple[str | None, str | None]:
    """Return the lateral unit and the unit of the values; a pair of units means them in that order."""
    if isinstance(info.unit, tuple):
        lateral, values = (*info.unit, None, None)[:2]
        return lateral, values
    # Values that are lengths are converted to the lateral unit by the library; other values keep their own.
    other = info.data_unit
    return info.unit, other if other is not None and not is_length(other) else info.unit


def _is_height(channel: Channel, channels: Sequence[Channel]) -> bool:
    """Whether a map is named as a height, or the only one and not named otherwise; its unit may be silent."""
    if not _is_map(channel) or not (channel.unit is None or is_length(channel.unit)):
        return False
    alone = sum(map(_is_map, channels)) == 1
    return names_a_height(channel.name) or (alone and not names_something_else(channel.name))


def _is_map(channel: Channel) -> bool:
    return len(channel.shape) == 2 and min(channel.shape) >= 2


def _choose(channels: Sequence[Channel], wanted: str | int | None) -> tuple[int, tuple[str, ...]]:
    """Return the position of the channel to read, and a doubt where another would do as well."""
    if wanted is not None:
        index = pick(channels, wanted)
        return index, _doubts(channels[index])
    if not any(map(_is_map, channels)):
        raise ContentError(
            f"it holds no map but {describe(channels)}",
            _AS_TEXT,
        )
    heights = [k for k, c in enumerate(channels) if c.is_height and c.unit is not None]
    if not heights:  # without a unit they need the user's, which is asked for later
        heights = [k for k, c in enumerate(channels) if c.is_height]
    if not heights:
        raise ContentError(
            f"no channel is a height by its name and unit: {describe(channels)}",
            "pass channel= with a name from this list, and unit= where its unit is no length",
        )
    if len(heights) == 1:
        return heights[0], ()
    names = ", ".join(repr(channels[k].name) for k in heights)
    chosen = channels[heights[0]].name
    return heights[0], (
        f"{len(heights)} channels are heights ({names}); took {chosen!r}, pass channel= for another",
    )


def _doubts(channel: Channel) -> tuple[str, ...]:
    """Return a doubt about a map that the user chose and whose name or unit is not that of heights."""
    other_unit = channel.unit is not None and not is_length(channel.unit)
    if not _is_map(channel) or not (other_unit or names_something_else(channel.name)):
        return ()
    unit = f" in {channel.unit}" if other_unit else ""
    return (f"channel {channel.name!r}{unit} is not marked as heights, and read as heights all the same",)


def _left_over(reader: Any, stream: BoundedStream, row: int) -> tuple[str, ...]:
    """Return a doubt where the channels that the header announces do not end where the file ends, but for a row."""
    if reader.format() not in _FILLED:
        return ()
    stream.forget()
    try:
        _heights(reader, len(reader.channels) - 1)
    except Exception:  # as above, in any way
        return ("its last channel is not all there: it is cut short, or its header is damaged",)
    if stream.unread < row:
        return ()
    return (f"{stream.unread} bytes at its end belong to no channel: its header may be damaged",)


def _heights(reader: Any, index: int) -> Array:
    """Return the values of a channel as the library indexes them, NaN where nothing was measured."""
    info = reader.channels[index]
    # A size must be passed where the file has none; it is not used.
    missing = {"physical_sizes": tuple(info.nb_grid_pts)} if info.physical_sizes is None else {}
    topography = reader.topography(channel_index=index, **missing)
    return np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), math.nan)


def _map(reader: Any, index: int, channel: Channel) -> HeightMap:
    if len(channel.shape) != 2:
        raise ContentError(f"channel {channel.name!r} is a profile", _AS_TEXT)
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
