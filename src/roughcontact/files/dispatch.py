"""The bytes of a file, and the reader that its extension asks for."""

from __future__ import annotations

import os
from pathlib import Path

from roughcontact.files.arrays import read_npy, read_npz
from roughcontact.files.channels import Channel, pick
from roughcontact.files.errors import ReadError
from roughcontact.files.foreign import read_foreign
from roughcontact.files.heightmap import HeightMap
from roughcontact.files.text import read_text
from roughcontact.files.x3p import read_x3p
from roughcontact.files.xyz import read_xyz

__all__ = ["SINGLE", "content", "height_map", "only_channel", "suffix"]

# Readers of ours whose files hold a single map.
SINGLE = {
    ".npy": read_npy,
    ".txt": read_text,
    ".csv": read_text,
    ".tsv": read_text,
    ".asc": read_text,
    ".xyz": read_xyz,
    ".x3p": read_x3p,
}


def content(path: str | os.PathLike[str]) -> tuple[str, bytes]:
    """Return the name of a file and its bytes; an empty one is refused."""
    name = Path(path).name or str(path)
    try:
        data = Path(path).read_bytes()
    except (OSError, ValueError, MemoryError) as error:  # ValueError: a zero byte in the name
        reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
        raise ReadError(
            name, f"it cannot be opened ({reason})", "check the path and the permissions"
        ) from error
    if not data:
        raise ReadError(name, "it is empty", "copy or export the file again")
    return name, data


def suffix(file: str) -> str:
    """Return the extension in lower case."""
    return Path(file).suffix.casefold()


def height_map(data: bytes, file: str, channel: str | int | None) -> HeightMap:
    """Return what the file says about its heights, by the reader of its extension."""
    kind = suffix(file)
    if kind in SINGLE:
        found = SINGLE[kind](data, file)
        if channel is not None:
            pick((only_channel(found),), channel, file)
        return found
    if kind == ".npz":
        return read_npz(data, file, channel)
    return read_foreign(data, file, channel)


def only_channel(found: HeightMap) -> Channel:
    """Describe the single map of a file."""
    ny, nx = found.heights.shape
    size = None if found.spacing is None else (found.spacing[0] * ny, found.spacing[1] * nx)
    return Channel(found.channel or "heights", (ny, nx), found.unit, size, is_height=True)
