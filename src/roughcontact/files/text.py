"""Heights as a matrix in a text, with or without the header that Gwyddion writes."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.files.numbers import parse_table, stated_rows
from roughcontact.files.text_header import TextHeader, header_of
from roughcontact.surface.surface import Surface

__all__ = ["read_text", "text_bytes"]

_COORDINATES = 8  # rows from which two or three bare columns are taken for coordinates


def read_text(data: bytes) -> HeightMap:
    """Return a matrix of heights; without a header it states neither unit nor size.

    A header are lines that begin with ``#`` or read ``name = value`` or ``name: value``.
    """
    table = parse_table(data)
    ny, nx = table.values.shape
    header = header_of(table.comments, (ny, nx))
    if nx in (2, 3) and (ny >= _COORDINATES or table.statements) and not header.states_a_size:
        raise ContentError(
            f"its {ny} rows of {nx} columns look like a list of coordinates, not a map",
            "read a profile by read_line" if nx == 2 else "name a list of points x, y, z .xyz",
        )
    if header.columns is not None and header.columns != nx:
        raise ContentError(
            f"its rows hold {nx} numbers where it states {header.columns}",
            "copy or export it again, or take out that line if it says something else",
        )
    heights = table.values
    notes: tuple[str, ...] = ()
    if header.missing is not None and (found := heights == header.missing).any():
        heights = np.where(found, np.nan, heights)
        notes = (f"not measured where it is {header.missing:g}, as its header states",)
    return HeightMap(
        as_heights(heights),
        "text" if header == TextHeader(doubts=header.doubts) else "text with a header",
        channel=header.channel,
        unit=header.unit,
        spacing=header.spacing((ny, nx)),
        notes=notes,
        doubts=(
            *table.doubts,
            *header.doubts,
            *(() if stated_rows(table.comments) else _rows_missing(header, (ny, nx))),
        ),
    )


def _rows_missing(header: TextHeader, shape: tuple[int, int]) -> tuple[str, ...]:
    """Return a doubt where the height in the header has room for more rows of square cells than there are."""
    if header.width is None or header.height is None:
        return ()
    ny, nx = shape
    expected = header.height / (header.width / nx)
    if not expected * (1 - header.rounding) > ny + 0.5:
        return ()
    return (
        f"its height has room for {expected:.0f} rows of square cells, and {ny} are there: it may be cut short",
    )


def text_bytes(surface: Surface) -> bytes:
    """Return the heights [m] as rows separated by tabs, under the header that Gwyddion writes; NaN as ``nan``.

    A profile becomes two columns, places of the cells' centres and heights. Every number has all its digits. The
    provenance follows the header for people to read.
    """
    history = [f"# History: {' | '.join(line.splitlines())}" for line in surface.provenance]
    if surface.grid.ndim == 1:
        places = surface.grid.coordinates[0].tolist()
        rows: Iterable[tuple[float, ...]] = zip(places, surface.heights.tolist(), strict=True)
        # The line above the numbers names their units.
        header = [f"# Rows: {surface.grid.size}", *history, "x [m]\tz [m]"]
    else:
        height, width = surface.grid.lengths
        rows = surface.heights.tolist()
        header = [
            "# Channel: heights",
            f"# Width: {width!r} m",
            f"# Height: {height!r} m",
            "# Value units: m",
            f"# Rows: {surface.grid.shape[0]}",
            *history,
        ]
    lines = [*header, *("\t".join(map(repr, row)) for row in rows), ""]
    return "\n".join(lines).encode()
