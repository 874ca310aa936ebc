"""What the file says and what the user says, put together into a surface."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from roughcontact.files.errors import ReadError
from roughcontact.files.heightmap import HeightMap
from roughcontact.files.sanity import IMPOSSIBLE, doubts_about, highest
from roughcontact.files.units import is_length, length_factor, parse_length
from roughcontact.grid import Grid
from roughcontact.surface.surface import Surface

__all__ = ["Length", "Size", "assemble", "cell_of"]

Length = float | str
Size = Length | Iterable[Length]

_UNIT_HINT = "unit= with the unit of the heights, such as unit='um'"
_SIZE_HINT = "size= with the width or (Ly, Lx), such as size='500 um' or size=(4e-4, 5e-4)"


def assemble(
    found: HeightMap,
    file: str,
    digest: str,
    *,
    unit: Length | None,
    size: Size | None,
    periodic: bool | tuple[bool, bool] | None,
) -> tuple[Surface, tuple[str, ...]]:
    """Return the surface of `found` and the doubts to speak aloud; the user's word goes before the file's."""
    _require(found, file, unit, size)
    factor, unit_note = _factor(found, unit)
    spacing, size_note = _spacing(found, factor, size)
    if not all(np.isfinite(step) and step > 0 for step in spacing):
        raise ReadError(file, f"it states cells of {spacing[0]:g} m x {spacing[1]:g} m", f"pass {_SIZE_HINT}")
    doubts = found.doubts
    grid = Grid(found.heights.shape, spacing, found.periodic if periodic is None else periodic)
    periodic_note = (
        ("read as free, though the file says that it is periodic",)
        if found.periodic and not any(grid.periodic)
        else ()
    )
    with np.errstate(over="ignore"):  # what becomes infinite is refused below
        heights = found.heights * factor
    if (peak := highest(heights)) > IMPOSSIBLE:
        raise ReadError(
            file,
            f"it holds heights up to {peak:.3g} m",
            "check that the file is whole and its unit is right (unit=)",
        )
    try:
        surface = Surface(heights, grid)
    except ValueError as error:
        raise ReadError(file, str(error), "check that it is the right file and channel") from error
    doubts = (*doubts, *doubts_about(surface.heights, grid.lengths))
    channel = "" if found.channel is None else f", channel {found.channel!r}"
    provenance = (
        f"read from {file} ({found.format}{channel}, sha256 {digest})",
        *unit_note,
        *size_note,
        *periodic_note,
        *found.notes,
        *doubts,
    )
    return replace(surface, provenance=provenance), doubts


def _require(found: HeightMap, file: str, unit: Length | None, size: object) -> None:
    """Refuse a file that leaves open what the user has left open too."""
    problems, hints = [], []
    if unit is None and not is_length(found.unit):
        problems.append(
            "no unit of its heights"
            if found.unit is None
            else f"heights in {found.unit!r}, which is no length known here"
        )
        hints.append(_UNIT_HINT)
    if size is None and found.spacing is None and found.steps is None:
        problems.append("no size")
        hints.append(_SIZE_HINT)
    if problems:
        raise ReadError(file, f"it states {' and '.join(problems)}", f"pass {' and '.join(hints)}")


def _factor(found: HeightMap, unit: Length | None) -> tuple[float, tuple[str, ...]]:
    """Return the metres in one unit of the heights, and a remark where the user states it."""
    if unit is not None:
        stated = "the file states none" if found.unit is None else f"instead of the file's {found.unit}"
        return length_factor(unit), (f"unit of the heights {unit} as given, {stated}",)
    if found.unit is None:
        raise AssertionError("a missing unit is refused before")
    return length_factor(found.unit), ()


def _spacing(
    found: HeightMap, factor: float, size: Size | None
) -> tuple[tuple[float, float], tuple[str, ...]]:
    """Return the cell (dy, dx) [m], and a remark where the user states the size."""
    ny, nx = found.heights.shape
    stated = found.spacing
    if stated is None and found.steps is not None:
        stated = (found.steps[0] * factor, found.steps[1] * factor)
    if size is None:
        if stated is None:
            raise AssertionError("a missing size is refused before")
        return stated, ()
    spacing = cell_of(size, (ny, nx))
    instead = (
        "the file states none"
        if stated is None
        else f"instead of the file's {stated[0] * ny:.6g} x {stated[1] * nx:.6g}"
    )
    return spacing, (f"size {spacing[0] * ny:.6g} x {spacing[1] * nx:.6g} m (y, x) as given, {instead}",)


def cell_of(size: Size, shape: tuple[int, int]) -> tuple[float, float]:
    """Return the cell (dy, dx) [m] of a map (ny, nx) from its width (square cells) or from (Ly, Lx)."""
    if isinstance(size, str) or not isinstance(size, Iterable):
        step = parse_length(size) / shape[1]
        return step, step
    lengths = tuple(size)
    if len(lengths) != 2:
        raise ValueError(f"size needs a width or two lengths (Ly, Lx), not {len(lengths)}: {lengths}")
    return parse_length(lengths[0]) / shape[0], parse_length(lengths[1]) / shape[1]
