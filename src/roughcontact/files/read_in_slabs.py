"""Surfaces read in slabs: all processes make the same call, and what goes wrong on one of them is raised on all."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.files.assemble import assemble
from roughcontact.files.bare_table import points_in, require_no_list
from roughcontact.files.content import content, named, ordinary_file
from roughcontact.files.dispatch import height_map
from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights, require_map
from roughcontact.files.numpy_files import NpyHeader, whole_npy_header
from roughcontact.files.table_axes import axes_of
from roughcontact.grid import Grid
from roughcontact.slabs.agreement import by_each, by_first
from roughcontact.slabs.by_rows import scatter_from_first
from roughcontact.slabs.slabs import Slabs
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array

__all__ = ["surface_in_slabs"]


def surface_in_slabs(
    path: str | os.PathLike[str], slabs: Slabs, channel: str | int | None, stated: Mapping[str, Any]
) -> tuple[Surface, tuple[str, ...]]:
    """Return the surface in a file, in slabs, and the doubts to warn of.

    Of ``.npy`` each process reads its rows, which are not searched for spikes and noise; any other file is read by the
    first one, which deals the heights out.

    Parameters
    ----------
    path : str or path
    slabs : Slabs
    channel : str or int, optional
    stated : mapping
        What overrides the file, see ``assemble``.
    """
    kind = Path(path).suffix.casefold()
    if kind == ".npy" and channel is None:
        found, digest = _npy(path, slabs)
        with named(path) as file:
            return assemble(found, file, digest, **stated)
    whole: list[Array] = []

    def read() -> tuple[Grid, tuple[str, ...], tuple[str, ...]]:
        with content(path) as (file, data):
            digest = hashlib.sha256(data).hexdigest()[:16]
            surface, doubts = assemble(height_map(data, kind, channel), file, digest, **stated)
        whole.append(surface.heights)
        return surface.grid, surface.provenance, doubts

    grid, provenance, doubts = by_first(slabs.communicator, read)
    heights: Any = scatter_from_first(slabs, whole[0] if whole else None, grid.shape)
    return Surface(heights, grid, provenance), doubts


def _npy(path: str | os.PathLike[str], slabs: Slabs) -> tuple[HeightMap, str]:
    def look() -> tuple[NpyHeader, str]:
        with named(path), ordinary_file(path) as stream:
            header = whole_npy_header(stream, os.fstat(stream.fileno()).st_size)
            as_heights(np.zeros((1,) * len(header.shape), header.dtype))  # refuses what is none
            require_map(HeightMap(np.broadcast_to(0.0, header.shape), "npy"))
            _require_heights_alone(_mapped(stream, header))
            stream.seek(0)
            bytes_of_file: Any = stream
            return header, hashlib.file_digest(bytes_of_file, "sha256").hexdigest()[:16]

    header, digest = by_first(slabs.communicator, look)
    own: list[npt.NDArray[np.float64]] = []

    def read() -> None:
        with named(path), ordinary_file(path) as stream:
            own.append(as_heights(_mapped(stream, header)[slabs.rows(header.shape[0])]))

    by_each(slabs.communicator, read)
    return HeightMap(slabs.array(own[0]), "npy"), digest  # type: ignore[arg-type]


def _mapped(stream: Any, header: NpyHeader) -> npt.NDArray[Any]:
    order: Any = "F" if header.fortran else "C"
    return np.memmap(stream, header.dtype, "r", header.offset, header.shape, order)


def _require_heights_alone(values: npt.NDArray[Any]) -> None:
    """Refuse points and axes, which are recognised where one process reads the file."""
    require_no_list(values.shape)
    if values.ndim == 2 and (points_in(values) is not None or axes_of(values) is not None):
        raise ContentError(
            "it holds points x, y, z, or places in its first row or column, beside heights",
            "read it by one process, or save the heights alone",
        )
