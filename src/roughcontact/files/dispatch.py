"""The reader that the extension of a file asks for."""

from __future__ import annotations

from pathlib import Path

from roughcontact.files.channels import Channel, pick
from roughcontact.files.file_errors import ReadError
from roughcontact.files.foreign import list_foreign, read_foreign
from roughcontact.files.heightmap import HeightMap, require_line, require_map
from roughcontact.files.netcdf import list_netcdf, read_netcdf
from roughcontact.files.numpy_files import list_npz, read_npy, read_npz
from roughcontact.files.profile_text import read_profile
from roughcontact.files.sur import read_sur
from roughcontact.files.text import read_text
from roughcontact.files.x3p import read_x3p
from roughcontact.files.xyz import read_xyz

__all__ = ["channels_of", "either", "height_map", "profile_of"]

_TEXTS = (".txt", ".csv", ".tsv", ".asc")
# Readers of ours whose files hold a single map or profile, and those whose files hold channels.
_SINGLE = {
    ".npy": read_npy,
    **dict.fromkeys(_TEXTS, read_text),
    ".xyz": read_xyz,
    ".x3p": read_x3p,
    ".sur": read_sur,
    ".pro": read_sur,
}
_SEVERAL = {".npz": read_npz, ".nc": read_netcdf, ".nc4": read_netcdf, ".cdf": read_netcdf}
_LISTS = {".npz": list_npz, ".nc": list_netcdf, ".nc4": list_netcdf, ".cdf": list_netcdf}


def height_map(data: bytes, file: str, channel: str | int | None) -> HeightMap:
    """Return what the file says about its map of heights, by the reader of its extension."""
    kind = _suffix(file)
    try:
        found = _found(data, file, channel)
    except ReadError as error:
        if kind in _TEXTS and (points := _points_on_a_line(data, file)):
            raise ReadError(
                file,
                f"it is a profile of {points} heights, not a map ({error.problem})",
                "read it by read_line",
            ) from None
        raise
    require_map(found, file)
    return found


def either(data: bytes, file: str, channel: str | int | None) -> HeightMap:
    """Return the map of heights of a file, or the line of heights where it holds one instead."""
    try:
        found = _found(data, file, channel)
    except ReadError:
        if _suffix(file) not in _TEXTS or not _points_on_a_line(data, file):
            raise
        return profile_of(data, file, channel)
    if found.heights.ndim == 1 or (found.heights.shape[1] == 1 and _suffix(file) in _TEXTS):
        return profile_of(data, file, channel)
    require_map(found, file)
    return found


def profile_of(data: bytes, file: str, channel: str | int | None) -> HeightMap:
    """Return what the file says about its line of heights, by the reader of its extension."""
    kind = _suffix(file)
    if kind in _TEXTS:
        found = _only(read_profile(data, file), channel, file)
    elif kind in _SINGLE or kind in _SEVERAL:
        found = _found(data, file, channel)
    else:
        known = ", ".join([*_SINGLE, *_SEVERAL])
        raise ReadError(
            file,
            f"profiles are not read from {kind or 'a file without extension'}",
            f"export it as one of {known}",
        )
    require_line(found, file)
    return found


def channels_of(data: bytes, file: str) -> tuple[Channel, ...]:
    """Return what the file holds, in its order."""
    kind = _suffix(file)
    if kind in _LISTS:
        return _LISTS[kind](data, file)
    if kind not in _SINGLE:
        return list_foreign(data, file)
    try:
        found = _SINGLE[kind](data, file)
    except ReadError:
        if kind not in _TEXTS or not _points_on_a_line(data, file):
            raise
        found = read_profile(data, file)
    return (_only_channel(found),)


def _found(data: bytes, file: str, channel: str | int | None) -> HeightMap:
    kind = _suffix(file)
    if kind in _SEVERAL:
        return _SEVERAL[kind](data, file, channel)
    if kind not in _SINGLE:
        return read_foreign(data, file, channel)
    return _only(_SINGLE[kind](data, file), channel, file)


def _only(found: HeightMap, channel: str | int | None, file: str) -> HeightMap:
    """Return what a file holds alone, unless another channel is asked for."""
    if channel is not None:
        pick((_only_channel(found),), channel, file)
    return found


def _points_on_a_line(data: bytes, file: str) -> int:
    """Return the number of heights of a text that is a profile, or 0."""
    try:
        return len(read_profile(data, file).heights)
    except ReadError:
        return 0


def _only_channel(found: HeightMap) -> Channel:
    """Describe the single map or profile of a file."""
    shape = found.heights.shape
    size = None
    if found.spacing is not None:
        size = tuple(step * n for step, n in zip(found.spacing, shape, strict=True))
    return Channel(found.channel or "heights", shape, found.unit, size, is_height=len(shape) == 2)


def _suffix(file: str) -> str:
    """Return the extension in lower case."""
    return Path(file).suffix.casefold()
