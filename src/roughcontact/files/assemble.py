"""A surface from the contents of a file and the arguments of the user."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from types import NoneType
from typing import Any

import numpy as np

from roughcontact.arrays import is_numpy
from roughcontact.errors import InputError, about
from roughcontact.files.file_bounds import BYTES_TO_LOOK, require_memory
from roughcontact.files.file_errors import ContentError
from roughcontact.files.height_warnings import DESPIKE, IMPOSSIBLE, height_warnings, highest
from roughcontact.files.heightmap import HeightMap
from roughcontact.files.length_units import is_length, length_factor, parse_length
from roughcontact.files.missing_marks import without_fills
from roughcontact.grid import Grid
from roughcontact.surface.surface import Surface
from roughcontact.units import in_si
from roughcontact.validation import scalar, shown

__all__ = ["Length", "Size", "assemble", "cell_of", "plain_lengths"]

Length = float | str
Size = Length | Iterable[Length]

_SAME = 1e-6  # relative: a typed size agrees with a stored one to its printed digits
_UNIT_HINT = "unit= with the unit of the heights, such as unit='um'"
_SIZE_HINT = "size= with the width or (Ly, Lx), such as size='500 um' or size=(4e-4, 5e-4)"
_LENGTH_HINT = "size= with the length of the line, such as size='500 um'"


def assemble(
    found: HeightMap,
    file: str,
    digest: str,
    *,
    unit: Length | None,
    size: Size | None,
    periodic: bool | tuple[bool, ...] | None,
) -> tuple[Surface, tuple[str, ...]]:
    """Return the surface of `found` and its warnings; what the user states overrides the file."""
    _require(found, unit, size)
    looked_at = is_numpy(found.heights)  # no search for spikes and noise in heights on several processes
    if looked_at:
        require_memory(BYTES_TO_LOOK * found.heights.size)
        heights, filled = without_fills(found.heights)
        found = replace(found, heights=heights, warnings=(*found.warnings, *filled))
    factor, unit_note = _factor(found, unit)
    spacing, size_note = _spacing(found, factor, size)
    remarks = (*unit_note, *size_note)
    contradictions = tuple(remark.text for remark in remarks if remark.contradicts)
    try:
        grid = Grid(found.heights.shape, spacing, found.periodic if periodic is None else periodic)
    except InputError as error:
        if error.place != "spacing":
            raise
        cells = " x ".join(f"{step:g} m" for step in spacing)
        raise ContentError(f"it states cells of {cells}", f"pass {_size_hint(found)}") from error
    claimed = any(found.periodic) if isinstance(found.periodic, tuple) else found.periodic
    periodic_note = (
        ("read as free, though the file states that it is periodic",)
        if claimed and not any(grid.periodic)
        else ()
    )
    with np.errstate(over="ignore"):  # infinite heights are refused below
        heights = found.heights * factor
    if (peak := highest(heights)) > IMPOSSIBLE:
        raise ContentError(
            f"it holds heights up to {peak:.3g} m",
            "pass unit= with the right unit, or write nan where this number marks a missing point",
            "unit",
        )
    try:
        surface = Surface(heights, grid)
    except InputError as error:
        if error.place == "heights":
            raise ContentError(error.message, error.remedy) from error
        raise ContentError(error.message, "pass unit= with the right unit", "unit") from error
    warnings = (*contradictions, *found.warnings)
    if looked_at:
        warnings += height_warnings(surface.heights, grid.spacing)
    channel = "" if found.channel is None else f", channel {found.channel!r}"
    provenance = (
        *found.history,
        f"read from {file} ({found.format}{channel}, sha256 {digest})",
        *(remark.text for remark in remarks if not remark.contradicts),
        *periodic_note,
        *found.notes,
        *(warning.removesuffix(DESPIKE) for warning in warnings),  # the advice may have been followed since
    )
    return replace(surface, provenance=provenance), warnings


def _require(found: HeightMap, unit: Length | None, size: object) -> None:
    """Refuse a file that lacks a unit or a size that the user has not stated either."""
    problems, hints, places = [], [], []
    if unit is None and not is_length(found.unit):
        problems.append(
            "no unit of its heights"
            if found.unit is None
            else f"heights in {found.unit!r}, which is no length known here"
        )
        hints.append(_UNIT_HINT)
        places.append("unit")
    if size is None and found.spacing is None and found.steps is None:
        unclear = "" if found.unclear is None else f" that is understood ({found.unclear})"
        problems.append(f"no size{unclear}")
        hints.append(_size_hint(found))
        places.append("size")
    if problems:
        raise ContentError(
            f"it states {' and '.join(problems)}", f"pass {' and '.join(hints)}", ", ".join(places)
        )


def _size_hint(found: HeightMap) -> str:
    return _SIZE_HINT if found.heights.ndim == 2 else _LENGTH_HINT


@dataclass(frozen=True, slots=True)
class _Remark:
    """A value stated by the user; a warning if it contradicts the file."""

    text: str
    contradicts: bool


def _factor(found: HeightMap, unit: Length | None) -> tuple[float, tuple[_Remark, ...]]:
    """Return the metres in one unit of the heights, and a remark if the user states it."""
    if unit is not None:
        factor = length_factor(unit)
        stated = "the file states none" if found.unit is None else f"instead of the file's {found.unit}"
        known = found.unit is not None and is_length(found.unit)
        differs = known and not math.isclose(length_factor(found.unit or 1.0), factor, rel_tol=_SAME)
        return factor, (_Remark(f"unit of the heights {unit} as given, {stated}", differs),)
    if found.unit is None:
        raise AssertionError("a missing unit is refused before")
    return length_factor(found.unit), ()


def _spacing(
    found: HeightMap, factor: float, size: Size | None
) -> tuple[tuple[float, ...], tuple[_Remark, ...]]:
    """Return the cell (dy, dx) or (dx,) [m], and a remark if the user states the size."""
    shape = found.heights.shape
    stated = found.spacing
    if stated is None and found.steps is not None:
        stated = tuple(step * factor for step in found.steps)
    if size is None:
        if stated is None:
            raise AssertionError("a missing size is refused before")
        return stated, ()
    spacing = cell_of(size, shape)
    instead = "the file states none" if stated is None else f"instead of the file's {_lengths(stated, shape)}"
    axes = " (y, x)" if len(shape) == 2 else ""
    # The steps are numbers without a unit, which cannot contradict a size.
    differs = found.spacing is not None and not np.allclose(found.spacing, spacing, rtol=_SAME, atol=0)
    return spacing, (_Remark(f"size {_lengths(spacing, shape)} m{axes} as given, {instead}", differs),)


def _lengths(spacing: tuple[float, ...], shape: tuple[int, ...]) -> str:
    return " x ".join(f"{step * n:.6g}" for step, n in zip(spacing, shape, strict=True))


def plain_lengths(unit: Any, size: Any) -> tuple[Length | None, Size | None]:
    """Return a unit of heights and a size as text or numbers of metres, whatever library of units they come from.

    Raises
    ------
    ValueError
        If they carry a unit that is not a length.
    """
    if not isinstance(unit, str | int | float | NoneType):
        try:
            unit = scalar(in_si(1.0 * unit, "m", "unit"), "unit")  # a unit, or a quantity
        except TypeError as error:
            raise about(
                "unit", f"must be a text such as 'nm', or metres per unit, not {shown(unit)}"
            ) from error
    size = in_si(size, "m", "size")
    return unit, tuple(size) if isinstance(size, Iterable) and not isinstance(size, str) else size


def cell_of(size: Size, shape: tuple[int, ...]) -> tuple[float, ...]:
    """Return the cell of a map (ny, nx) from its width (square cells) or from (Ly, Lx), of a line (n,) from Lx."""
    if isinstance(size, str) or not isinstance(size, Iterable):
        return (parse_length(size) / shape[-1],) * len(shape)
    lengths = tuple(size)
    if len(lengths) != len(shape):
        wanted = "a width or two lengths (Ly, Lx)" if len(shape) == 2 else "one length"
        raise about("size", f"needs {wanted}, not {len(lengths)}: {lengths}")
    return tuple(parse_length(length) / n for length, n in zip(lengths, shape, strict=True))
