"""Files made of blocks of stated lengths: whether these end where the file ends."""

from __future__ import annotations

import math
import re
import struct

__all__ = ["left_behind_blocks"]

_END = b"#!"
_STATED = re.compile(rb"^(Points|Lines|SaveBits)=(\d{1,9})\s*$", re.MULTILINE)


def left_behind_blocks(format_name: str, data: bytes) -> int:
    """Return the number of bytes after the last block; negative if it ends beyond the end of the file.

    For FRT (``frt``), Wyko (``opd``) and Nanosurf (``ezd``); 0 for every other format.
    """
    blocks = {"frt": _frt, "opd": _opd, "ezd": _ezd}.get(format_name)
    try:
        return 0 if blocks is None else len(data) - blocks(data)
    except struct.error:
        return -1


def _frt(data: bytes) -> int:
    """Follow the blocks, each with a number and its length; the header states how many there are."""
    (count,) = struct.unpack_from("<H", data, 16)
    place = 18
    for _ in range(count):
        place += 6 + int(struct.unpack_from("<HI", data, place)[1])
    return place


def _opd(data: bytes) -> int:
    """Add the lengths in the directory, which is also a block and begins after two bytes."""
    entry = struct.Struct("<16shIH")
    _, _, length, _ = entry.unpack_from(data, 2)
    entries = min(length, len(data)) // entry.size
    return 2 + sum(int(entry.unpack_from(data, 2 + k * entry.size)[2]) for k in range(entries))


def _ezd(data: bytes) -> int:
    """Add the lengths that the sections of the header state to the end of the header."""
    head = data.partition(_END)[0]
    place = len(head) + len(_END)
    for section in head.split(b"\n["):
        stated = dict(_STATED.findall(section))
        if len(stated) == 3:
            place += math.prod(map(int, stated.values())) // 8
    return place
