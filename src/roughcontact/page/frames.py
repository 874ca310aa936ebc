"""Messages of server, workers and page: a header in JSON, and bytes such as those of a map.

It begins with the lengths of header and data, four bytes each, least significant first.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from typing import Any

__all__ = ["LENGTHS", "header_of", "lengths_of", "packed"]

_FORMAT = "<II"
LENGTHS = struct.calcsize(_FORMAT)


def packed(header: Mapping[str, Any], data: bytes = b"") -> bytes:
    """Return a message; the header holds plain finite values."""
    words = json.dumps(header, allow_nan=False, separators=(",", ":")).encode()
    return b"".join((struct.pack(_FORMAT, len(words), len(data)), words, data))


def lengths_of(start: bytes) -> tuple[int, int]:
    """Return the lengths of header and data that the first bytes of a message state."""
    header, data = struct.unpack(_FORMAT, start)
    return header, data


def header_of(words: bytes) -> dict[str, Any]:
    """Return the header of a message."""
    found: dict[str, Any] = json.loads(words)
    return found
