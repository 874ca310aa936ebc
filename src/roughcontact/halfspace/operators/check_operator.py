"""Whether an operator does what solves rely on: for operators that users write."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.halfspace.operators.operator import (
    Operator,
    capabilities,
    is_semidefinite,
    self_influences,
)
from roughcontact.validation import Array, RngLike, as_generator, require

__all__ = ["OperatorCheck", "check_operator"]

TESTED = 300  # cells of the matrix
ROUNDING = 64 * float(
    np.finfo(np.float64).eps
)  # times sqrt(n), as a random walk of n roundings; with a margin of 64
SINGLE = 64 * float(np.finfo(np.float32).eps)


@dataclass(frozen=True, slots=True)
class OperatorCheck:
    """A property of an operator that was tested.

    Attributes
    ----------
    name : str
        "symmetric under its weights"
    departure : float
        From the property, relative to the displacement.
    allowed : float
        Largest departure that rounding explains, with the error of its sum if the operator names an exact one.

    Examples
    --------
    >>> import roughcontact as rc
    >>> checks = rc.check_operator(rc.half_space(rc.Grid((8, 8), 1e-6), 1e9))
    >>> all(each.departure <= each.allowed for each in checks)
    True
    """

    name: str
    departure: float
    allowed: float


def check_operator(operator: Operator, *, rng: RngLike = 0) -> tuple[OperatorCheck, ...]:
    """Test whether an operator has the properties on which solves rely, and raise an error for the first it lacks.

    Random pressures on the whole grid test that it is linear, symmetric under its weights, and equal to its
    restriction. Its matrix between at most 300 cells tests that it is definite. These fields of its
    ``capabilities`` are tested too: exact, positive, semidefinite, self_influences, submatrix, approximate_inverse and
    single_convolution.

    Parameters
    ----------
    operator : Operator
        On a small grid of the kind that will be used, such as 16 x 24 cells.
    rng : int or Generator
        Source of pressures and cells.

    Returns
    -------
    tuple of OperatorCheck
        What was tested.

    Raises
    ------
    ValueError
        If a property is missing; the message states which and by how much.

    Examples
    --------
    >>> import roughcontact as rc
    >>> body = rc.half_space(rc.Grid((16, 24), 1e-6), 1e9)
    >>> [each.name for each in rc.check_operator(body)][:3]
    ['repeatable', 'linear', 'symmetric under its weights']
    """
    require(
        isinstance(operator, Operator),
        "an operator has grid, weights, apply, as_matrix and restrict",
        "add what is missing; see rc.Operator",
        place="operator",
    )
    found = []
    for check in _checks(operator, as_generator(rng)):
        if not check.departure <= check.allowed:
            raise InputError(
                f"the operator is not {check.name}: it departs by {check.departure:.2g} of the displacement, and "
                f"rounding explains {check.allowed:.2g}",
                "compare apply, as_matrix and restrict on a grid of a few cells",
                "operator",
            )
        found.append(check)
    return tuple(found)


def _checks(operator: Operator, rng: np.random.Generator) -> Iterator[OperatorCheck]:
    """Yield the checks, each computed when the ones before it have passed."""
    able = capabilities(operator)
    shape = operator.grid.shape
    weights = np.broadcast_to(operator.weights, shape)
    n = weights.size
    require(
        bool(np.isfinite(weights).all() and (weights > 0).all()),
        "the weights of an operator are positive areas",
        place="operator",
    )
    p, q = rng.standard_normal((2, *shape))
    kept = p.copy()
    moved = np.asarray(operator.apply(p))
    require(
        moved.shape == shape and bool(np.isfinite(moved).all()),
        f"apply must return finite displacements of the shape {shape}, not {moved.shape}",
        place="operator",
    )
    require(bool((p == kept).all()), "apply must not change the pressure that it is given", place="operator")
    tolerance = ROUNDING * math.sqrt(n)
    own = 0.0 if able.exact is None else _apart(moved, np.asarray(able.exact.apply(p)))
    allowed = tolerance + own
    yield OperatorCheck("repeatable", _apart(np.asarray(operator.apply(p)), moved), tolerance)
    other = np.asarray(operator.apply(q))
    combined = np.asarray(operator.apply(2 * p - 3 * q))
    yield OperatorCheck("linear", _apart(combined, 2 * moved - 3 * other), allowed)
    yield OperatorCheck("symmetric under its weights", _asymmetry(weights, p, q, moved, other), allowed)

    cells = np.sort(rng.choice(n, min(n, TESTED), replace=False))
    matrix = np.asarray(operator.as_matrix(cells))
    some = np.zeros(n)
    some[cells] = rng.standard_normal(cells.size)
    between = matrix @ some[cells]
    there = np.asarray(operator.apply(some.reshape(shape))).ravel()[cells]
    yield OperatorCheck("equal to its matrix", _apart(there, between), allowed)
    root = np.sqrt(weights.ravel()[cells])
    values = np.linalg.eigvalsh(root[:, None] * matrix / root)
    lowest, highest = float(values[0]), float(values[-1]) or 1.0
    yield OperatorCheck("semidefinite", max(-lowest / highest, 0.0), tolerance)
    if is_semidefinite(operator):
        constant = np.asarray(operator.apply(np.ones(shape)))
        yield OperatorCheck("at rest under a constant pressure", _size(constant) / _size(moved), allowed)
    else:
        require(
            lowest > tolerance * highest,
            f"the operator is not positive definite: its smallest eigenvalue is {lowest / highest:.2g} of the largest",
            "state semidefinite=True in its capabilities if a constant pressure moves nothing",
            place="operator",
        )
    if not able.listed:
        yield _restriction(operator, p, allowed)
    if able.positive:
        yield OperatorCheck("positive", -float(matrix.min()) / float(matrix.max()), own)
    yield from _stated(operator, rng, cells, matrix, allowed)


def _restriction(operator: Operator, p: Array, allowed: float) -> OperatorCheck:
    window = tuple(slice(n // 3, n) for n in p.shape)
    part = operator.restrict(window)
    require(
        part.grid.shape == p[window].shape,
        f"restrict must return an operator on the cells of the window, {p[window].shape}, not {part.grid.shape}",
        place="operator",
    )
    inside = np.zeros_like(p)
    inside[window] = p[window]
    whole = np.asarray(operator.apply(inside))[window]
    return OperatorCheck(
        "equal to its restriction", _apart(np.asarray(part.apply(p[window])), whole), allowed
    )


def _stated(
    operator: Operator, rng: np.random.Generator, cells: npt.NDArray[np.intp], matrix: Array, allowed: float
) -> Iterator[OperatorCheck]:
    """Yield the checks of the capabilities that an operator states."""
    able, shape = capabilities(operator), operator.grid.shape
    each = np.broadcast_to(self_influences(operator), shape).ravel()[cells]
    yield OperatorCheck("equal to its self-influences", _apart(each, np.diagonal(matrix)), allowed)
    if able.submatrix is not None:
        v = rng.standard_normal(cells.size)
        listed = np.asarray(able.submatrix(cells).apply(v))
        yield OperatorCheck("equal to its submatrix", _apart(listed, matrix @ v), allowed)
    u, v = rng.standard_normal((2, *shape))
    if able.approximate_inverse is not None:
        at, other = (np.asarray(able.approximate_inverse(each)) for each in (u, v))
        weights = np.broadcast_to(operator.weights, shape)
        # A mean that is taken off a constant keeps it symmetric; a sum in single precision is so to its rounding.
        yield OperatorCheck(
            "symmetric in its approximate inverse", _asymmetry(weights, u, v, at, other), SINGLE
        )
        least = min(float(np.vdot(weights * a, b)) for a, b in ((at, u), (other, v)))
        require(
            least > 0, "the approximate inverse of the operator is not positive definite", place="operator"
        )
    if able.single_convolution is not None:
        single = np.asarray(able.single_convolution(u.astype(np.float32)))
        difference = _apart(single.astype(np.float64), np.asarray(operator.apply(u)))
        yield OperatorCheck(
            "equal to its convolution in single precision", difference, SINGLE * math.sqrt(u.size)
        )


def _asymmetry(weights: Array, p: Array, q: Array, of_p: Array, of_q: Array) -> float:
    """Return how far ``<p, A q>`` is from ``<A p, q>``, over the product of the sizes."""
    there, back = float(np.vdot(weights * of_p, q)), float(np.vdot(weights * p, of_q))
    return abs(there - back) / (_size(weights * of_p) * _size(q) or 1.0)


def _apart(one: Array, other: Array) -> float:
    """Return the largest difference of two fields over the largest value."""
    return float(abs(one - other).max()) / (float(abs(other).max()) or 1.0)


def _size(field: Array) -> float:
    return float(np.linalg.norm(field.ravel()))
