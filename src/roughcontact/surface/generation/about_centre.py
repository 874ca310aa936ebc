"""Shared parts of shapes: coordinates about a centre, and checks."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, number, require

__all__ = ["RIM", "Centre", "from_centre", "placed", "plane", "positive", "squared"]

# Rounding must not decide on which side of a rim a cell lies.
RIM = 1e-9

Centre = Sequence[float] | float | None


def from_centre(grid: Grid, centre: Centre) -> tuple[Array, ...]:
    """Return the coordinates of the cells less those of the centre [m], an open mesh ``(y, x)`` or ``(x,)``."""
    if centre is None:
        centre = [length / 2 for length in grid.lengths]
    given = np.atleast_1d(number(centre, "centre [m]"))
    if given.shape != (grid.ndim,) or not np.isfinite(given).all():
        raise about("centre", f"needs {grid.ndim} finite coordinates [m], not {centre}")
    parts = []
    for n, step, c, periodic in zip(grid.shape, grid.spacing, given, grid.periodic, strict=True):
        part = (np.arange(n) + 0.5) * step - c
        if periodic:
            part -= n * step * np.round(part / (n * step))
        parts.append(part)
    return tuple(np.meshgrid(*parts, indexing="ij", sparse=True))


def plane(grid: Grid, centre: Centre) -> tuple[Array, Array]:
    """Return the coordinates ``(y, x)`` on a grid of two axes."""
    require(grid.ndim == 2, "this shape needs a grid of two axes, not a line")
    y, x = from_centre(grid, centre)
    return y, x


def squared(grid: Grid, centre: Centre) -> Array:
    """Return the squared distance from the centre [m^2], shape ``grid.shape``."""
    total = np.zeros(grid.shape)
    for part in from_centre(grid, centre):
        total += part**2
    return total


def placed(heights: Array, grid: Grid, name: str) -> Surface:
    """Return the surface of heights, at least one of which must not be NaN.

    Raises
    ------
    ValueError
        If all heights are NaN.
    """
    if np.isnan(heights).all():
        raise InputError(f"no cell centre lies in the {name}", "refine the grid or move the centre")
    return Surface(heights, grid, (name,))


def positive(**values: float) -> None:
    """Refuse values that are not positive and finite, by their names."""
    for name, value in values.items():
        require(
            math.isfinite(value) and value > 0, f"{name} must be positive and finite, not {value}", place=name
        )
