"""Surfaces read in slabs: all processes make the same call, and what goes wrong on one of them is raised on all."""

from __future__ import annotations

import hashlib
import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.files.content import content, named, ordinary_file
from roughcontact.files.dispatch import height_map
from roughcontact.files.heightmap import HeightMap, as_heights, require_map
from roughcontact.files.numpy_files import NpyHeader, whole_npy_header
from roughcontact.slabs.agreement import by_each, by_first
from roughcontact.slabs.by_rows import dealt_from_first
from roughcontact.slabs.slabs import Slabs

__all__ = ["map_in_slabs"]


def map_in_slabs(
    path: str | os.PathLike[str], slabs: Slabs, channel: str | int | None
) -> tuple[HeightMap, str]:
    """Return the map of heights of a file, in slabs, and the SHA-256 of the file.

    Of ``.npy`` each process reads its rows; any other file is read by the first one, which deals the heights out.
    """
    kind = Path(path).suffix.casefold()
    if kind == ".npy" and channel is None:
        return _npy(path, slabs)
    whole: list[HeightMap] = []

    def read() -> tuple[HeightMap, tuple[int, ...], str]:
        with content(path) as (_, data):
            found = height_map(data, kind, channel)
            whole.append(found)
            return replace(found, heights=np.empty(0)), found.heights.shape, hashlib.sha256(data).hexdigest()

    outline, shape, digest = by_first(slabs.communicator, read)
    heights = dealt_from_first(slabs, whole[0].heights if whole else None, shape)
    return replace(outline, heights=heights), digest  # type: ignore[arg-type]


def _npy(path: str | os.PathLike[str], slabs: Slabs) -> tuple[HeightMap, str]:
    def look() -> tuple[NpyHeader, str]:
        with named(path), ordinary_file(path) as stream:
            header = whole_npy_header(stream, os.fstat(stream.fileno()).st_size)
            as_heights(np.zeros((1,) * len(header.shape), header.dtype))  # refuses what is none
            require_map(HeightMap(np.broadcast_to(0.0, header.shape), "npy"))
            stream.seek(0)
            bytes_of_file: Any = stream
            return header, hashlib.file_digest(bytes_of_file, "sha256").hexdigest()

    header, digest = by_first(slabs.communicator, look)
    own: list[npt.NDArray[np.float64]] = []

    def read() -> None:
        with named(path), ordinary_file(path) as stream:
            order: Any = "F" if header.fortran else "C"
            whole = np.memmap(stream, header.dtype, "r", header.offset, header.shape, order)
            own.append(as_heights(whole[slabs.rows(header.shape[0])]))

    by_each(slabs.communicator, read)
    return HeightMap(slabs.array(own[0]), "npy"), digest  # type: ignore[arg-type]
