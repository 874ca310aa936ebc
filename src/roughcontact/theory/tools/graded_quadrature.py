"""Gauss quadrature on panels that shrink geometrically towards a singular end."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from numpy.polynomial.legendre import leggauss, legint, legvander

__all__ = ["gauss", "graded", "running"]

Array = npt.NDArray[np.float64]


def graded(first: float, last: float, ratio: float) -> Array:
    """Return the edges 0, `first`, ..., `last` of panels that grow by `ratio` or a little less."""
    steps = max(1, math.ceil(math.log(last / first) / math.log(ratio)))
    return np.concatenate([[0.0], np.geomspace(first, last, steps + 1)])


def gauss(order: int) -> tuple[Array, Array]:
    """Return the nodes and weights of Gauss and Legendre on 0 to 1."""
    x, weights = leggauss(order)
    return (x + 1) / 2, weights / 2


def running(nodes: Array) -> Array:
    """Return the matrix that integrates what is known at the nodes on 0 to 1 from 0 to each of them."""
    t, n = 2 * nodes - 1, nodes.size
    integrals = legvander(t, n) @ legint(np.eye(n), lbnd=-1) / 2
    return np.asarray(integrals @ np.linalg.inv(legvander(t, n - 1)))
