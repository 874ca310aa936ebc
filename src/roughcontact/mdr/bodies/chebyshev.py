"""Piecewise polynomials in Chebyshev form: smooth functions as tables that can be differentiated and integrated."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
import numpy.typing as npt
from numpy.polynomial import chebyshev

from roughcontact.errors import InputError, about
from roughcontact.validation import Array

__all__ = ["Panels", "fit", "interpolate"]

Function = Callable[[Array], Array]

NODES = 20  # of a panel: a power of r is accurate to 1e-15 on a panel as long as its distance from zero
FINEST = 2.0**-40  # shortest panel, relative to the whole range
MOST = 4000  # panels; a function that needs more is not piecewise smooth


@dataclass(frozen=True, slots=True, eq=False)
class Panels:
    """A function that is a polynomial between any two neighbouring edges.

    Parameters
    ----------
    edges : array, shape (m + 1,)
        Increasing.
    coefficients : array, shape (m, n)
        Chebyshev coefficients of each panel, mapped to [-1, 1].
    """

    edges: Array
    coefficients: Array

    def __call__(self, x: Array) -> Array:
        """Return the values at `x`; beyond the ends the last polynomials are continued."""
        x = np.asarray(x, dtype=np.float64)
        flat = x.ravel()
        return self.at(flat, self.panel(flat)).reshape(x.shape)

    def panel(self, x: Array) -> npt.NDArray[np.intp]:
        """Return the index of the panel that contains each position; an edge belongs to the panel on its right."""
        found = np.searchsorted(self.edges, x, side="right") - 1
        return np.clip(found, 0, len(self.coefficients) - 1)

    def at(self, x: Array, panel: npt.NDArray[np.intp]) -> Array:
        """Return the values at `x`, shape (p,) or (p, k), of the polynomials of the panels, shape (p,)."""
        shape = (len(panel),) + (1,) * (x.ndim - 1)
        left, right = self.edges[panel].reshape(shape), self.edges[panel + 1].reshape(shape)
        twice = 2 * (2 * x - left - right) / (right - left)
        own = self.coefficients[panel].T.reshape(self.coefficients.shape[1], *left.shape)
        # Clenshaw's recurrence
        last, before = np.zeros_like(x), np.zeros_like(x)
        for row in own[:0:-1]:
            last, before = row + twice * last - before, last
        return np.asarray(own[0] + twice / 2 * last - before)

    def derivative(self) -> Panels:
        """Return the derivative."""
        half = np.diff(self.edges) / 2
        return Panels(self.edges, chebyshev.chebder(self.coefficients, axis=1) / half[:, None])

    def primitive(self) -> Panels:
        """Return the integral from the first edge on."""
        half = np.diff(self.edges) / 2
        inner = chebyshev.chebint(self.coefficients, lbnd=-1, axis=1) * half[:, None]
        inner[1:, 0] += np.cumsum(inner.sum(axis=1))[:-1]
        return Panels(self.edges, inner)


@cache
def _basis(count: int) -> tuple[Array, Array]:
    """Return the Chebyshev extrema on [-1, 1] and the matrix from values there to coefficients."""
    nodes = chebyshev.chebpts2(count)
    return nodes, np.asarray(np.linalg.inv(chebyshev.chebvander(nodes, count - 1)), dtype=np.float64)


def interpolate(function: Function, edges: Array, count: int) -> Panels:
    """Return the panels that interpolate `function` at `count` nodes each, including both edges."""
    return Panels(edges, _each(function, np.stack([edges[:-1], edges[1:]], axis=1), count))


def fit(function: Function, end: float, *, tolerance: float) -> Panels:
    """Return a function on [0, end] as panels, halved until each is accurate.

    Panels shrink in proportion to their distance from zero, which keeps the relative precision of a power of r over
    twelve decades. They also shrink towards kinks, whose positions need not be known.

    Parameters
    ----------
    function : callable
        Function of an array of any length.
    end : float
    tolerance : float
        Last coefficients of a panel, relative to its largest value.

    Raises
    ------
    ValueError
        If the function is not finite, or not piecewise smooth to the tolerance.
    """
    starts = end * 2.0 ** np.arange(-40, 1)
    todo = np.concatenate([[0.0], starts])
    todo = np.stack([todo[:-1], todo[1:]], axis=1)
    done: list[tuple[Array, Array]] = []
    count, largest = 0, 0.0
    while len(todo):
        count += len(todo)
        if count > 2 * MOST:
            raise about(
                "the function",
                f"is not piecewise smooth to {tolerance:g}",
                "give samples of it instead (sampled)",
            )
        own = _each(function, todo, NODES)
        if not np.isfinite(own).all():
            where = todo[~np.isfinite(own).all(axis=1)][0]
            raise about("the function", f"is not finite between {where[0]:g} and {where[1]:g}")
        size = np.abs(own).sum(axis=1)
        largest = max(largest, float(size.max()))
        # Values below the rounding error of the largest value are noise of the function.
        allowed = np.maximum(tolerance * size, 4 * np.finfo(float).eps * largest)
        good = np.abs(own[:, -2:]).max(axis=1) <= allowed
        good |= todo[:, 1] - todo[:, 0] <= end * FINEST * (1 + 1e-9)
        done.append((todo[good], own[good]))
        middle = todo[~good].mean(axis=1)
        todo = np.concatenate(
            [np.stack([todo[~good, 0], middle], axis=1), np.stack([middle, todo[~good, 1]], axis=1)]
        )
    spans = np.concatenate([span for span, _ in done])
    order = np.argsort(spans[:, 0])
    return Panels(
        np.append(spans[order, 0], end), np.concatenate([coefficients for _, coefficients in done])[order]
    )


def _each(function: Function, spans: Array, count: int) -> Array:
    """Return the coefficients of the panels `spans`, shape (m, 2), which need not be neighbours."""
    nodes, matrix = _basis(count)
    left, right = spans[:, :1], spans[:, 1:]
    places = np.clip(left + (right - left) * (nodes + 1) / 2, left, right)
    values = np.asarray(function(places.ravel()), dtype=np.float64)
    if values.shape != (places.size,):
        raise InputError(
            f"a function of an array is needed: {places.size} radii gave a result of shape {values.shape}",
            place="function",
        )
    return np.asarray(values.reshape(places.shape) @ matrix.T)
