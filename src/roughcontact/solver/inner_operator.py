"""What drives a solve on a region: an operator that need not be exact, since products with the exact one certify."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import is_numpy, largest, over, times
from roughcontact.halfspace.operators.operator import Linear, Operator, capabilities, self_influence
from roughcontact.halfspace.sums.local_inverse import RELIEF, LocalInverse
from roughcontact.halfspace.sums.particle_mesh import PatchOperator
from roughcontact.halfspace.sums.tiles import Tiles

__all__ = ["Driver", "Plane", "driver_on", "factorised", "first_product"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

FACTORISED = 1200  # cells: their third power, against some thirty products on few tiles
ROUGHLY = 300  # cells, where an answer is but the start of another: against a few products
LOOSE = 1e-5  # tolerance of such an answer
SINGLE = 4_000  # cells from which on half the numbers are half the work
SAFE = (
    1e-25  # influences between this and its inverse, and squares of answers, are numbers of single precision
)


class Driver(Linear, Protocol):
    """A symmetric map between some cells, in some precision, its preconditioner, and the way there and back."""

    @property
    def gain(self) -> float:
        """What one round can take off an error; 0 where the products are exact."""
        ...

    @property
    def relief(self) -> float:
        """What is taken off the diagonal of its inverse, of what that answers to a constant on a region."""
        ...

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a pressure [Pa] that would cause about this `displacement` [m]; symmetric and definite."""
        ...

    def gather(self, field: Any, beyond: float = 0.0) -> Any:
        """Return a field of the plane on the cells of the driver, another value beyond its edge."""
        ...

    def scatter(self, values: Any) -> Any:
        """Return the field of the plane that has `values` on these cells and is zero elsewhere."""
        ...

    def narrow(self, values: Any, unit: float = 1.0) -> Any:
        """Return numbers over a unit, in the precision of the driver."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class Plane:
    """All cells of an operator, in double precision."""

    operator: Operator
    gain: float = 0.0

    @property
    def weights(self) -> float | Array:
        """Force of a unit pressure on each cell [m^2]."""
        return self.operator.weights

    @property
    def local_inverse(self) -> LocalInverse | None:
        """What preconditions in machine code, if there is such a thing."""
        return capabilities(self.operator).local_inverse()

    @property
    def relief(self) -> float:
        """What is taken off the diagonal of that, of what it answers to a constant on a region."""
        return 0.0 if self.local_inverse is None else RELIEF

    def gather(self, field: Any, beyond: float = 0.0) -> Any:
        """Return the field."""
        return field

    def scatter(self, values: Any) -> Any:
        """Return the field."""
        return values

    def narrow(self, values: Any, unit: float = 1.0) -> Any:
        """Return the field over a unit."""
        return values if unit == 1 else over(values, unit, "float64")

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        return self.operator.apply(pressure)

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a pressure [Pa] that would cause about this `displacement` [m].

        Where nothing is known that is the displacement, over about what all cells together do to one: a pressure in
        any unit, and no step along it is much too long.
        """
        inverse = capabilities(self.operator).approximate_inverse
        if inverse is not None:
            return inverse(displacement)
        return displacement / (math.prod(displacement.shape) * self_influence(self.operator))


@dataclass(frozen=True, slots=True, eq=False)
class SinglePlane(Plane):
    """All cells of an operator, in single precision."""

    gain: float = 1e-4  # seven digits, of which a product loses one or two

    def narrow(self, values: Any, unit: float = 1.0) -> Any:
        """Return the field over a unit, in single precision."""
        return over(values, unit, "float32")

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        convolution = capabilities(self.operator).single_convolution
        return self.operator.apply(pressure) if convolution is None else convolution(pressure)


def driver_on(operator: Operator, region: Mask, previous: Driver | None = None) -> Driver:
    """Return what solves on a region at the least cost, the previous driver if it still does."""
    if isinstance(previous, PatchOperator) and previous.tiles.hold(region):
        return previous
    if not _tame(operator):
        return Plane(operator)
    tiles = _tiles_of(operator, region)
    if tiles is not None:
        mesh = capabilities(operator).particle_mesh()
        assert mesh is not None  # the tiles are its own
        return mesh.on(tiles)
    return previous if isinstance(previous, Plane) else _plane(operator)


def _tiles_of(operator: Operator, region: Mask) -> Tiles | None:
    """Return the tiles of a region; None where the whole plane costs less."""
    mesh = capabilities(operator).particle_mesh() if is_numpy(region) else None
    return None if mesh is None else mesh.tiles(region)


def first_product(operator: Operator, pressure: Array, driver: Driver | None = None) -> tuple[Array, bool]:
    """Return about the displacement [m] under a first guess of the pressure [Pa], and whether it is exact.

    A `driver` that has all cells under pressure tells it on its own cells alone.
    """
    size = largest(pressure)
    if driver is None:
        driver = _plane(operator) if _tame(operator) else Plane(operator)
        # Where tiles will drive, no kernel of single precision is made for the plane.
        if driver.gain and _tiles_of(operator, pressure > 0) is not None:
            driver = Plane(operator)
    if not (driver.gain and size > 0):
        return operator.apply(pressure), True
    part = driver.narrow(driver.gather(pressure), size)
    return times(driver.scatter(driver.apply(part)), size), False


def _tame(operator: Operator) -> bool:
    """Whether its influences are numbers of single precision."""
    return SAFE < self_influence(operator) < 1 / SAFE


def _plane(operator: Operator) -> Plane:
    single = capabilities(operator).single_precision and math.prod(operator.grid.shape) >= SINGLE
    return SinglePlane(operator) if single else Plane(operator)


def factorised(operator: Operator, limit: int, tolerance: float = 0.0) -> int:
    """Return up to how many cells a factorisation pays: fewer than `limit` where tiles compete with it."""
    if capabilities(operator).particle_mesh() is None:
        return limit
    return min(limit, FACTORISED if tolerance < LOOSE else ROUGHLY)
