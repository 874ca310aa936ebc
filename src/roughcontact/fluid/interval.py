"""Bounds of the flow through a gap that is constant in each cell, beyond the harmonic finite volumes.

The face flows of a network are a Raviart-Thomas field, whose exact dissipation in a cell is less than that of the
network: a better lower bound. Potentials that are bilinear in each cell give an upper bound.
"""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import splu

from roughcontact.fluid.network import Network
from roughcontact.grid import Grid
from roughcontact.validation import Array

__all__ = ["bilinear_bound", "flux_bound"]


def flux_bound(network: Network, flow: Array, conductance: Array, grid: Grid) -> Array:
    """Return the lower bound of the tensor of unit drives by the Raviart-Thomas field of face flows, shape (d, d).

    Parameters
    ----------
    network : Network
    flow : array, shape (d, f)
        Without sources.
    conductance : array, shape of the grid
        Of the cells, as for the network.
    grid : Grid
    """
    inside = conductance.ravel()[np.flatnonzero(network.cells >= 0)]
    total = np.zeros((len(flow), len(flow)))
    for axis in (0, 1):
        wide = grid.spacing[1 - axis] / grid.spacing[axis]
        of_axis = network.axis == axis
        out, into = (
            np.stack([np.bincount(end[of_axis], each[of_axis], network.count) for each in flow])[
                :, : len(inside)
            ]
            for end in (network.first, network.second)
        )
        each = 1 / (3 * inside * wide)
        mixed = (out * each) @ into.T
        total += (out * each) @ out.T + (into * each) @ into.T + 0.5 * (mixed + mixed.T)
    driven = network.driven(flow)
    return driven.T @ np.linalg.pinv(total, hermitian=True) @ driven


def bilinear_bound(conductance: Array, grid: Grid, along: int | None) -> Array:
    """Return the upper bound by bilinear potentials: the tensor on a period, or the flow of a unit drop along an axis.

    Parameters
    ----------
    conductance : array, shape (n, m)
        Of the cells, zero for closed ones.
    grid : Grid
    along : int or None
        Axis from side to side of a free map; None for a map that is periodic along both axes.
    """
    counts = [n if p else n + 1 for n, p in zip(grid.shape, grid.periodic, strict=True)]
    i, j = np.nonzero(conductance)
    m = conductance[i, j]
    corner = [
        ((i + a) % counts[0]) * counts[1] + (j + b) % counts[1] for a, b in ((0, 0), (0, 1), (1, 0), (1, 1))
    ]
    used, number = np.unique(np.stack(corner), return_inverse=True)
    corners = number.reshape(4, -1)
    element = _element(grid)
    entries = (element[:, :, None] * m).reshape(16, -1)
    rows, columns = np.repeat(corners, 4, axis=0), np.tile(corners, (4, 1))
    size = len(used)
    matrix = sparse.coo_array((entries.ravel(), (rows.ravel(), columns.ravel())), (size, size)).tocsr()
    if along is None:
        # At the corners of a cell, the potential of a unit gradient along an axis counts from its own first corner.
        places = np.array([[0, 0, 1, 1], [0, 1, 0, 1]]) * np.array(grid.spacing)[:, None]
        known = np.zeros((2, size))
        pull = np.einsum("ab,db->da", element, places)
        loads = np.stack(
            [sum(np.bincount(corners[a], pull[d, a] * m, size) for a in range(4)) for d in (0, 1)]
        )
        own = np.einsum("da,ab,eb->de", places, element, places) * m.sum()
        _, labels = connected_components(matrix, directed=False)
        fixed = np.unique(labels, return_index=True)[1]
    else:
        place = used // counts[1] if along == 0 else used % counts[1]
        known = np.where(place == 0, 1.0, 0.0)[None]
        ends = (place == 0) | (place == counts[along] - 1)
        loads, own = np.zeros((1, size)), np.zeros((1, 1))
        _, labels = connected_components(matrix, directed=False)
        reached = np.zeros(labels.max() + 1, bool)
        reached[labels[ends]] = True
        lonely = np.unique(labels, return_index=True)[1][~reached]
        fixed = np.concatenate([np.flatnonzero(ends), lonely])
    free = np.ones(size, bool)
    free[fixed] = False
    potential = known.copy()
    right = -(loads + (matrix @ potential.T).T)[:, free]
    factors = splu(matrix[free][:, free].tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    potential[:, free] += factors.solve(np.ascontiguousarray(right.T)).T
    crossed = loads @ potential.T
    bound: Array = potential @ (matrix @ potential.T) + crossed + crossed.T + own
    return bound


def _element(grid: Grid) -> Array:
    """Return the matrix of a bilinear cell of unit conductance; corners in the order 00, 01, 10, 11."""
    slope, mass = np.array([[1.0, -1.0], [-1.0, 1.0]]), np.array([[2.0, 1.0], [1.0, 2.0]]) / 6
    wide = grid.spacing[1] / grid.spacing[0]
    return np.kron(slope, mass) * wide + np.kron(mass, slope) / wide
