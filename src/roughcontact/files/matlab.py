"""MATLAB's files of version 5: headers are compared with the contents before anything is read."""

from __future__ import annotations

import math
import struct
import zlib

from roughcontact.errors import InputError
from roughcontact.files.file_bounds import BYTES_PER_POINT, require_memory
from roughcontact.files.file_errors import damage

__all__ = ["require_whole"]

_HEADER, _TAG = 128, 8  # bytes
# The version, 1.0, and the order of bytes, after an arbitrary text.
_ORDERS = {b"\0\1IM": "<", b"\1\0MI": ">"}
_MATRIX, _COMPRESSED = 14, 15
_NUMBERS = range(6, 16)  # classes of arrays of numbers
# Size of a number in bytes by the type in which it is stored.
_STORED = {1: 1, 2: 1, 3: 2, 4: 2, 5: 4, 6: 4, 7: 4, 9: 8, 12: 8, 13: 8}
_COMPLEX = 0x0800
_LOOK = 1 << 16  # bytes that hold flags, dimensions and name
_AGAIN = "copy the file again, or save the matrix by save(..., '-v7')"


def require_whole(data: bytes) -> None:
    """Refuse a file of version 5 whose arrays take more memory than is free, or do not match their headers.

    A compressed array is unpacked no further than its dimensions allow, and its checksum is compared. Other elements,
    and files of other versions, are left to their reader.
    """
    order = _ORDERS.get(data[124:128])
    if order is None:
        return
    place = _HEADER
    with damage("its arrays are damaged", _AGAIN, (struct.error, zlib.error, ValueError, IndexError)):
        while place < len(data):
            kind, size = struct.unpack_from(order + "2I", data, place)
            if place + _TAG + size > len(data):
                raise InputError(f"an element of {size} bytes reaches beyond its end")
            body = data[place + _TAG : place + _TAG + size]
            if kind == _COMPRESSED:
                _require_packed(body, order)
            elif kind == _MATRIX:
                _require_numbers(body, order, size)
            place += _TAG + size + (0 if kind == _COMPRESSED else -size % 8)


def _require_packed(packed: bytes, order: str) -> None:
    unpacker = zlib.decompressobj()
    head = unpacker.decompress(packed, _LOOK)
    kind, size = struct.unpack_from(order + "2I", head)
    if kind != _MATRIX:
        return
    _require_numbers(head[_TAG:], order, size)
    left = _TAG + size - len(head)
    while left > 0 and (part := unpacker.decompress(unpacker.unconsumed_tail, min(left, _LOOK))):
        left -= len(part)
    # Asking for one byte beyond the end makes zlib compare the checksum.
    if left != 0 or unpacker.decompress(unpacker.unconsumed_tail, 1) or not unpacker.eof:
        raise InputError("a compressed array holds more or less than it announces")


def _require_numbers(body: bytes, order: str, size: int) -> None:
    """Compare the dimensions of an array of numbers with the bytes that follow them; `body` may be its beginning."""
    (flags,) = struct.unpack_from(order + "I", body, _TAG)
    _, bytes_of_shape = struct.unpack_from(order + "2I", body, 16)
    if flags & 0xFF not in _NUMBERS:
        return
    shape = struct.unpack_from(f"{order}{bytes_of_shape // 4}i", body, 16 + _TAG)
    if min(shape, default=0) < 0:
        raise InputError(f"an array of {' x '.join(map(str, shape))} points")
    points = math.prod(shape)
    require_memory(BYTES_PER_POINT * points)
    place = _after(body, order, 16)  # its name
    place = _after(body, order, place)
    for _ in range(2 if flags & _COMPLEX else 1):
        kind, count, start = _tag(body, order, place)
        stored = _STORED.get(kind, 0)
        if count != points * stored or start + count > size:
            raise InputError(f"{count} bytes for an array of {' x '.join(map(str, shape))} points")
        place = start + count + -count % 8
        if place > len(body):
            return  # the imaginary part lies beyond what was unpacked


def _tag(body: bytes, order: str, place: int) -> tuple[int, int, int]:
    """Return the type of an element, the number of its bytes, and where they begin: up to four stand in its tag."""
    kind, count = struct.unpack_from(order + "2I", body, place)
    if kind >> 16:
        return kind & 0xFFFF, kind >> 16, place + 4
    return kind, count, place + _TAG


def _after(body: bytes, order: str, place: int) -> int:
    _, count, start = _tag(body, order, place)
    return start + count + -(start + count - place) % 8
