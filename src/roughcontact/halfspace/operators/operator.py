"""What every linear map from pressure to displacement can do."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Protocol, TypeVar, cast, runtime_checkable
from weakref import WeakKeyDictionary

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.grid import AnyGrid, Grid
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.sums.local_inverse import LocalInverse
from roughcontact.halfspace.sums.particle_mesh import ListParticleMesh, ParticleMesh
from roughcontact.validation import Array

__all__ = [
    "Capabilities",
    "Linear",
    "Operator",
    "capabilities",
    "exact_of",
    "geometry_of",
    "is_semidefinite",
    "self_influence",
    "self_influences",
]

AnyOperator = TypeVar("AnyOperator")
Cells = npt.NDArray[np.intp]
_known: WeakKeyDictionary[Operator, float] = WeakKeyDictionary()  # what several ask of one operator


class Linear(Protocol):
    """What conjugate gradients take: a linear map, symmetric under its weights."""

    @property
    def weights(self) -> float | Array:
        """Force of a unit pressure on each cell [m^2]."""

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""


@runtime_checkable
class Operator(Protocol):
    """A linear map from pressure [Pa] on the cells of a grid to displacement [m] of the same cells.

    Symmetric under its weights. On a free grid positive definite; on a periodic one semidefinite, since a
    constant pressure moves nothing.

    These five members are enough for any solve. What else an operator can do, it states by an attribute
    ``capabilities``, a `Capabilities`. `check_operator` tests both.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> body = rc.half_space(rc.Grid((8, 8), 1e-6), 1e9)
    >>> isinstance(body, rc.Operator), body.restrict((slice(0, 4), slice(0, 4))).grid.shape
    (True, (4, 4))
    >>> pressure = np.full((8, 8), 1e6)
    >>> bool(np.allclose(body.as_matrix() @ pressure.ravel(), body.apply(pressure).ravel()))
    True
    """

    @property
    def grid(self) -> AnyGrid:
        """The grid it works on."""

    @property
    def weights(self) -> float | Array:
        """Force of a unit pressure on each cell [m^2]: ``force = sum(weights * pressure)``."""

    def apply(self, pressure: Array) -> Array:
        """Return the displacement under a pressure.

        Parameters
        ----------
        pressure : array, shape ``grid.shape``
            [Pa]

        Returns
        -------
        array, shape ``grid.shape``
            [m]
        """

    def as_matrix(self, cells: npt.NDArray[np.intp] | None = None) -> Array:
        """Return the matrix between cells.

        Parameters
        ----------
        cells : array of int, shape (n,), optional
            Flat indices of cells; by default all.

        Returns
        -------
        array, shape (n, n)
            Displacement of each cell per unit pressure on each [m/Pa].
        """

    def restrict(self, window: tuple[slice, ...]) -> Operator:
        """Return the map between the cells of a window, with no pressure outside.

        Parameters
        ----------
        window : tuple of slice
            A box of cells, one slice of step 1 for each axis.

        Returns
        -------
        Operator
            On the window's grid.
        """


def _absent(*_: Any) -> None:
    """Return None: what an operator answers that does not have this."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Capabilities:
    """What an operator can do beyond the protocol; by default nothing.

    What is known is stated as a value. What is done, or takes work to make, is a function: an operator keeps what it
    has made, so that a function may be called as often as needed. Answers depend on `exact`, `geometry`,
    `modulus`, `positive` and `semidefinite`, which must be true; the others make solves faster.

    Parameters
    ----------
    exact : Operator, optional
        The same body without the error of its sum, by which answers are certified; without, its sum is exact.
    geometry : Geometry, optional
        What the cells are, on which the units of answers depend; without, what the grid suggests.
    modulus : float, optional
        Reduced modulus E* of the body [Pa], where it has one: another one is then refused.
    positive : bool
        Whether no pressure lifts any cell, so that contact lies where the bodies overlap.
    semidefinite : bool, optional
        Whether a constant pressure on all cells moves nothing; without, so it is on a grid that is periodic along all
        axes.
    listed : bool
        Whether its cells are a list of cells of a plane, so that those of a region are found by `submatrix`, not by
        a box.
    single_precision : bool
        Whether products with fields in single precision are in single precision.
    single_convolution : function, optional
        Product in single precision for the steps of a solve, where it may cost less than ``apply``.
    self_influences : function
        Without arguments; returns the displacement of each cell per unit pressure on itself [m/Pa] where cells differ.
    submatrix : function, optional
        Takes cells (flat indices, none twice) and returns the operator between them, whose fields are lists, at a
        cost that follows the list.
    coarsened : function
        Takes a grid of larger cells and returns the operator of the same body there; None where it has none.
    approximate_inverse : function, optional
        Takes a displacement [m] and returns a pressure [Pa] that would cause about this; symmetric and definite.
    local_inverse : function
        Without arguments; returns a sum over near cells that does about the same.
    particle_mesh : function
        Without arguments; returns what makes particle-mesh operators on the tiles of a region.

    Examples
    --------
    >>> import roughcontact as rc
    >>> body = rc.half_space(rc.Grid((8, 8), 1e-6), 1e9)
    >>> body.capabilities.modulus, body.capabilities.exact is None
    (1000000000.0, True)
    """

    exact: Operator | None = None
    geometry: Geometry | None = None
    modulus: float | None = None
    positive: bool = False
    semidefinite: bool | None = None
    listed: bool = False
    single_precision: bool = False
    single_convolution: Callable[[Array], Array] | None = None
    self_influences: Callable[[], Array | None] = _absent
    submatrix: Callable[[Cells], Operator] | None = None
    coarsened: Callable[[Grid], Operator | None] = _absent
    approximate_inverse: Callable[[Array], Array] | None = None
    local_inverse: Callable[[], LocalInverse | None] = _absent
    particle_mesh: Callable[[], ParticleMesh | ListParticleMesh | None] = _absent


def capabilities(operator: object) -> Capabilities:
    """Return what an operator states that it can do, nothing if it does not.

    Raises
    ------
    ValueError
        If its attribute ``capabilities`` is something else.
    """
    stated = getattr(operator, "capabilities", None)
    if not isinstance(stated, Capabilities | None):
        raise InputError(
            f"the attribute capabilities of an operator must be a roughcontact.Capabilities, not {stated!r}"
        )
    return Capabilities() if stated is None else stated


def exact_of(operator: AnyOperator) -> AnyOperator:
    """Return the operator that certifies: the same body without the error of its sum."""
    exact = capabilities(operator).exact
    return operator if exact is None else cast(AnyOperator, exact)


def geometry_of(operator: Operator) -> Geometry:
    """Return what the operator's cells are: what it states, otherwise what its grid suggests."""
    return capabilities(operator).geometry or Geometry.of(operator.grid)


def is_semidefinite(operator: Operator) -> bool:
    """Whether a constant pressure on all cells moves nothing: the whole of a periodic body, never a part."""
    stated = capabilities(operator).semidefinite
    return all(operator.grid.periodic) if stated is None else stated


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
    each = capabilities(operator).self_influences()
    return self_influence(operator) if each is None else each
