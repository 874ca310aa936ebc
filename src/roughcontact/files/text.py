"""Heights as a matrix in a text, with or without the header that Gwyddion writes."""

from __future__ import annotations

from collections.abc import Iterable

from roughcontact.files.column_units import column_units
from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.files.length_units import is_length, length_factor
from roughcontact.files.missing_marks import without_marks
from roughcontact.files.numbers import Table, decode, parse_table, stated_rows
from roughcontact.files.table_axes import Axes, axes_of, counts
from roughcontact.files.text_dialects import dialect_of
from roughcontact.files.text_header import TextHeader, header_of
from roughcontact.surface.surface import Surface

__all__ = ["read_text", "text_bytes"]

_COORDINATES = 8  # rows from which two or three bare columns are taken for coordinates


def read_text(data: bytes) -> HeightMap:
    """Return a matrix of heights; without a header it states neither unit nor size.

    A header consists of lines that begin with ``#`` or read ``name = value`` or ``name: value``, or of the lines that
    a program of ``text_dialects`` writes. Places in the first row and column are not heights.
    """
    text = decode(data)
    if (dialect := dialect_of(text)) is not None:
        return dialect(text)
    table = parse_table(text)
    _require_no_points(table)
    axes = axes_of(table.values)
    warnings = table.warnings
    if axes is None and table.corner is not None:
        if table.corner.error is not None:
            raise table.corner.error
        warnings = (*warnings, "its first field is empty, and is read as a missing point")
    heights = table.values if axes is None else axes.heights
    ny, nx = heights.shape
    header = header_of(table.comments, (ny, nx))
    if header.columns is not None and header.columns != nx:
        raise ContentError(
            f"its rows hold {nx} numbers and it states {header.columns}",
            "copy or export it again, or remove that line if it has another meaning",
        )
    notes, warnings = table.notes, (*warnings, *header.warnings)
    if axes is not None:
        warnings = (*warnings, axes.warning)
    heights, stated, near = without_marks(heights, header.missing)
    missing = () if stated_rows(table.comments) else _rows_missing(header, (ny, nx))
    return HeightMap(
        as_heights(heights),
        "text" if header == TextHeader(warnings=header.warnings) else "text with a header",
        channel=header.channel,
        unit=header.unit or column_units(table.comments, 3)[2],
        spacing=header.spacing((ny, nx)) or _cell_of(axes, header.lateral or _lateral(table)),
        unclear=header.unclear,
        notes=(*notes, *stated),
        warnings=(*warnings, *near, *missing),
    )


def _require_no_points(table: Table) -> None:
    ny, nx = table.values.shape
    if nx == 4 and counts(table.values[:, 0]):
        nx = 3  # and their numbers
    if nx not in (2, 3) or not (ny >= _COORDINATES or table.statements):
        return
    if not header_of(table.comments, (ny, nx)).states_a_size:
        raise ContentError(
            f"its {ny} rows of {table.values.shape[1]} columns look like a list of coordinates, not a map",
            "read a profile by read_line" if nx == 2 else "name a list of points x, y, z .xyz",
        )


def _lateral(table: Table) -> str | None:
    """Return the one unit that the corner of a table, or a line such as ``x [mm] y [mm] z [um]``, gives to its axes."""
    corner = [] if table.corner is None else [table.corner.text]
    units = {*column_units(table.comments, 3)[:2]}, {*column_units(corner, 2)}, {*column_units(corner, 1)}
    return next((unit for found in units if len(found) == 1 for unit in found if is_length(unit)), None)


def _cell_of(axes: Axes | None, lateral: str | None) -> tuple[float, float] | None:
    """Return the cell (dy, dx) [m] between axes in a lateral unit."""
    steps = None if axes is None else axes.steps()
    if steps is None or not is_length(lateral):
        return None
    factor = length_factor(lateral or "")
    return steps[0] * factor, steps[1] * factor


def _rows_missing(header: TextHeader, shape: tuple[int, int]) -> tuple[str, ...]:
    """Return a warning if the height in the header has room for more rows of square cells than the table has."""
    if header.width is None or header.height is None:
        return ()
    ny, nx = shape
    expected = header.height / (header.width / nx)
    if not expected * (1 - header.rounding) > ny + 0.5:
        return ()
    return (
        f"its height has room for {expected:.0f} rows of square cells, and it holds {ny}: it may be cut short",
    )


def text_bytes(surface: Surface) -> bytes:
    """Return the heights [m] as rows separated by tabs, under the header that Gwyddion writes; NaN as ``nan``.

    A profile becomes two columns, positions of the cell centres and heights. Every number has all its digits. The
    provenance follows the header.
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
