"""The same surface, seen from another side."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from roughcontact.grid import Grid
from roughcontact.validation import numeric

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["flipped", "rotated", "transposed"]


def transposed(surface: Surface) -> Surface:
    """Return the surface with rows and columns exchanged: mirrored about the diagonal of the picture."""
    return replace(
        surface,
        heights=surface.heights.T,
        grid=_exchanged(surface.grid),
        provenance=(*surface.provenance, "transposed"),
    )


def flipped(surface: Surface, axis: Literal["y", "x"]) -> Surface:
    """Return the surface mirrored: along ``"y"`` top and bottom change places, along ``"x"`` left and right."""
    axes = {"x": -1} | ({"y": 0} if surface.grid.ndim == 2 else {})
    if axis not in axes:
        raise ValueError(f"axis must be one of {', '.join(axes)}, not {axis!r}")
    heights = np.flip(surface.heights, axes[axis])
    return replace(surface, heights=heights, provenance=(*surface.provenance, f"flipped along {axis}"))


@numeric
def rotated(surface: Surface, quarters: int = 1) -> Surface:
    """Return the surface turned counter-clockwise, as the picture shows it, by `quarters` of a turn."""
    if surface.grid.ndim != 2:
        raise ValueError("only a surface of two axes can be turned; flip a line")
    grid = _exchanged(surface.grid) if quarters % 2 else surface.grid
    line = f"rotated by {90 * (quarters % 4)} degrees counter-clockwise"
    return replace(
        surface,
        heights=np.rot90(surface.heights, quarters),
        grid=grid,
        provenance=(*surface.provenance, line),
    )


def _exchanged(grid: Grid) -> Grid:
    return Grid(grid.shape[::-1], grid.spacing[::-1], grid.periodic[::-1])
