"""Least-squares polynomials through the measured heights of a map or a line."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

import numpy as np

from roughcontact.slabs.slab_array import SlabArray
from roughcontact.validation import Array

__all__ = ["polynomial_trend"]


# Passes over the residual of the previous fit, which compensate for the squared condition number of the normal
# equations.
_PASSES = 3
_SLAB = 2**20  # points that are summed at once


def polynomial_trend(heights: Array, degree: int) -> Array:
    """Return the least-squares polynomial of total degree `degree` through the measured heights [m].

    Parameters
    ----------
    heights : array, shape (ny, nx) or (n,)
        NaN where nothing was measured.
    degree : int
        0 is the mean, 1 the plane, 2 the quadratic surface.

    Returns
    -------
    array, shape of `heights`
        The polynomial everywhere, at missing points too.

    Notes
    -----
    The basis is products of Legendre polynomials over centred coordinates from -1 to 1: nearly orthogonal at any
    size and unit. Its products separate into factors of y and of x, so the sums over all points are two matrix
    products. No matrix of points times terms is built: in addition to the result, memory for a few rows is needed.
    """
    field: Any = heights
    if isinstance(field, SlabArray):
        mine = slice(*field.edges[field.functions.rank :][:2])
        of_all = field.functions.communicator.allgather
        trend: Any = _trend(field.local, field.shape, mine, degree, lambda sums: sum(of_all(sums)))
        return field.like(trend)  # type: ignore[return-value]
    return _trend(heights, heights.shape, slice(None), degree, lambda sums: sums)


def _trend(
    heights: Array, shape: tuple[int, ...], part: slice, degree: int, total: Callable[[Array], Array]
) -> Array:
    """Return the polynomial at the rows `part` of a map; `total` adds the sums over the rows of all processes."""
    factors = [_legendre(n, degree) for n in shape]
    factors[0] = factors[0][part]
    # A term is selected by its degree along each axis.
    terms = [term for term in product(range(degree + 1), repeat=heights.ndim) if sum(term) <= degree]
    pairs = total(
        np.sum(
            [
                _contract((~np.isnan(heights[rows])).astype(np.float64), [_pairs(factor) for factor in here])
                for rows, here in _slabs(heights, factors)
            ],
            axis=0,
        )
    )
    gram = np.zeros((len(terms), len(terms)))
    for i, one in enumerate(terms):
        for j, other in enumerate(terms):
            gram[i, j] = pairs[tuple(a * (degree + 1) + b for a, b in zip(one, other, strict=True))]
    coefficients = np.zeros((degree + 1,) * heights.ndim)
    for _ in range(_PASSES):
        moments = total(
            np.sum(
                [
                    _contract(np.nan_to_num(heights[rows] - _evaluate(coefficients, here)), here)
                    for rows, here in _slabs(heights, factors)
                ],
                axis=0,
            )
        )
        right = np.array([moments[term] for term in terms])
        for term, value in zip(terms, np.linalg.lstsq(gram, right, rcond=None)[0].tolist(), strict=True):
            coefficients[term] += value
    return _evaluate(coefficients, factors)


def _slabs(heights: Array, factors: list[Array]) -> Iterator[tuple[slice, list[Array]]]:
    """Yield slabs of rows of `heights`, small enough that temporary arrays take almost no memory."""
    step = max(1, _SLAB * len(heights) // max(1, heights.size))
    for start in range(0, max(1, len(heights)), step):  # without rows the sums are zero
        rows = slice(start, start + step)
        yield rows, [factors[0][rows], *factors[1:]]


def _legendre(count: int, degree: int) -> Array:
    """Return the Legendre polynomials at the centred places of `count` cells, shape (count, degree + 1)."""
    places = np.linspace(-1, 1, count) if count > 1 else np.zeros(1)
    return np.asarray(np.polynomial.legendre.legvander(places, degree), dtype=np.float64)


def _pairs(factor: Array) -> Array:
    """Return all products of two columns, shape (count, (degree + 1)^2)."""
    return (factor[:, :, None] * factor[:, None, :]).reshape(len(factor), factor.shape[1] ** 2)


def _contract(values: Array, factors: list[Array]) -> Array:
    """Return the sum over all points of values times one factor an axis, for every choice of columns."""
    if values.ndim == 1:
        return np.asarray(values @ factors[0], dtype=np.float64)
    return np.asarray(factors[0].T @ values @ factors[1], dtype=np.float64)


def _evaluate(coefficients: Array, factors: list[Array]) -> Array:
    """Return the sum of all terms at every point."""
    return _contract(coefficients, [factor.T for factor in factors])
