"""HDF5 files that hold all their numbers and refer to no other file."""

from __future__ import annotations

import math
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from typing import TYPE_CHECKING, Any

from roughcontact.files.file_bounds import BYTES_PER_POINT, require_memory
from roughcontact.files.file_errors import ContentError
from roughcontact.files.installed import lacking

if TYPE_CHECKING:
    import h5py

__all__ = ["is_hdf5", "opened_hdf5", "require_memory_for"]

_DEFLATED = 1032  # bytes that one byte may unpack to
_HARMLESS = 100_000_000  # bytes
_MARK = b"\x89HDF\r\n\x1a\n"


def is_hdf5(data: bytes) -> bool:
    """Whether the mark of HDF5 stands at the beginning, or after a user block."""
    place = 0
    while place < len(data):
        if data.startswith(_MARK, place):
            return True
        place = max(512, 2 * place)
    return False


@contextmanager
def opened_hdf5(data: bytes) -> Iterator[h5py.File]:
    """Yield an HDF5 file; one that refers to other files, or whose blocks do not fit in memory, is refused.

    External links, external storage and virtual datasets name files of the reading machine: a foreign file could
    display any of these as numbers.
    """
    if (lack := lacking("h5py")) is not None:
        raise ContentError(f"HDF5 needs {lack[0]}", lack[1])
    import h5py

    with h5py.File(BytesIO(data), "r") as opened:
        # An exception of a visitor is lost; a value that it returns ends the visit and is passed on.
        elsewhere = opened.visititems_links(_linked_elsewhere) or opened.visititems(_stored_elsewhere)
        if elsewhere is not None:
            raise ContentError(elsewhere, "write the numbers into the file itself")
        for values in _datasets(opened):
            if values.chunks:
                _require_blocks(values)
        yield opened


def require_memory_for(values: h5py.Dataset) -> None:
    """Refuse values whose declared size is too large: values that were never written take no room in a file."""
    require_memory(BYTES_PER_POINT * math.prod(values.shape or ()))


def _linked_elsewhere(name: str, link: Any) -> str | None:
    import h5py

    if isinstance(link, h5py.HardLink | h5py.SoftLink):
        return None
    return f"its {name} lies in another file ({getattr(link, 'filename', 'which is not named')})"


def _stored_elsewhere(name: str, item: Any) -> str | None:
    import h5py

    if isinstance(item, h5py.Dataset) and (item.is_virtual or item.external):
        return f"its {name} is put together from other files"
    return None


def _datasets(opened: h5py.File) -> list[h5py.Dataset]:
    import h5py

    found: list[h5py.Dataset] = []

    def look(_: str, item: Any) -> None:
        if isinstance(item, h5py.Dataset):
            found.append(item)

    opened.visititems(look)
    return found


def _require_blocks(values: h5py.Dataset) -> None:
    """Refuse blocks that do not fit in memory, by their declared size, or by what their bytes unpack to.

    HDF5 unpacks a whole block, whatever its size. Only blocks that could become too large are checked here.
    """
    size = math.prod(values.chunks) * values.dtype.itemsize
    require_memory(size)
    large: list[tuple[int, ...]] = []

    def look(block: Any) -> None:
        if _DEFLATED * block.size > _HARMLESS and not block.filter_mask:
            large.append(block.chunk_offset)

    if values.compression != "gzip":
        return
    values.id.chunk_iter(look)
    for place in large:
        packed = values.id.read_direct_chunk(place)[1]
        if len(zlib.decompressobj().decompress(packed, size + 1)) > size:
            raise ContentError(
                f"a block of its {values.name} unpacks to more than it declares", "copy it again"
            )
