"""The reader that the extension of a file asks for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from roughcontact.files.file_errors import ReadError
from roughcontact.files.foreign import list_foreign, read_foreign
from roughcontact.files.heightmap import Channel, HeightMap, pick, require_line, require_map
from roughcontact.files.netcdf import list_netcdf, read_netcdf
from roughcontact.files.numpy_files import list_npz, read_npy, read_npz
from roughcontact.files.profile_text import read_profile
from roughcontact.files.sur import read_sur
from roughcontact.files.text import read_text
from roughcontact.files.x3p import read_x3p
from roughcontact.files.xyz import read_xyz

__all__ = ["channels_of", "either", "height_map", "profile_of"]


@dataclass(frozen=True, slots=True)
class _Reader:
    """How the files of a format are read, and how what they hold is listed."""

    read: Callable[[bytes, str, str | int | None], HeightMap]
    channels: Callable[[bytes, str], tuple[Channel, ...]]


def _alone(read: Callable[[bytes, str], HeightMap]) -> _Reader:
    """Return the reader of a format whose files hold a single map or profile."""

    def channels(data: bytes, file: str) -> tuple[Channel, ...]:
        return (read(data, file).as_channel(),)

    def chosen(data: bytes, file: str, channel: str | int | None) -> HeightMap:
        found = read(data, file)
        if channel is not None:
            pick((found.as_channel(),), channel, file)
        return found

    return _Reader(chosen, channels)


_TEXTS = (".txt", ".csv", ".tsv", ".asc")
_PROFILE = _alone(read_profile)  # of a text that holds no map
_FOREIGN = _Reader(read_foreign, list_foreign)
_OURS = {
    ".npy": _alone(read_npy),
    **dict.fromkeys(_TEXTS, _alone(read_text)),
    ".xyz": _alone(read_xyz),
    ".x3p": _alone(read_x3p),
    **dict.fromkeys((".sur", ".pro"), _alone(read_sur)),
    ".npz": _Reader(read_npz, list_npz),
    **dict.fromkeys((".nc", ".nc4", ".cdf"), _Reader(read_netcdf, list_netcdf)),
}


def height_map(data: bytes, file: str, channel: str | int | None) -> HeightMap:
    """Return what the file says about its map of heights, by the reader of its extension."""
    try:
        found = _reader(file).read(data, file, channel)
    except ReadError as error:
        if points := _points_on_a_line(data, file):
            problem = f"it is a profile of {points} heights, not a map ({error.problem})"
            raise ReadError(file, problem, "read it by read_line") from None
        raise
    require_map(found, file)
    return found


def either(data: bytes, file: str, channel: str | int | None) -> HeightMap:
    """Return the map of heights of a file, or the line of heights where it holds one instead."""
    try:
        found = _reader(file).read(data, file, channel)
    except ReadError:
        if not _points_on_a_line(data, file):
            raise
        return profile_of(data, file, channel)
    if found.heights.ndim == 1 or (found.heights.shape[1] == 1 and _suffix(file) in _TEXTS):
        return profile_of(data, file, channel)
    require_map(found, file)
    return found


def profile_of(data: bytes, file: str, channel: str | int | None) -> HeightMap:
    """Return what the file says about its line of heights, by the reader of its extension."""
    kind = _suffix(file)
    if kind not in _OURS:
        problem = f"profiles are not read from {kind or 'a file without extension'}"
        raise ReadError(file, problem, f"export it as one of {', '.join(_OURS)}")
    found = (_PROFILE if kind in _TEXTS else _OURS[kind]).read(data, file, channel)
    require_line(found, file)
    return found


def channels_of(data: bytes, file: str) -> tuple[Channel, ...]:
    """Return what the file holds, in its order."""
    try:
        return _reader(file).channels(data, file)
    except ReadError:
        if not _points_on_a_line(data, file):
            raise
        return _PROFILE.channels(data, file)


def _reader(file: str) -> _Reader:
    return _OURS.get(_suffix(file), _FOREIGN)


def _points_on_a_line(data: bytes, file: str) -> int:
    """Return the number of heights of a text that is a profile, or 0."""
    if _suffix(file) not in _TEXTS:
        return 0
    try:
        return len(read_profile(data, file).heights)
    except ReadError:
        return 0


def _suffix(file: str) -> str:
    """Return the extension in lower case."""
    return Path(file).suffix.casefold()
