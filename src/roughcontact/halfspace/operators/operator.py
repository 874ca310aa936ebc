"""What every linear map from pressure to displacement can do."""

from __future__ import annotations

from contextlib import suppress
from typing import Protocol, runtime_checkable
from weakref import WeakKeyDictionary

import numpy as np
import numpy.typing as npt

from roughcontact.grid import AnyGrid, Grid
from roughcontact.halfspace.operators.geometry import Geometry

__all__ = [
    "Coarsenable",
    "Invertible",
    "Linear",
    "Listable",
    "Operator",
    "exact_of",
    "geometry_of",
    "is_positive",
    "is_semidefinite",
    "keeps_precision",
    "self_influence",
    "self_influences",
]

Array = npt.NDArray[np.float64]
_known: WeakKeyDictionary[Operator, float] = WeakKeyDictionary()  # what several ask of one operator


class Linear(Protocol):
    """What conjugate gradients take: a linear map, symmetric under its weights."""

    @property
    def weights(self) -> float | Array:
        """Force of a unit pressure on each cell [m^2]."""
        ...

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        ...


@runtime_checkable
class Operator(Protocol):
    """A linear map from pressure [Pa] on the cells of a grid to displacement [m] of the same cells.

    Symmetric under its weights. On a free grid positive definite; on a periodic one semidefinite, since a
    constant pressure moves nothing.

    What else an operator can do, it may offer: `positive`, `between`, `coarsened`, `approximate_inverse`,
    `local_inverse`, `keeps_precision`, `quick`, `patches`, `listed`. Each makes solves faster and none changes an
    answer. Where cells differ, `diagonal` is the displacement of each per unit pressure on itself. One whose sum is not
    exact has the `exact` one, by which answers are certified. One that is not a half-space under a surface says so by
    its `geometry`, on which the units of the answers depend.
    """

    @property
    def grid(self) -> AnyGrid:
        """The grid it works on."""
        ...

    @property
    def weights(self) -> float | Array:
        """Force of a unit pressure on each cell [m^2]: ``force = sum(weights * pressure)``."""
        ...

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa], both of the grid's shape."""
        ...

    def as_matrix(self, cells: npt.NDArray[np.intp] | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells` (flat indices; all cells without)."""
        ...

    def restrict(self, window: tuple[slice, ...]) -> Operator:
        """Return the map between the cells of `window`, with no pressure outside."""
        ...


def exact_of(operator: Operator) -> Operator:
    """Return the operator that certifies: the same body without the error of its sum."""
    exact: Operator | None = getattr(operator, "exact", None)
    return operator if exact is None else exact


def is_positive(operator: Operator) -> bool:
    """Whether no pressure lifts any cell, so that contact lies where the bodies overlap; no, unless it says so."""
    return bool(getattr(operator, "positive", False))


def geometry_of(operator: Operator) -> Geometry:
    """Return what the operator's cells are: what it says, else what its grid suggests."""
    stated = getattr(operator, "geometry", None)
    return stated if isinstance(stated, Geometry) else Geometry.of(operator.grid)


def is_semidefinite(operator: Operator) -> bool:
    """Whether a constant pressure on all cells moves nothing: the whole of a periodic body, never a part.

    An operator may say so; else its grid does.
    """
    return bool(getattr(operator, "semidefinite", all(operator.grid.periodic)))


def keeps_precision(operator: Operator) -> bool:
    """Whether products with fields in single precision are in single precision; no, unless the operator says so."""
    return bool(getattr(operator, "keeps_precision", False))


def self_influence(operator: Operator) -> float:
    """Return the displacement of the first cell per unit pressure on itself [m/Pa]."""
    try:
        return _known[operator]
    except (KeyError, TypeError, ValueError):  # not asked yet, or nothing to remember it by
        own = float(operator.as_matrix(np.zeros(1, np.intp))[0, 0])
    with suppress(TypeError, ValueError):
        _known[operator] = own
    return own


def self_influences(operator: Operator) -> float | Array:
    """Return the displacement of each cell per unit pressure on itself [m/Pa]: one number where all are equal."""
    diagonal: Array | None = getattr(operator, "diagonal", None)
    return self_influence(operator) if diagonal is None else diagonal


@runtime_checkable
class Coarsenable(Protocol):
    """An operator that can state itself on coarser cells."""

    def coarsened(self, grid: Grid) -> Operator | None:
        """Return the same body on `grid`, whose cells are larger; None where it cannot be stated there."""
        ...


@runtime_checkable
class Listable(Protocol):
    """An operator that can state itself between a list of its cells, at a cost that follows the list."""

    def between(self, cells: npt.NDArray[np.intp]) -> Operator:
        """Return the map between `cells` (flat indices, none twice), with no pressure elsewhere; fields are lists."""
        ...


@runtime_checkable
class Invertible(Protocol):
    """An operator that knows roughly what pressure a displacement takes: a preconditioner."""

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a pressure [Pa] that would cause about this `displacement` [m]; symmetric and definite."""
        ...
