"""Grids of cells: frozen values that also carry the boundary condition."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.guesses import hinted
from roughcontact.units import in_si
from roughcontact.validation import LARGEST, SMALLEST, Array, exactly_one, moderate, scalar

__all__ = ["AnyGrid", "Grid", "RadialGrid"]


@hinted
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
        Whether the body is periodic along each axis. This is the only place of the boundary condition.
    size : float or tuple of float
        Instead of the spacing: the width Lx of the grid with square cells, or ``(Ly, Lx)`` [m], as in `read`. It is the
        length of all cells, ``n * spacing``.

    Raises
    ------
    ValueError
        If a number of cells is not a positive whole number, or a spacing is not positive and finite; if both or neither
        of spacing and size are given.

    Notes
    -----
    Lengths are ``n * spacing``: cells, not nodes (docs/concepts/conventions.md). Rows run along x; y increases
    downwards.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid(shape=(4, 8), spacing=0.5e-6, periodic=(False, True))
    >>> grid.lengths, grid.size
    ((2e-06, 4e-06), 32)
    >>> rc.Grid((4, 8), size=4e-6).spacing
    (5e-07, 5e-07)
    """

    shape: tuple[int, ...]
    spacing: tuple[float, ...]
    periodic: tuple[bool, ...] = (False,)

    def __init__(
        self,
        shape: int | Sequence[int],
        spacing: float | Sequence[float] | None = None,
        periodic: bool | Sequence[bool] = False,
        *,
        size: float | Sequence[float] | None = None,
    ) -> None:
        sizes: tuple[int, ...] = tuple(np.atleast_1d(shape).tolist())
        if len(sizes) not in (1, 2):
            raise about("shape", f"must have one or two axes, not {len(sizes)}: {sizes}")
        if any(not _is_real(n) or n % 1 != 0 or n < 1 for n in sizes):
            raise about("shape", f"must hold positive whole numbers of cells, not {sizes}")
        given, stated = exactly_one(spacing=spacing, size=size)
        lengths = in_si(stated, "m", given)
        steps = _per_axis(lengths, len(sizes), given)
        if any(not (_is_real(step) and 0 < step < math.inf) for step in steps):
            remedy = "give metres, such as 1e-6" if any(isinstance(step, str) for step in steps) else None
            raise about(given, f"must be positive, finite numbers [m], not {steps}", remedy)
        if given == "size":
            cells = (sizes[-1],) * len(sizes) if np.ndim(lengths) == 0 else sizes
            steps = tuple(length / n for length, n in zip(steps, cells, strict=True))
        # The spacing of a line may be the area of listed cells.
        area = math.prod(scalar(step, "spacing [m]") for step in steps)
        if not SMALLEST**2 <= area <= LARGEST**2:
            raise about(
                "spacing",
                f"must give cells between {SMALLEST**2:g} and {LARGEST**2:g} in size, for which products keep "
                f"their digits, not {steps}",
                "give lengths in other units",
            )
        object.__setattr__(self, "shape", tuple(int(n) for n in sizes))
        object.__setattr__(self, "spacing", tuple(float(step) for step in steps))
        repeats = _per_axis(periodic, len(sizes), "periodic")
        if any(b not in (True, False) for b in repeats):
            raise about("periodic", f"must hold True or False, not {repeats}")
        object.__setattr__(self, "periodic", tuple(bool(b) for b in repeats))

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
        """Area of a cell [m^2]; its length [m] on a line."""
        return math.prod(self.spacing)

    @property
    def area(self) -> float:
        """Nominal area of all cells [m^2]; their length [m] on a line."""
        return self.size * self.cell_area

    @property
    def coordinates(self) -> tuple[Array, ...]:
        """Centres of the cells along each axis [m], counted from the first corner."""
        pairs = zip(self.shape, self.spacing, strict=True)
        return tuple(np.asarray((np.arange(n) + 0.5) * step, dtype=np.float64) for n, step in pairs)

    @property
    def ends(self) -> tuple[tuple[int, ...], ...]:
        """Indices of the outermost cells along each free axis, at the edge of the map."""
        return tuple(() if periodic else (0, -1) for periodic in self.periodic)

    def window(self, slices: tuple[slice, ...]) -> Grid:
        """Return the free grid of a block of cells.

        Parameters
        ----------
        slices : tuple of slice
            Range of cells along each axis, of step 1.

        Returns
        -------
        Grid
            Cells of the same size, free along every axis.

        Examples
        --------
        >>> import roughcontact as rc
        >>> rc.Grid((4, 8), 1e-6, periodic=True).window((slice(0, 2), slice(2, 8)))
        Grid(shape=(2, 6), spacing=(1e-06, 1e-06), periodic=(False, False))
        """
        shape = tuple(len(range(*part.indices(n))) for part, n in zip(slices, self.shape, strict=True))
        return self._of_cells(shape, self.spacing)

    def listed(self, count: int) -> Grid:
        """Return a line of listed cells, whose length is the area of a cell of this grid.

        Parameters
        ----------
        count : int
            Number of cells, at least one.

        Returns
        -------
        Grid
            A grid of one axis; its spacing is the area of a cell [m^2].

        Examples
        --------
        >>> import roughcontact as rc
        >>> rc.Grid((4, 8), 2e-6).listed(3).spacing
        (4e-12,)
        """
        return self._of_cells((count,), (self.cell_area,))

    @classmethod
    def _of_cells(cls, shape: tuple[int, ...], spacing: tuple[float, ...]) -> Grid:
        """Return a free grid from checked values, for grids that a solve makes."""
        grid = object.__new__(cls)
        for name, value in (("shape", shape), ("spacing", spacing), ("periodic", (False,) * len(shape))):
            object.__setattr__(grid, name, value)
        return grid


@hinted
@dataclass(frozen=True, slots=True, eq=False)
class RadialGrid:
    """Rings of any widths about an axis.

    Parameters
    ----------
    edges : array, shape (n + 1,)
        Radii of the circles that bound the n rings, increasing [m]. If the first is 0, the innermost ring is a disc.

    Raises
    ------
    ValueError
        If the radii are negative or do not increase.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid([0.0, 1e-6, 3e-6])
    >>> rings.radii.tolist(), f"{rings.area:.4g} m^2"
    ([5e-07, 2e-06], '2.827e-11 m^2')
    """

    edges: Array

    def __post_init__(self) -> None:
        given = np.asarray(in_si(self.edges, "m", "edges"))
        if given.dtype.kind not in "fiu":
            raise about("edges", f"must be radii [m], real numbers, not of type {given.dtype}")
        edges = np.array(given, dtype=np.float64)
        if edges.ndim != 1 or len(edges) < 2:
            raise about("edges", f"must hold the radii of at least two circles, not shape {edges.shape}")
        if not (np.isfinite(edges).all() and edges[0] >= 0 and (np.diff(edges) > 0).all()):
            raise about("edges", "must be finite radii [m] that increase strictly, from 0 or above")
        for width in (np.diff(edges).min(), edges[-1]):
            moderate(float(width), "edges and widths of rings [m]")
        edges.flags.writeable = False
        object.__setattr__(self, "edges", edges)

    @classmethod
    def uniform(cls, rings: int, radius: float) -> RadialGrid:
        """Return rings of equal width over a disc.

        Parameters
        ----------
        rings : int
            Number of rings.
        radius : float
            Radius of the disc [m].

        Returns
        -------
        RadialGrid
            Rings of the width ``radius / rings``.

        Raises
        ------
        ValueError
            If the number of rings is not a positive whole number, or the radius is not positive and finite.

        Examples
        --------
        >>> import roughcontact as rc
        >>> rc.RadialGrid.uniform(4, 1e-3).radii.tolist()
        [0.000125, 0.000375, 0.000625, 0.000875]
        """
        radius = in_si(radius, "m", "radius")
        numbers = _is_real(rings) and _is_real(radius)
        if not (numbers and rings >= 1 and rings % 1 == 0 and 0 < radius < math.inf):
            raise InputError(
                f"a disc needs a whole number of rings, at least one, and a radius above 0, not {rings} and {radius}",
                place="rings, radius",
            )
        return cls(np.linspace(0.0, moderate(scalar(radius, "radius [m]"), "radius [m]"), int(rings) + 1))

    def __eq__(self, other: object) -> bool:
        """Whether both grids have the same circles."""
        return isinstance(other, RadialGrid) and np.array_equal(self.edges, other.edges)

    def __hash__(self) -> int:
        return hash(self.edges.tobytes())

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of rings, as a tuple."""
        return (len(self.edges) - 1,)

    @property
    def size(self) -> int:
        """Number of rings."""
        return len(self.edges) - 1

    @property
    def ndim(self) -> int:
        """Number of axes: one."""
        return 1

    @property
    def periodic(self) -> tuple[bool, ...]:
        """False: rings are not periodic."""
        return (False,)

    @property
    def radii(self) -> Array:
        """Mean of the two radii of each ring [m], shape (n,)."""
        return np.asarray((self.edges[1:] + self.edges[:-1]) / 2)

    @property
    def coordinates(self) -> tuple[Array, ...]:
        """The mean radii [m], as a tuple."""
        return (self.radii,)

    @property
    def spacing(self) -> tuple[float, ...]:
        """Mean width of a ring [m], as a tuple."""
        return (float(self.edges[-1] - self.edges[0]) / self.size,)

    @property
    def lengths(self) -> tuple[float, ...]:
        """Outermost radius [m], as a tuple."""
        return (float(self.edges[-1]),)

    @property
    def cell_area(self) -> Array:
        """Area of each ring [m^2], shape (n,)."""
        # The difference of two squares, without their cancellation.
        return np.asarray(2 * math.pi * self.radii * np.diff(self.edges))

    @property
    def area(self) -> float:
        """Area of all rings [m^2]."""
        return float(self.cell_area.sum())

    @property
    def ends(self) -> tuple[tuple[int, ...], ...]:
        """Indices of the rings at the edge: the last, and the first if there is a hole."""
        return ((0, -1) if self.edges[0] > 0 else (-1,),)

    def window(self, slices: tuple[slice, ...]) -> RadialGrid:
        """Return a range of neighbouring rings.

        Parameters
        ----------
        slices : tuple of slice
            One slice of step 1.

        Returns
        -------
        RadialGrid
            The rings in the slice.

        Examples
        --------
        >>> import roughcontact as rc
        >>> rc.RadialGrid.uniform(4, 1e-3).window((slice(1, 3),)).edges.tolist()
        [0.00025, 0.0005, 0.00075]
        """
        start, stop, _ = slices[0].indices(self.size)
        return RadialGrid(self.edges[start : stop + 1])


AnyGrid = Grid | RadialGrid


def _is_real(value: object) -> bool:
    return isinstance(value, Real)


def _per_axis(value: Any, ndim: int, name: str) -> tuple[Any, ...]:
    """Return `value` once for every axis."""
    if np.ndim(value) == 0:
        return (value,) * ndim
    if len(value) != ndim:
        raise InputError(f"{name} needs one value or {ndim}, not {len(value)}: {value}", place=name)
    return tuple(value)
