"""The half-space under loads that repeat themselves along one axis: a row of contacts, a rough strip."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.fft

from roughcontact.arrays import fast_even_length
from roughcontact.cached import cached_property
from roughcontact.convolution import Convolution, padded_length
from roughcontact.grid import Grid
from roughcontact.halfspace.influence.love_singly_periodic import repeated_love
from roughcontact.halfspace.influence.tables import Love, Tables
from roughcontact.halfspace.operators.cell_list import CellsOperator
from roughcontact.halfspace.operators.operator import Capabilities
from roughcontact.halfspace.sums.spectral import FreeOperator
from roughcontact.material import Solid, as_modulus
from roughcontact.validation import numeric

__all__ = ["Row", "SinglyPeriodicOperator", "singly_periodic"]

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.intp]
Offsets = npt.NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Row:
    """A uniformly loaded cell and its images along one axis, on a half-space of reduced modulus `modulus` [Pa]."""

    grid: Grid
    modulus: float
    reference: float

    @property
    def axis(self) -> int:
        """The axis along which the load repeats itself."""
        return self.grid.periodic.index(True)

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa]; along the periodic axis it is even about half the period."""
        along = self.axis
        period = self.grid.shape[along]
        half = min(shape[along], period // 2 + 1)
        values = self._values(np.arange(shape[1 - along]), np.arange(half)[:, None])  # rows along the period
        steps = np.arange(shape[along])
        values = values[np.minimum(steps, period - steps)]
        return np.ascontiguousarray(values if along == 0 else values.T)

    def at(self, rows: Offsets, columns: Offsets) -> Array:
        """Return single values [m/Pa]."""
        offsets = np.broadcast_arrays(rows, columns)
        across, along = offsets[1 - self.axis], offsets[self.axis]
        return self._values(across.ravel(), along.ravel()).reshape(across.shape)

    def _values(self, across: Offsets, along: Offsets) -> Array:
        step_along, step_across = self.grid.spacing[self.axis], self.grid.spacing[1 - self.axis]
        value = repeated_love(
            across * step_across,
            along * step_along,
            (step_across, step_along),
            self.grid.lengths[self.axis],
            self.reference,
        )
        value /= math.pi * self.modulus
        return value

    def inverse(self, shape: tuple[int, int]) -> Array:
        """Return E* q/2 [Pa/m]: that of the half-space as if it repeated itself along both axes."""
        return Love(self.grid.spacing, self.modulus).inverse(shape)

    def coarsened(self, grid: Grid) -> None:
        """Return None: the cells of `grid`, which lie in a window, need not divide the period."""


@dataclass(frozen=True, eq=False)
class SinglyPeriodicOperator:
    """A convolution that wraps around along one axis and is padded by zeros along the other.

    Positive definite, and no pressure lifts any cell: displacements vanish at the reference length, which no cell
    of the grid reaches.

    Parameters
    ----------
    grid : Grid
        Grid of two axes, periodic along one.
    influence : Tables
        Influence function on its cells, with its images.
    """

    grid: Grid
    influence: Tables
    positive: bool = True

    @property
    def capabilities(self) -> Capabilities:
        """What it can do beyond the protocol."""
        return Capabilities(
            modulus=self._row.modulus,
            positive=self.positive,
            single_precision=True,
            submatrix=self.submatrix,
            coarsened=self.coarsened,
            approximate_inverse=self.approximate_inverse,
        )

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.grid.cell_area

    @property
    def _row(self) -> Row:
        row = self.influence.influence
        assert isinstance(row, Row)
        return row

    @cached_property
    def _padded(self) -> tuple[int, int]:
        lengths = [padded_length(n) for n in self.grid.shape]  # the period stays what it is
        lengths[self._row.axis] = self.grid.shape[self._row.axis]
        return lengths[0], lengths[1]

    @cached_property
    def _product(self) -> Convolution:
        along = self._row.axis
        shape = [n // 2 + 1 for n in self._padded]
        shape[along] = self.grid.shape[along]
        even = np.zeros(shape)
        table = self.influence.table(self.grid.shape)
        even[: table.shape[0], : table.shape[1]] = table
        even = scipy.fft.dct(even, type=1, axis=1 - along, overwrite_x=True)
        multiplier = np.ascontiguousarray(scipy.fft.rfft(even, axis=along, overwrite_x=True).real)
        return Convolution(multiplier, self._padded)

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        return self._product.apply(pressure)

    @cached_property
    def _inverse(self) -> Convolution:
        lengths = [fast_even_length(n) for n in self.grid.shape]
        lengths[self._row.axis] = self.grid.shape[self._row.axis]
        box = (lengths[0], lengths[1])
        return Convolution(self.influence.inverse(box), box)

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a pressure [Pa] that would cause about this `displacement` [m]: every wave by E* q/2."""
        return self._inverse.apply(displacement)

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells` (flat indices; all cells without)."""
        return self.submatrix(np.arange(self.grid.size) if cells is None else cells).as_matrix()

    def submatrix(self, cells: Cells) -> CellsOperator:
        """Return the map between a list of cells (flat indices), with no pressure elsewhere."""
        return CellsOperator.of(self.grid, self.influence, cells, self.positive)

    def restrict(self, window: tuple[slice, ...]) -> SinglyPeriodicOperator | FreeOperator:
        """Return the map between the cells of `window`, with no pressure outside."""
        part = self.grid.window(window)
        if part.shape == self.grid.shape:
            return self
        if part.shape[self._row.axis] < self.grid.shape[self._row.axis]:
            return FreeOperator(part, self.influence, self.positive)
        # A window that holds the whole period keeps it.
        return SinglyPeriodicOperator(Grid(part.shape, part.spacing, self.grid.periodic), self.influence)

    def coarsened(self, grid: Grid) -> SinglyPeriodicOperator:
        """Return the same body on `grid`, whose cells are larger."""
        row = Row(grid, self._row.modulus, self._row.reference)
        return SinglyPeriodicOperator(grid, Tables(row, grid.shape))


@numeric
def singly_periodic(
    grid: Grid, modulus: float | Solid | tuple[Solid, Solid], *, reference_length: float | None = None
) -> SinglyPeriodicOperator:
    """Return the half-space under loads that repeat themselves along one axis and are alone along the other.

    Parameters
    ----------
    grid : Grid
        Grid of two axes, periodic along one of them.
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa], or what it follows from.
    reference_length : float, optional
        Distance from the row of loads at which its displacement vanishes on the mean [m]; without, the longest
        distance on the grid, half a period and the whole of the other axis. Depths hang on it, by
        ``2 F ln(L2/L1)/(pi E* period)``: a row of loads sinks without bound into an endless body. Pressures at given
        force do not.

    Raises
    ------
    ValueError
        If the grid is not periodic along one axis, or the reference length is shorter than the longest distance.

    Notes
    -----
    Forces are those on one period. Cells under constant pressure and displacements in their middles, as on a free
    grid, and all images of them (`roughcontact.halfspace.influence.love_singly_periodic`). A constant
    pressure is no exception: it presses the body down.
    """
    value = as_modulus(modulus)
    if not isinstance(grid, Grid) or grid.ndim != 2 or sum(grid.periodic) != 1:
        raise ValueError(
            "a row of contacts needs a grid of two axes that is periodic along one of them: "
            "Grid((ny, nx), spacing, periodic=(True, False))"
        )
    longest = math.hypot(*(n / 2 if p else n for n, p in zip(grid.lengths, grid.periodic, strict=True)))
    reference = longest if reference_length is None else float(reference_length)
    if not (math.isfinite(reference) and reference >= longest * (1 - 1e-9)):
        raise ValueError(
            f"the reference length must be finite and at least the longest distance on the grid, {longest:g} m, not "
            f"{reference:g}: with a shorter one a load would lift cells far away"
        )
    return SinglyPeriodicOperator(grid, Tables(Row(grid, value, reference), grid.shape))
