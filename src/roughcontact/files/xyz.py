"""Heights as a list of points x, y, z that lie on a regular grid, with or without gaps."""

from __future__ import annotations

from collections.abc import Sequence

from roughcontact.files.column_units import column_order, column_units
from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.files.length_units import is_length, length_factor
from roughcontact.files.missing_marks import without_marks
from roughcontact.files.numbers import Table, decode, parse_table
from roughcontact.files.point_grid import PointGrid, grid_of_points
from roughcontact.files.table_axes import counts
from roughcontact.files.text_header import header_of

__all__ = ["read_xyz"]

_ZYGO = "Zygo XYZ Data File"  # its header, which contains numbers, ends with a line of #


def read_xyz(data: bytes) -> HeightMap:
    """Return the points on their grid; a place without a point is NaN, the first row has the smallest y.

    A header such as ``# x [um]  y [um]  z [um]`` states the units. Without it all three columns are in the unit of the
    heights, unless x and y are the numbers 0, 1, 2, ...: then the size is unknown. The names in the header give the
    order of the columns.
    """
    text = decode(data)
    if text.startswith(_ZYGO):
        text = text.partition("\n#\n")[2]
    table = parse_table(text, points=True)
    order, warnings = _three_columns(table)
    header = header_of(table.comments, (0, 0))
    grid = grid_of_points(table.values[:, order])
    heights, stated, near = without_marks(grid.heights, header.missing)
    units = column_units(table.comments, table.values.shape[1])
    *lateral, unit = (units[k] for k in order) if any(units) else column_units(table.comments, 3)
    if not any(lateral):
        lateral = [header.lateral, header.lateral]
    spacing, steps, unclear = _cells(grid, lateral, unit or header.unit_unknown)
    return HeightMap(
        as_heights(heights),
        "xyz",
        unit=unit or header.unit,
        spacing=spacing,
        steps=steps,
        unclear=unclear,
        notes=("the first row has the smallest y", *table.notes, *stated),
        warnings=(*table.warnings, *header.warnings, *warnings, *grid.warnings, *near),
    )


def _three_columns(table: Table) -> tuple[list[int], tuple[str, ...]]:
    """Return the columns of x, y and z, without a column that numbers the points, and a warning if there was one."""
    columns = table.values.shape[1]
    order = list(column_order(table.comments, columns))
    if columns == 4 and counts(table.values[:, 0]):
        return [k for k in order if k], ("its first column numbers the points, and is left out",)
    if columns != 3:
        raise ContentError(f"its rows hold {columns} numbers", "give three columns x, y, z")
    return order, ()


def _cells(
    grid: PointGrid, lateral: Sequence[str | None], unit: str | None
) -> tuple[tuple[float, float] | None, tuple[float, float] | None, str | None]:
    """Return the cell (dy, dx) in metres or in the unit of the heights, or the statement that is not understood."""
    if all(map(is_length, lateral)):
        dx, dy = (length_factor(each or "") for each in lateral)
        return (grid.steps[0] * dy, grid.steps[1] * dx), None, None
    if any(lateral):
        return None, None, f"x and y in {' and '.join(repr(each or '') for each in lateral)}"
    if unit is not None:
        return None, None, f"z in {unit}, x and y without a unit"
    if grid.numbered:
        return None, None, "x and y number the points"
    return None, grid.steps, None
