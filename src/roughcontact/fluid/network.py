"""Open cells as the nodes of a network: Reynolds' equation by finite volumes.

The conductance of a face is the harmonic mean of the conductances of its cells times width over distance. It is exact
for cells in series, gives a lower bound of the flow of a gap that is constant in each cell, and is continuous as a cell
closes; means of the gap or of its cube are neither.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from roughcontact.fluid.winding import windings
from roughcontact.grid import AnyGrid, Grid, RadialGrid
from roughcontact.validation import Array, Mask

__all__ = [
    "Faces",
    "Indices",
    "Network",
    "faces_of",
    "flow_network",
    "joined_network",
    "ring_network",
    "winding_network",
]

Indices: TypeAlias = npt.NDArray[np.integer[Any]]


@dataclass(frozen=True, slots=True, eq=False)
class Faces:
    """Faces between open cells, by axis; each leads from a cell to the next along its axis.

    Attributes
    ----------
    first, second : int array, shape (f,)
        Flat indices of the cells.
    conductance : array, shape (f,)
        Flow per drop, in units of the cells' conductances.
    axis : int array, shape (f,)
    wraps : bool array, shape (f,)
        Whether the face crosses the border of a periodic axis.
    """

    first: Indices
    second: Indices
    conductance: Array
    axis: npt.NDArray[np.int8]
    wraps: Mask

    def taken(self, chosen: Mask) -> Faces:
        """Return some of the faces."""
        return Faces(
            self.first[chosen],
            self.second[chosen],
            self.conductance[chosen],
            self.axis[chosen],
            self.wraps[chosen],
        )


@dataclass(frozen=True, slots=True, eq=False)
class Network:
    """Nodes that carry flow, numbered from 0, and the faces between them.

    Attributes
    ----------
    cells : int array, shape (n,)
        Node of each cell of the grid, flattened; -1 for a cell without flow.
    count : int
        Number of nodes.
    first, second : int array, shape (f,)
        Nodes of each face.
    conductance : array, shape (f,)
    drive : array, shape (d, f)
        Drop from the first to the second node without a difference of potentials, at a unit mean gradient [m].
    fixed : int array
        Nodes of fixed potential: the two reservoirs, or one of each component.
    potential : array
        Their potentials.
    axis : int array, shape (f,)
        Axis of each face.
    """

    cells: Indices
    count: int
    first: Indices
    second: Indices
    conductance: Array
    drive: Array
    fixed: Indices
    potential: Array
    axis: npt.NDArray[np.int8]

    def drops(self, potential: Array) -> Array:
        """Return the drop along each face, shape (d, f), of potentials of shape (d, n)."""
        return potential[:, self.second] - potential[:, self.first] + self.drive

    def surplus(self, flows: Array) -> Array:
        """Return what flows into each node less what flows out, shape (d, n)."""
        into = [
            np.bincount(self.second, each, self.count) - np.bincount(self.first, each, self.count)
            for each in flows
        ]
        return np.stack(into)

    def driven(self, flow: Array) -> Array:
        """Return the mean flux times the area, or the flow from the first reservoir, of flows of shape (d, f)."""
        if self.drive.any():
            return -flow @ self.drive.T
        total: Array = flow[:, self.first == self.fixed[0]].sum(axis=1)[:, None]
        return total

    def matrix(self) -> sparse.csc_array:
        """Return the symmetric matrix from potentials to what flows out of each node."""
        a, b, t = self.first, self.second, self.conductance
        rows, columns = np.concatenate([a, b, a, b]), np.concatenate([b, a, a, b])
        entries = np.concatenate([-t, -t, t, t])
        return sparse.coo_array((entries, (rows, columns)), (self.count, self.count)).tocsc()


def faces_of(conductance: Array, grid: Grid) -> Faces:
    """Return the faces between open cells.

    Parameters
    ----------
    conductance : array, shape (n, m)
        Of each cell, zero for a closed one.
    grid : Grid
    """
    index = np.arange(grid.size).reshape(grid.shape)
    parts = []
    for axis in (0, 1):
        last = grid.shape[axis] - (0 if grid.periodic[axis] else 1)
        of, next_to = np.arange(last), (np.arange(last) + 1) % grid.shape[axis]
        here, there = conductance.take(of, axis), conductance.take(next_to, axis)
        is_open = (here > 0) & (there > 0)
        here, there = here[is_open], there[is_open]
        wide = grid.spacing[1 - axis] / grid.spacing[axis]
        first, second = index.take(of, axis)[is_open], index.take(next_to, axis)[is_open]
        along = first % grid.shape[1] if axis else first // grid.shape[1]
        wraps = along == grid.shape[axis] - 1
        mean = 2 * here * (there / (here + there))
        parts.append((first, second, mean * wide, np.full(len(first), axis, np.int8), wraps))
    return Faces(*(np.concatenate(each) for each in zip(*parts, strict=True)))


def flow_network(
    conductance: Array, grid: AnyGrid, axis: int | None, between: tuple[Mask, Mask] | None
) -> tuple[Network | None, Indices]:
    """Return the network of a flow, None if no open path leads through it, and the winding vectors on a period.

    Parameters
    ----------
    conductance : array, shape of the grid
        Of each cell, zero for a closed one.
    grid : Grid or RadialGrid
    axis : int or None
        Axis from side to side.
    between : tuple of two bool arrays, optional
        Regions in place of the sides.
    """
    nowhere = np.zeros((0, 2), np.intp)
    if isinstance(grid, RadialGrid):
        return ring_network(conductance, grid), nowhere
    faces = faces_of(conductance, grid)
    if between is not None:
        # The pressure is given in the cells of both regions: they join the reservoirs without resistance.
        flat = conductance.ravel()
        best = 1e6 * float(flat.max()) if flat.size else 1.0
        ends = [np.flatnonzero(each.ravel() & (flat > 0)) for each in between]
        inlet, outlet = ((each, np.full(len(each), best)) for each in ends)
        return joined_network(faces, grid, 0, inlet, outlet), nowhere
    if axis is None:
        return winding_network(faces, grid)
    index = np.arange(grid.size).reshape(grid.shape)
    wide = grid.spacing[1 - axis] / grid.spacing[axis]
    sides = []
    for at in (0, -1):
        cells = np.take(index, at, axis)
        of = conductance.ravel()[cells]
        sides.append((cells[of > 0], 2 * of[of > 0] * wide))
    return joined_network(faces, grid, axis, sides[0], sides[1]), nowhere


def winding_network(faces: Faces, grid: Grid) -> tuple[Network | None, Indices]:
    """Return the network of the components that percolate over a periodic map, and their winding vectors.

    The drives are those of unit mean gradients along both axes. Without such a component there is no network.
    """
    inside = faces.taken(~faces.wraps)
    joined = sparse.coo_array((np.ones(len(inside.first)), (inside.first, inside.second)), (grid.size,) * 2)
    _, labels = connected_components(joined, directed=False)
    across = faces.taken(faces.wraps)
    component, vectors = windings(labels, across.first, across.second, across.axis)
    if not vectors:
        return None, np.zeros((0, 2), np.intp)
    whole = component[labels]
    flows = np.isin(whole, list(vectors))
    roots = np.array([np.flatnonzero(whole == each)[0] for each in vectors])
    drive = np.stack([np.where(faces.axis == axis, grid.spacing[axis], 0.0) for axis in (0, 1)])
    network = _numbered(faces, flows, drive, roots, np.zeros(len(roots)), 0)
    every = np.concatenate(list(vectors.values()))
    return network, every


def joined_network(
    faces: Faces, grid: AnyGrid, axis: int, inlet: tuple[Indices, Array], outlet: tuple[Indices, Array]
) -> Network | None:
    """Return the network between two reservoirs at the potentials 1 and 0; None if no open path joins them.

    Parameters
    ----------
    faces : Faces
    grid : Grid or RadialGrid
    axis : int
        Axis of the faces to the reservoirs.
    inlet, outlet : tuple of int array and array
        Flat indices of the open cells beside the reservoir, and the conductance to each.
    """
    size = grid.size
    first = np.concatenate([faces.first, np.full(len(inlet[0]), size), outlet[0]])
    second = np.concatenate([faces.second, inlet[0], np.full(len(outlet[0]), size + 1)])
    conductance = np.concatenate([faces.conductance, inlet[1], outlet[1]])
    more = len(first) - len(faces.first)
    axes = np.append(faces.axis, np.full(more, axis, np.int8))
    every = Faces(first, second, conductance, axes, np.zeros(len(first), bool))
    joined = sparse.coo_array((np.ones(len(first)), (first, second)), (size + 2,) * 2)
    _, labels = connected_components(joined, directed=False)
    if labels[size] != labels[size + 1]:
        return None
    flows = labels == labels[size]
    return _numbered(
        every, flows, np.zeros((1, len(first))), np.array([size, size + 1]), np.array([1.0, 0.0]), 2
    )


def ring_network(conductance: Array, grid: RadialGrid) -> Network | None:
    """Return the network of rings in series, from the inner to the outer rim; None if one is closed.

    A flow of 1 per angle of 1 rad and conductance loses the logarithm of the ratio of both radii of a ring: this is
    exact for rings of constant gap.
    """
    if not np.all(conductance > 0):
        return None
    before = np.log(grid.radii / grid.edges[:-1]) / conductance
    behind = np.log(grid.edges[1:] / grid.radii) / conductance
    last = grid.size - 1
    node = np.arange(last)
    faces = Faces(
        node, node + 1, 1 / (behind[:-1] + before[1:]), np.zeros(last, np.int8), np.zeros(last, bool)
    )
    rims = (np.array([0]), 1 / before[:1]), (np.array([last]), 1 / behind[-1:])
    return joined_network(faces, grid, 0, *rims)


def _numbered(
    faces: Faces, flows: Mask, drive: Array, fixed: Indices, potential: Array, reservoirs: int
) -> Network:
    """Return the network of the nodes that carry flow."""
    number = np.where(flows, np.cumsum(flows) - 1, -1)
    kept = flows[faces.first]
    return Network(
        number[: len(number) - reservoirs],
        int(np.count_nonzero(flows)),
        number[faces.first[kept]],
        number[faces.second[kept]],
        faces.conductance[kept],
        drive[:, kept],
        number[fixed],
        potential,
        faces.axis[kept],
    )
