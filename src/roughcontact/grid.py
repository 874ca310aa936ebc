"""Where the cells are: one frozen value that also carries the boundary condition."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

__all__ = ["Grid"]


@dataclass(frozen=True, slots=True)
class Grid:
    """A regular grid of cells, in one or two dimensions.

    Parameters
    ----------
    shape : tuple of int
        Number of cells: ``(ny, nx)`` for a surface, ``(n,)`` for a line. The first axis is y.
    spacing : tuple of float
        Size of a cell along each axis, ``(dy, dx)`` [m]. One number serves every axis.
    periodic : bool or tuple of bool
        Whether the body repeats itself along each axis. This is the only place where the boundary
        condition is stated.

    Raises
    ------
    ValueError
        If a size is not a positive whole number or a spacing is not positive and finite.

    Notes
    -----
    Lengths are ``n * spacing``: cells, not nodes (docs/conventions.md).
    """

    shape: tuple[int, ...]
    spacing: tuple[float, ...]
    periodic: tuple[bool, ...] = (False,)

    def __init__(
        self,
        shape: int | Sequence[int],
        spacing: float | Sequence[float],
        periodic: bool | Sequence[bool] = False,
    ) -> None:
        sizes: tuple[int, ...] = tuple(np.atleast_1d(shape).tolist())
        if len(sizes) not in (1, 2):
            raise ValueError(f"shape must have one or two axes, not {len(sizes)}: {sizes}")
        if any(int(n) != n or n < 1 for n in sizes):
            raise ValueError(f"shape must hold positive whole numbers of cells, not {sizes}")
        steps = _per_axis(spacing, len(sizes), "spacing")
        if any(not (math.isfinite(step) and step > 0) for step in steps):
            raise ValueError(f"spacing must be positive and finite [m], not {steps}")
        object.__setattr__(self, "shape", tuple(int(n) for n in sizes))
        object.__setattr__(self, "spacing", tuple(float(step) for step in steps))
        object.__setattr__(
            self, "periodic", tuple(bool(b) for b in _per_axis(periodic, len(sizes), "periodic"))
        )

    @property
    def lengths(self) -> tuple[float, ...]:
        """Side lengths, ``shape * spacing`` [m]."""
        return tuple(n * step for n, step in zip(self.shape, self.spacing, strict=True))

    @property
    def size(self) -> int:
        """Number of cells."""
        return math.prod(self.shape)

    @property
    def ndim(self) -> int:
        """Number of axes."""
        return len(self.shape)

    @property
    def cell_area(self) -> float:
        """Area of a cell [m^2]; on a line its length [m]."""
        return math.prod(self.spacing)

    @property
    def area(self) -> float:
        """Nominal area of all cells [m^2]; on a line its length [m]."""
        return self.size * self.cell_area

    def window(self, slices: tuple[slice, ...]) -> Grid:
        """Return the free grid of the cells in `slices` (one slice of step 1 an axis)."""
        shape = tuple(len(range(*part.indices(n))) for part, n in zip(slices, self.shape, strict=True))
        return Grid(shape, self.spacing, periodic=False)


def _per_axis(value: Any, ndim: int, name: str) -> tuple[Any, ...]:
    """Return `value` once for every axis."""
    if np.ndim(value) == 0:
        return (value,) * ndim
    if len(value) != ndim:
        raise ValueError(f"{name} needs one value or {ndim}, not {len(value)}: {value}")
    return tuple(value)
