"""HDF5 files that hold all of their numbers themselves."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from typing import TYPE_CHECKING, Any

from roughcontact.files.errors import ReadError
from roughcontact.files.memory import BYTES_PER_POINT, require_memory

if TYPE_CHECKING:
    import h5py

__all__ = ["is_hdf5", "opened_hdf5", "require_memory_for"]

_MARK = b"\x89HDF\r\n\x1a\n"


def is_hdf5(data: bytes) -> bool:
    """Whether the mark of HDF5 stands at the beginning, or behind a block of the user's."""
    place = 0
    while place < len(data):
        if data.startswith(_MARK, place):
            return True
        place = max(512, 2 * place)
    return False


@contextmanager
def opened_hdf5(data: bytes, file: str) -> Iterator[h5py.File]:
    """Yield an HDF5 file; one that leads to other files, or whose blocks do not fit in memory, is refused.

    External links, external storage and virtual datasets name files of the machine that reads: a foreign file would
    show us any of them as numbers.
    """
    import h5py

    with h5py.File(BytesIO(data), "r") as opened:
        # What a visitor raises does not come through; what it returns ends the visit and does.
        elsewhere = opened.visititems_links(_linked_elsewhere) or opened.visititems(_stored_elsewhere)
        if elsewhere is not None:
            raise ReadError(file, elsewhere, "write the numbers into the file itself")
        require_memory(max(_blocks(opened), default=0), file)
        yield opened


def require_memory_for(values: h5py.Dataset, file: str) -> None:
    """Refuse to load what its header declares too large: values that were never written take no room in a file."""
    require_memory(BYTES_PER_POINT * math.prod(values.shape or ()), file)


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


def _blocks(opened: h5py.File) -> list[int]:
    """Return the sizes of the blocks in which datasets are stored [bytes]; each is unpacked whole."""
    import h5py

    found: list[int] = []

    def look(_: str, item: Any) -> None:
        if isinstance(item, h5py.Dataset) and item.chunks:
            found.append(math.prod(item.chunks) * item.dtype.itemsize)

    opened.visititems(look)
    return found
