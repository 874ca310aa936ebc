"""Influence functions: the displacement of every cell under a unit pressure on one."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from roughcontact.grid import Grid
from roughcontact.halfspace.influence.love import love, love_table, strip, wave_compliance
from roughcontact.kernels.loader import functions, is_available
from roughcontact.validation import Array

__all__ = [
    *("Influence", "Love", "Periodic", "Strip", "Tables"),
    *("blocks", "definite", "definite_columns", "spans", "table_of_waves", "wavenumbers"),
]

# Cells to the side of a table up to which it is made of the waves one by one (timed by benchmarks/pairs.py).
SMALL_TABLE = 64
LARGE_PLANE = (
    2**26
)  # cells of a period from which on waves are taken by columns, this number of cells at a time
FEW_WAVES = 64
MATRIX_ROWS = 16  # rows of a matrix that are made in one go at least, so that their offsets stay in cache
# Cells to the side of the first table: single values cost much within, and a short series beyond.
FIRST_TABLE = 64
ALL = slice(None)

Offsets = npt.NDArray[np.intp]


class Influence(Protocol):
    """An even, translation-invariant influence function on cells of one size."""

    @property
    def modulus(self) -> float | None:
        """Reduced modulus E* [Pa] of a half-space; None of another body."""

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the displacement per pressure [m/Pa] at offsets of whole cells from zero up to `shape`."""

    def at(self, rows: Offsets, columns: Offsets) -> Array:
        """Return the displacement per pressure [m/Pa] at offsets of whole cells."""

    def coarsened(self, grid: Grid) -> Influence | None:
        """Return the influence function of the same body on the cells of `grid`; None if there is none."""

    def inverse(self, shape: tuple[int, int]) -> Array:
        """Return the pressure per displacement wave [Pa/m] on a box of `shape` cells, rows and columns from 0."""


@dataclass(frozen=True, slots=True)
class Love:
    """A uniformly loaded cell on a free half-space of reduced modulus `modulus` [Pa] (thesis, eq. A.15)."""

    spacing: tuple[float, ...]
    modulus: float

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa]."""
        table = love_table(shape, self.spacing)
        table /= math.pi * self.modulus
        return table

    def at(self, rows: Offsets, columns: Offsets) -> Array:
        """Return single values [m/Pa]."""
        dy, dx = self.spacing
        return love(columns * dx, rows * dy, dx, dy) / (math.pi * self.modulus)

    def inverse(self, shape: tuple[int, int]) -> Array:
        """Return E* q/2 [Pa/m]: that of the half-space as if it repeated itself."""
        return self.modulus / 2 * definite(wavenumbers(shape, self.spacing))

    def coarsened(self, grid: Grid) -> Love:
        """Return the same body on the cells of `grid`."""
        return Love(grid.spacing, self.modulus)


@dataclass(frozen=True, slots=True)
class Strip:
    """A uniformly loaded strip, endless along y, on a half-space of reduced modulus `modulus` [Pa] (thesis, eq. A.45).

    Displacements are means over a strip, in a plane of one row. They vanish at `reference` [m] from a load:
    the logarithm has no other zero.
    """

    spacing: tuple[float, ...]
    modulus: float
    reference: float

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa] of one row."""
        return self.at(np.zeros(1, np.intp), np.arange(shape[-1]))[None]

    def at(self, rows: Offsets, columns: Offsets) -> Array:
        """Return single values [m/Pa]; there is but one row."""
        dx = self.spacing[-1]
        # The printed A.45 lacks the factor -2 (with it the sign) and hides the logarithm of the cell in a constant.
        return dx / (math.pi * self.modulus) * (strip(columns + 0 * rows) + 2 * math.log(self.reference / dx))

    def inverse(self, shape: tuple[int, int]) -> Array:
        """Return E* q/2 [Pa/m]: that of the half-space as if it repeated itself."""
        return self.modulus / 2 * definite(wavenumbers(shape, self.spacing))

    def coarsened(self, grid: Grid) -> Strip:
        """Return the same body on the cells of `grid`."""
        return Strip(grid.spacing, self.modulus, self.reference)


@dataclass(frozen=True, slots=True)
class Periodic:
    """Every wave of pressure on a periodic half-space answers with 2/(E* q) (Westergaard 1939).

    The mean displacement is zero, so a constant pressure moves nothing.
    """

    grid: Grid
    modulus: float

    def transfer_function(self, columns: slice = ALL) -> Array:
        """Return the displacement per pressure wave [m/Pa], shape ``(ny//2 + 1, nx//2 + 1)``, rows from 0 up.

        Of some columns, if no others are wanted.
        """
        return wave_compliance(wavenumbers(self.grid.shape, self.grid.spacing, columns)) / self.modulus

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa]."""
        (ny, nx), waves = self.grid.shape, self.grid.shape[1] // 2 + 1
        if max(shape) > SMALL_TABLE or ny * nx <= LARGE_PLANE:
            return table_of_waves(self.transfer_function(), self.grid.shape, shape)
        # Of planes in slabs no process has room for all waves; a few columns of the table are made of some at a time.
        along, across = _waves(ny, shape[0]), _waves(nx, shape[1])
        parts = (slice(start, start + FEW_WAVES) for start in range(0, waves, FEW_WAVES))
        return np.asarray(sum(along @ self.transfer_function(part) @ across[:, part].T for part in parts))

    def at(self, rows: Offsets, columns: Offsets) -> Array:
        """Return single values [m/Pa]."""
        a, b = np.abs(rows), np.abs(columns)
        return np.asarray(self.table((int(a.max(initial=0)) + 1, int(b.max(initial=0)) + 1))[a, b])

    def inverse(self, shape: tuple[int, int], columns: slice = ALL) -> Array:
        """Return E* q/2 [Pa/m], of some columns, if no others are wanted."""
        return self.modulus / 2 * definite_columns(shape, self.grid.spacing, columns)

    def coarsened(self, grid: Grid) -> Periodic | None:
        """Return the same body on the cells of `grid`; None in a window, whose cells need not divide the period."""
        return Periodic(grid, self.modulus) if all(grid.periodic) else None


@dataclass(frozen=True, slots=True, eq=False)
class _Table:
    """A table of the values at offsets from zero up, as part of `whole`, of which `first` columns lie before it."""

    values: Array
    whole: Array
    first: int = 0
    copies: dict[str, npt.NDArray[Any]] = field(default_factory=dict)  # of the whole, in other precisions

    def covers(self, shape: tuple[int, int]) -> bool:
        """Whether it has room to both sides for offsets within a shape."""
        return self.first >= shape[1] and self.whole.shape[0] >= shape[0]

    def at(self, rows: Offsets, columns: Offsets) -> Array:
        """Return single values; no offset is negative."""
        flat = rows * self.whole.shape[1] + columns
        if self.first:
            flat += self.first
        return np.asarray(self.whole.ravel().take(flat))


@dataclass(slots=True, eq=False)
class Tables:
    """An influence function that keeps its largest table and cuts smaller ones out of it.

    The windows of successive loads grow; each would need a new table, so that the second has room to spare. `limit`
    is the shape of the whole grid, beyond which no table is needed.
    """

    influence: Influence
    limit: tuple[int, ...]
    _largest: _Table = field(default_factory=lambda: _Table(np.zeros((0, 0)), np.zeros((0, 0))))
    _computed: int = 0  # single values that no table held

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa]; a view, not to be written to."""
        large = self._largest  # another thread may put another in its place
        if not _holds(large.values.shape, shape):
            table = self.influence.table(self._roomy(shape))
            large = self._largest = _Table(table, table)
        return large.values[: shape[0], : shape[1]]

    def to_both_sides(self, shape: tuple[int, int], precision: str) -> npt.NDArray[Any]:
        """Return the table [m/Pa] at offsets of rows from zero up and of columns to both sides of the middle one.

        It has room for offsets of up to `shape` cells; beyond the grid it is zero. Not to be written to.
        """
        large = self._largest
        if not large.covers(shape):
            inner = min(shape[0], self.limit[0]), min(shape[1], self.limit[1])
            half = (
                large.values
                if _holds(large.values.shape, inner)
                else self.influence.table(self._roomy(inner))
            )
            (ny, nx), rows, middle = half.shape, max(shape[0], half.shape[0]), max(shape[1], half.shape[1])
            whole = np.zeros((rows, 2 * middle))
            whole[:ny, middle : middle + nx] = half
            whole[:ny, middle - nx + 1 : middle] = half[:, :0:-1]
            large = self._largest = _Table(whole[:ny, middle : middle + nx], whole, middle)
        if precision != "float64" and precision not in large.copies:
            large.copies[precision] = large.whole.astype(precision)
        return large.copies.get(precision, large.whole)

    def covers(self, shape: tuple[int, int]) -> bool:
        """Whether a table to both sides of this shape is at hand."""
        return self._largest.covers(shape)

    def at(self, rows: Offsets, columns: Offsets, reach: tuple[int, ...] | None = None) -> Array:
        """Return single values [m/Pa], from the table where it holds them.

        A table is made as soon as single values have cost as much as it would. `reach` is the shape of the
        table that would hold them all, if the caller has it.
        """
        a, b = np.abs(rows), np.abs(columns)
        needed = reach or (int(a.max(initial=0)) + 1, int(b.max(initial=0)) + 1)
        self._begin(needed)
        if not self.has(needed):
            self._computed += np.broadcast(a, b).size
            if needed[0] * needed[1] <= self._computed:
                self.table(needed)
        large = self._largest  # another thread may put a larger one in its place
        if _holds(large.values.shape, needed):
            return large.at(a, b)
        a, b = np.broadcast_arrays(a, b)
        near = (a < large.values.shape[0]) & (b < large.values.shape[1])
        values = np.empty(a.shape)
        values[near] = large.values[a[near], b[near]]
        values[~near] = self.influence.at(a[~near], b[~near])
        return values

    def has(self, shape: tuple[int, ...]) -> bool:
        """Whether a table of this shape is at hand."""
        return _holds(self._largest.values.shape, shape)

    def reach(self, rows: Offsets, columns: Offsets) -> tuple[int, ...]:
        """Return the shape of a table of all offsets between cells: the whole grid's if it is at hand, or the least."""
        return self.limit if self.has(self.limit) else spans(rows, columns)

    def _begin(self, shape: tuple[int, ...]) -> None:
        """Make the first table, unless one of this shape is at hand."""
        if min(self._largest.values.shape) < FIRST_TABLE and not self.has(shape):
            self.table(tuple(min(FIRST_TABLE, end) for end in self.limit))

    def _roomy(self, shape: tuple[int, ...]) -> tuple[int, ...]:
        """Return the shape of a new table: at least `shape` and the present one, with spare room after the first."""
        large = self._largest.values
        spare = 4 if large.size > FIRST_TABLE * FIRST_TABLE else math.inf
        return tuple(
            min(end, max(have, n + int(n // spare)))
            for n, have, end in zip(shape, large.shape, self.limit, strict=True)
        )

    @property
    def modulus(self) -> float | None:
        """Reduced modulus E* [Pa] of a half-space; None of another body."""
        return self.influence.modulus

    def transfer_function(self) -> Array:
        """Return the displacement per pressure wave over a period [m/Pa]; only for what is periodic."""
        kernel: Any = self.influence
        transfer: Array = kernel.transfer_function()
        return transfer

    def inverse(self, shape: tuple[int, int]) -> Array:
        """Return the pressure per displacement wave [Pa/m]."""
        return self.influence.inverse(shape)

    def components(self) -> tuple[Callable[[Offsets, Offsets], Array], ...]:
        """Return the function itself, without its table."""
        return (self.influence.at,)

    def matrix(self, rows: Offsets, columns: Offsets) -> Array:
        """Return the matrix [m/Pa] between cells."""
        if len(rows) == 1:  # every operator is asked for it
            return self.table((1, 1)).copy()
        reach, matrix = self.reach(rows, columns), np.empty((len(rows), len(rows)))
        self._begin(reach)
        large = self._largest  # another thread may put another in its place
        if is_available() and _holds(large.values.shape, reach):
            places, width = (np.ascontiguousarray(k, np.int64) for k in (rows, columns)), large.whole.shape[1]
            between = functions("dense_kernels", "float64")["influence_between"]
            between(len(rows), *places, large.whole.ravel()[large.first :], width, matrix)
            return matrix
        for part in blocks(len(rows), len(rows)):
            matrix[part] = self.at(rows[part, None] - rows, columns[part, None] - columns, reach)
        return matrix

    def coarsened(self, grid: Grid) -> Tables | None:
        """Return the influence function of the same body on the cells of `grid`; None if there is none."""
        coarse = self.influence.coarsened(grid)
        return None if coarse is None else Tables(coarse, grid.shape)


def spans(rows: Offsets, columns: Offsets) -> tuple[int, int]:
    """Return the shape of the table that holds all offsets between cells of these rows and columns."""
    return (int(np.ptp(rows)) + 1, int(np.ptp(columns)) + 1) if rows.size else (1, 1)


def blocks(length: int, width: int) -> list[slice]:
    """Return the rows of a matrix in parts whose offsets stay in cache."""
    size = max(MATRIX_ROWS, 8192 // max(1, width))
    return [slice(start, start + size) for start in range(0, length, size)]


def table_of_waves(transfer: Array, period: tuple[int, ...], shape: tuple[int, ...]) -> Array:
    """Return the values, at offsets from zero up to `shape`, of what has this even transform over a period."""
    ny, nx = period
    if max(shape) <= SMALL_TABLE:  # a transform would make the whole table
        return _waves(ny, shape[0]) @ transfer @ _waves(nx, shape[1]).T
    import scipy.fft

    full = np.concatenate([transfer, transfer[ny - transfer.shape[0] : 0 : -1]])
    return np.ascontiguousarray(scipy.fft.irfft2(full, s=(ny, nx))[: shape[0], : shape[1]])


def _waves(length: int, count: int) -> Array:
    """Return what each wave of an even function of `length` cells contributes to its first values."""
    waves = np.arange(length // 2 + 1)
    often = np.where(waves * 2 % length == 0, 1.0, 2.0)
    return np.asarray(
        often / length * np.cos(2 * np.pi / length * (np.arange(count)[:, None] * waves % length))
    )


def _holds(large: tuple[int, ...], small: tuple[int, ...]) -> bool:
    return small[0] <= large[0] and small[1] <= large[1]


def wavenumbers(shape: tuple[int, ...], spacing: tuple[float, ...], columns: slice = ALL) -> Array:
    """Return |q| [rad/m] of the waves over a box, shape ``(ny//2 + 1, nx//2 + 1)``; beyond, they repeat.

    Of some columns, if no others are wanted.
    """
    qy, qx = (2 * np.pi * np.fft.rfftfreq(n, step) for n, step in zip(shape, spacing, strict=True))
    return np.asarray(np.sqrt(qy[:, None] ** 2 + qx[columns] ** 2))  # hypot takes several times as long


def definite_columns(shape: tuple[int, int], spacing: tuple[float, ...], columns: slice) -> Array:
    """Return some columns of the wavenumbers over a box, the mean as `definite` gives it."""
    q = wavenumbers(shape, spacing, columns)
    if columns.indices(shape[1])[0] == 0:  # the mean, and next to it the longest waves
        q[0, 0] = definite(wavenumbers(shape, spacing, slice(0, 2)))[0, 0]
    return q


def definite(wavenumber: Array) -> Array:
    """Give the mean the wavenumber of half the longest wave: an inverse without it would miss the mean for good."""
    waves = wavenumber[wavenumber > 0]
    wavenumber[0, 0] = 0.5 * waves.min() if waves.size else 1.0
    return wavenumber
