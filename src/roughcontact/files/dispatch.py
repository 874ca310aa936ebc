"""The reader for each kind of file, by its extension in lower case."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from roughcontact.files.container import list_container, read_container
from roughcontact.files.file_errors import ContentError
from roughcontact.files.foreign import list_foreign, read_foreign
from roughcontact.files.grd import read_grd
from roughcontact.files.gsf import read_gsf
from roughcontact.files.gwy import list_gwy, read_gwy
from roughcontact.files.heightmap import Channel, HeightMap, pick, require_line, require_map
from roughcontact.files.netcdf import list_netcdf, read_netcdf
from roughcontact.files.numpy_files import list_npz, read_npy, read_npz
from roughcontact.files.profile_text import read_profile
from roughcontact.files.sdf import read_sdf
from roughcontact.files.sur import read_sur
from roughcontact.files.text import read_text
from roughcontact.files.tiff import list_tiff, read_tiff
from roughcontact.files.tmd import read_tmd
from roughcontact.files.x3p import read_x3p
from roughcontact.files.xyz import read_xyz

__all__ = ["READERS", "channels_of", "either", "height_map", "profile_of"]


@dataclass(frozen=True, slots=True)
class _Reader:
    """How the files of a format are read, and how their channels are listed."""

    read: Callable[[bytes, str | int | None], HeightMap]
    channels: Callable[[bytes], tuple[Channel, ...]]


def _alone(read: Callable[[bytes], HeightMap]) -> _Reader:
    """Return the reader of a format whose files hold a single map or profile."""

    def channels(data: bytes) -> tuple[Channel, ...]:
        return (read(data).as_channel(),)

    def chosen(data: bytes, channel: str | int | None) -> HeightMap:
        found = read(data)
        if channel is not None:
            pick((found.as_channel(),), channel)
        return found

    return _Reader(chosen, channels)


def _member(data: bytes, kind: str) -> HeightMap:
    """Return the content of a file in a container, by its extension."""
    return _reader(kind).read(data, None)


_TEXTS = (".txt", ".csv", ".tsv", ".asc")
_PROFILE = _alone(read_profile)  # for a text that holds no map
# By the extension of a file; files with another extension go to the readers of SurfaceTopography.
READERS = {
    ".npy": _alone(read_npy),
    **dict.fromkeys(_TEXTS, _alone(read_text)),
    ".grd": _alone(read_grd),
    ".xyz": _alone(read_xyz),
    ".x3p": _alone(read_x3p),
    **dict.fromkeys((".sur", ".pro"), _alone(read_sur)),
    ".sdf": _alone(read_sdf),
    ".tmd": _alone(read_tmd),
    ".gsf": _alone(read_gsf),
    ".gwy": _Reader(read_gwy, list_gwy),
    **dict.fromkeys((".tif", ".tiff"), _Reader(read_tiff, list_tiff)),
    ".zip": _Reader(partial(read_container, reader=_member), partial(list_container, reader=_member)),
    ".npz": _Reader(read_npz, list_npz),
    **dict.fromkeys((".nc", ".nc4", ".cdf"), _Reader(read_netcdf, list_netcdf)),
}


def height_map(data: bytes, kind: str, channel: str | int | None) -> HeightMap:
    """Return the map of heights of a file and what it states about it, by the reader of its extension."""
    try:
        found = _reader(kind).read(data, channel)
    except ContentError as error:
        if points := _points_on_a_line(data, kind):
            problem = f"it is a profile of {points} heights, not a map ({error.message})"
            raise ContentError(problem, "read it by read_line") from None
        raise
    require_map(found)
    return found


def either(data: bytes, kind: str, channel: str | int | None) -> HeightMap:
    """Return the map of heights of a file, or its line of heights if it holds a line instead."""
    try:
        found = _reader(kind).read(data, channel)
    except ContentError:
        if not _points_on_a_line(data, kind):
            raise
        return profile_of(data, kind, channel)
    if found.heights.ndim == 1 or (found.heights.shape[1] == 1 and kind in _TEXTS):
        return profile_of(data, kind, channel)
    require_map(found)
    return found


def profile_of(data: bytes, kind: str, channel: str | int | None) -> HeightMap:
    """Return the line of heights of a file and what it states about it, by the reader of its extension."""
    if kind not in READERS:
        problem = f"profiles are not read from {kind or 'a file without extension'}"
        holding = (each for each in READERS if each not in (".grd", ".xyz", ".zip"))
        raise ContentError(
            problem, f"name a text .txt, or export it as one of {', '.join(holding)}; read a map by read"
        )
    found = (_PROFILE if kind in _TEXTS else READERS[kind]).read(data, channel)
    require_line(found)
    return found


def channels_of(data: bytes, kind: str) -> tuple[Channel, ...]:
    """Return the channels of the file, in its order."""
    try:
        return _reader(kind).channels(data)
    except ContentError:
        if not _points_on_a_line(data, kind):
            raise
        return _PROFILE.channels(data)


def _reader(kind: str) -> _Reader:
    return READERS.get(kind) or _Reader(partial(read_foreign, kind), partial(list_foreign, kind))


def _points_on_a_line(data: bytes, kind: str) -> int:
    """Return the number of heights if a text is a profile, otherwise 0."""
    if kind not in _TEXTS:
        return 0
    try:
        return len(read_profile(data).heights)
    except ContentError:
        return 0
