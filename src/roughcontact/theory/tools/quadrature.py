"""Quadrature rules on (0, 1), and panels that shrink geometrically towards a singular end."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from numpy.polynomial.legendre import leggauss, legint, legvander

from roughcontact.validation import Array

__all__ = ["double_exponential", "gauss", "graded", "running"]

REACH = 3.4  # of the transformed variable: beyond, the weights are below 1e-16
STEP = 1 / 16


@cache
def double_exponential() -> tuple[Array, Array]:
    """Return nodes and weights of the double exponential rule on (0, 1).

    The nodes are dense at both ends, those near 0 with full relative precision: square roots and powers there cost no
    accuracy (Takahasi & Mori, Publ. RIMS 9, 721 (1974)).

    Returns
    -------
    nodes, weights : array, shape (n,)
    """
    u = STEP * np.arange(-round(REACH / STEP), round(REACH / STEP) + 1)
    stretched = np.pi * np.sinh(u)
    nodes = 1 / (1 + np.exp(-stretched))
    weights = STEP * np.pi * np.cosh(u) * nodes / (1 + np.exp(stretched))
    for table in (nodes, weights):
        table.flags.writeable = False
    return nodes, weights


@cache
def gauss(order: int) -> tuple[Array, Array]:
    """Return the nodes and weights of the Gauss-Legendre rule on (0, 1), each of shape (order,)."""
    x, weights = leggauss(order)
    return (x + 1) / 2, weights / 2


def graded(first: float, last: float, ratio: float) -> Array:
    """Return the edges 0, `first`, ..., `last` of panels that grow by at most `ratio`."""
    steps = max(1, math.ceil(math.log(last / first) / math.log(ratio)))
    return np.concatenate([[0.0], np.geomspace(first, last, steps + 1)])


def running(nodes: Array) -> Array:
    """Return the matrix that integrates a function, given at the nodes on 0 to 1, from 0 to each node."""
    t, n = 2 * nodes - 1, nodes.size
    integrals = legvander(t, n) @ legint(np.eye(n), lbnd=-1) / 2
    return np.asarray(integrals @ np.linalg.inv(legvander(t, n - 1)))
