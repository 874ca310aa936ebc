"""The flow of a network, between bounds: a potential gives the upper one, a flow without sources the lower one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import breadth_first_order, minimum_spanning_tree
from scipy.sparse.linalg import splu, spsolve_triangular

from roughcontact.fluid.network import Indices, Network
from roughcontact.validation import Array

__all__ = ["NetworkFlow", "solve"]

REFINEMENTS = 5  # of a factorisation in double precision the first or second suffices


@dataclass(frozen=True, slots=True, eq=False)
class NetworkFlow:
    """Potentials and flows of a network, with bounds of its conductance.

    Attributes
    ----------
    potential : array, shape (d, n)
        Of each node, for each drive.
    flow : array, shape (d, f)
        Along each face, without a source in any node.
    upper, lower : array, shape (d, d)
        Bounds of the dissipation of unit drives, in the sense of quadratic forms.
    """

    potential: Array
    flow: Array
    upper: Array
    lower: Array

    @property
    def gap(self) -> float:
        """Largest difference of the bounds relative to the largest upper one."""
        return float(np.linalg.norm(self.upper - self.lower, 2) / np.linalg.norm(self.upper, 2))


def solve(network: Network, tolerance: float) -> NetworkFlow:
    """Return the flow of a network whose bounds differ by no more than the tolerance, relative to the upper one.

    The bounds follow from Dirichlet's and Thomson's principles: any potential dissipates at least as much as the
    solution, any flow without sources at least as much per squared mean flow. The flow is that of the potential, made
    free of sources along a spanning tree of the best conducting faces. Both errors are quadratic in the residual.
    A residual proves nothing: close to the percolation threshold conductances differ by 1e12.
    """
    free = np.ones(network.count, bool)
    free[network.fixed] = False
    matrix = network.matrix()[free][:, free].tocsc()
    # Symmetric and definite: no pivots, and an ordering for symmetric matrices.
    factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    repair = _Repair(network)
    potential = np.zeros((len(network.drive), network.count))
    potential[:, network.fixed] = network.potential
    best: NetworkFlow | None = None
    for _ in range(REFINEMENTS):
        surplus = network.surplus(network.conductance * -network.drops(potential))
        potential[:, free] += factors.solve(np.ascontiguousarray(surplus[:, free].T)).T
        found = _between_bounds(network, potential, repair)
        if best is None or found.gap < best.gap:
            best = found
        if best.gap <= tolerance:
            break
    assert best is not None
    return best


def _between_bounds(network: Network, potential: Array, repair: _Repair) -> NetworkFlow:
    """Return the bounds that a potential gives."""
    t, drops = network.conductance, network.drops(potential)
    upper = (drops * t) @ drops.T
    flow = repair(-t * drops)
    dissipated = (flow / t) @ flow.T
    driven = network.driven(flow)
    lower = driven.T @ np.linalg.pinv(dissipated, hermitian=True) @ driven
    return NetworkFlow(potential.copy(), flow, upper, lower)


class _Repair:
    """Makes flows free of sources: each node of a spanning tree passes its surplus on to its parent."""

    def __init__(self, network: Network) -> None:
        self.network = network
        n, a, b = network.count, network.first, network.second
        # A virtual root joins the nodes of fixed potential, which may take any surplus.
        first, second = np.append(a, np.full(len(network.fixed), n)), np.append(b, network.fixed)
        resistance = np.append(
            1 / network.conductance, np.full(len(network.fixed), 0.5 / network.conductance.max())
        )
        graph = sparse.coo_array((resistance, (first, second)), (n + 1, n + 1)).tocsr()
        tree = minimum_spanning_tree(graph)
        order, parent = breadth_first_order(tree, n, directed=False)
        self.order, place = order[1:], np.empty(n + 1, np.intp)
        place[order] = np.arange(-1, n)
        inner = parent[self.order] < n
        rows, columns = place[parent[self.order[inner]]], np.flatnonzero(inner)
        ones = sparse.eye_array(n, format="csr")
        self.sums = (ones - sparse.coo_array((np.ones(len(rows)), (rows, columns)), (n, n))).tocsr()
        self.to_parent = _faces_to(parent[self.order], self.order, network)

    def __call__(self, flow: Array) -> Array:
        """Return flows of shape (d, f) without sources."""
        network, repaired = self.network, flow.copy()
        surplus = network.surplus(flow)[:, self.order]
        passed = spsolve_triangular(self.sums, surplus.T, lower=False, unit_diagonal=True).T
        face, sign = self.to_parent
        inner = face >= 0
        repaired[:, face[inner]] += sign[inner] * passed[:, inner]
        return repaired


def _faces_to(parents: Indices, nodes: Indices, network: Network) -> tuple[Indices, Array]:
    """Return the face between each node and its parent, -1 without one, and its sign from the node to the parent."""
    n = network.count
    low, high = np.minimum(network.first, network.second), np.maximum(network.first, network.second)
    keys = low * (n + 1) + high
    order = np.lexsort((-network.conductance, keys))  # of two faces between the same nodes the better one
    wanted = np.minimum(nodes, parents) * (n + 1) + np.maximum(nodes, parents)
    at = np.searchsorted(keys[order], wanted)
    at = np.minimum(at, len(order) - 1)
    face = np.where(keys[order][at] == wanted, order[at], -1)
    sign = np.where(network.first[face] == nodes, 1.0, -1.0)
    return face, sign
