"""Read a measured surface, or a profile, from a file."""

from __future__ import annotations

import hashlib
import os
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.files.assemble import Length, Size, assemble, cell_of, plain_lengths
from roughcontact.files.bare_table import points_in, require_no_list
from roughcontact.files.content import content, named, ordinary_file
from roughcontact.files.dispatch import channels_of, either, height_map, profile_of
from roughcontact.files.file_errors import ContentError, SurfaceWarning
from roughcontact.files.heightmap import Channel, HeightMap, as_heights, require_map
from roughcontact.files.length_units import length_factor
from roughcontact.files.numpy_files import NpyHeader, whole_npy_header
from roughcontact.files.table_axes import axes_of
from roughcontact.progress.events import task
from roughcontact.slabs.agreement import by_each, by_first
from roughcontact.slabs.by_rows import scatter_from_first
from roughcontact.slabs.slabs import Slabs
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array

__all__ = ["channels", "read", "read_either", "read_line"]


def read(
    path: str | os.PathLike[str],
    *,
    channel: str | int | None = None,
    unit: Length | None = None,
    size: Size | None = None,
    periodic: bool | tuple[bool, bool] | None = None,
    slabs: Slabs | None = None,
) -> Surface:
    """Return the surface in a file: heights [m], rows from the top of the picture, NaN where not measured.

    ``.npy``, ``.npz``, ``.txt``, ``.csv``, ``.tsv``, ``.asc``, ``.grd``, ``.xyz``, ``.x3p``, ``.nc``, ``.sur``,
    ``.sdf``, ``.tmd``, ``.gsf``, ``.gwy`` and ``.zip`` (of contact.engineering) are read strictly; ``.tif`` and every
    other format need SurfaceTopography, ``pip install roughcontact[formats]``. A file that holds a profile is refused:
    see `read_line`.

    Parameters
    ----------
    path : str or path
        The file. ``"-"`` is standard input, which holds ``.npz``; ``"x3p:-"`` the same in another format.
    channel : str or int, optional
        Name of the channel, or its position counted from 0. Without it the height is found by name and unit.
    unit : str or float, optional
        Unit of the heights in the file, such as ``"nm"``, any length that pint reads, or metres per unit. It overrides
        the unit in the file.
    size : length or pair of lengths, optional
        Width Lx of a map of square cells, or ``(Ly, Lx)``: numbers [m] or texts such as ``"10 um"``. Lengths are those
        of all cells, ``n * spacing``. It overrides the size in the file.
    periodic : bool or pair of bool, optional
        Whether the surface repeats itself (along y and x). By default as the file states; free if it states nothing.
    slabs : Slabs, optional
        Processes that read it together, as a surface in slabs: each process reads its rows of a ``.npy`` file; any
        other file is read by the first process, which distributes it. Spikes and noise in ``.npy`` are not searched.

    Returns
    -------
    Surface
        As measured, tilt included; its provenance names the file, the format, the channel and the start of its
        SHA-256.

    Raises
    ------
    ReadError
        If the file is missing, empty, damaged or not a map, or states no unit or size and none is given here.
    ValueError
        If `unit` or `size` is not a length.

    Warns
    -----
    SurfaceWarning
        If several channels fit, if coordinates beside the heights were left out, if numbers were read as missing
        points though the file does not state them, or if the size or the heights are unusual: spikes, steep slopes,
        large heights, one number that is repeated, random numbers.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> rc.write(ball, "ball.npz")
    >>> rc.read("ball.npz").grid == ball.grid
    True
    """
    return _read(path, height_map, 2, channel, unit, size, periodic, slabs)


def read_line(
    path: str | os.PathLike[str],
    *,
    channel: str | int | None = None,
    unit: Length | None = None,
    size: Size | None = None,
    periodic: bool | None = None,
) -> Surface:
    """Return the profile in a file as a surface on a grid of one axis, heights [m] of shape (n,).

    Texts (``.txt``, ``.csv``, ``.tsv``, ``.asc``) hold one column of heights, or places and heights, under any
    lines of words; ``.npy``, ``.npz``, ``.nc``, ``.x3p`` (profiles) and ``.pro`` (Digital Surf) are read as well.

    Parameters
    ----------
    path : str or path
        The file.
    channel : str or int, optional
        Name of the channel, or its position counted from 0, as for `read`.
    unit : str or float, optional
        Unit of the heights in the file, such as ``"nm"``, or metres per unit. It overrides the unit in the file.
    size : length, optional
        Length of the profile, ``n * spacing``: a number [m] or a text such as ``"10 um"``. It overrides the length in
        the file.
    periodic : bool, optional
        Whether the profile repeats itself. By default as the file states; free if it states nothing.

    Returns
    -------
    Surface
        To press it, pass an operator for lines: ``press(line, modulus, operator=...)``.

    Raises
    ------
    ReadError
        If the file is missing, empty, damaged, a map or unevenly spaced, or states no unit or size and none is given.
    ValueError
        If `unit` or `size` is not a length.

    Warns
    -----
    SurfaceWarning
        As for `read`.

    Examples
    --------
    >>> import roughcontact as rc
    >>> wave = rc.shapes.wave(rc.Grid(64, 1e-6), amplitude=1e-7, wavelength=32e-6)
    >>> rc.write(wave, "wave.npz")
    >>> rc.read_line("wave.npz").grid.lengths == wave.grid.lengths
    True
    """
    return _read(path, profile_of, 1, channel, unit, size, periodic)


def read_either(
    path: str | os.PathLike[str],
    *,
    channel: str | int | None = None,
    unit: Length | None = None,
    size: Size | None = None,
    periodic: bool | None = None,
) -> Surface:
    """Return the map of heights in a file, or the profile if it holds a profile instead.

    For functions that accept both. The arguments, errors and warnings are those of `read` and `read_line`; a file that
    may be either, such as a text of two columns under a header of a map, counts as a map.
    """
    return _read(path, either, None, channel, unit, size, periodic)


def channels(path: str | os.PathLike[str]) -> tuple[Channel, ...]:
    """Return the channels of a file in its order: name, shape, unit, size [m], and whether they are heights.

    Raises
    ------
    ReadError
        If the file cannot be read.
    """
    with content(path) as (file, data):
        return channels_of(data, Path(file).suffix.casefold())


def _read(
    path: str | os.PathLike[str],
    reader: Callable[[bytes, str, str | int | None], HeightMap],
    ndim: int | None,
    channel: str | int | None,
    unit: Length | None,
    size: Size | None,
    periodic: bool | tuple[bool, ...] | None,
    slabs: Slabs | None = None,
) -> Surface:
    unit, size = plain_lengths(unit, size)
    if unit is not None:
        length_factor(unit)  # a wrong keyword is refused before the file is touched
    if size is not None:
        # If the file decides between a map and a line, one length or two can be right.
        axes = ndim or (len(size) if isinstance(size, tuple) and len(size) == 2 else 1)
        cell_of(size, (1,) * axes)
    stated: dict[str, Any] = {"unit": unit, "size": size, "periodic": periodic}

    def whole() -> tuple[Surface, tuple[str, ...]]:
        with content(path) as (file, data):
            found = reader(data, Path(file).suffix.casefold(), channel)
            return assemble(found, file, hashlib.sha256(data).hexdigest()[:16], **stated)

    with named(path) as file, task(f"Reading {file}"):
        if slabs is None:
            surface, messages = whole()
        elif Path(path).suffix.casefold() == ".npy" and channel is None:
            found, digest = _npy_rows(path, slabs)
            surface, messages = assemble(found, file, digest, **stated)
        else:
            surface, messages = _dealt(slabs, whole)
    for message in messages:
        warnings.warn(f"{file}: {message}", SurfaceWarning, stacklevel=3)
    return surface


def _dealt(
    slabs: Slabs, read: Callable[[], tuple[Surface, tuple[str, ...]]]
) -> tuple[Surface, tuple[str, ...]]:
    """Return a surface in slabs, which the first process reads and distributes, and its warnings."""
    whole: list[Array] = []

    def read_here() -> tuple[Any, ...]:
        surface, messages = read()
        whole.append(surface.heights)
        return surface.grid, surface.provenance, messages

    grid, provenance, messages = by_first(slabs.communicator, read_here)
    heights: Any = scatter_from_first(slabs, whole[0] if whole else None, grid.shape)
    return Surface(heights, grid, provenance), messages


def _npy_rows(path: str | os.PathLike[str], slabs: Slabs) -> tuple[HeightMap, str]:
    """Return the one array of a ``.npy`` file in slabs, each process reading its rows, and the hash of the file."""

    def look() -> tuple[NpyHeader, str]:
        with named(path), ordinary_file(path) as stream:
            header = whole_npy_header(stream, os.fstat(stream.fileno()).st_size)
            as_heights(
                np.zeros((1,) * len(header.shape), header.dtype)
            )  # refuses arrays that are not heights
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
    """Refuse points and axes, which are only recognised if one process reads the file."""
    require_no_list(values.shape)
    if values.ndim == 2 and (points_in(values) is not None or axes_of(values) is not None):
        raise ContentError(
            "it holds points x, y, z, or places in its first row or column, beside heights",
            "read it by one process, or save only the heights",
        )
