"""Contact spots: cells in contact that share an edge."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.grid import AnyGrid
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.subdomain import bounding_box
from roughcontact.validation import Array

__all__ = ["Spots", "count_spots", "find_spots"]


@dataclass(frozen=True, slots=True, eq=False)
class Spots:
    """The connected parts of a contact.

    Attributes
    ----------
    count : int
    areas : array, shape (count,)
        Area of each spot [m^2].
    loads : array, shape (count,)
        Force that each spot carries [N].
    labels : int array, shape of the grid
        0 outside contact, else 1 to `count`.
    """

    count: int
    areas: Array
    loads: Array
    labels: npt.NDArray[np.intp]


def count_spots(contact: npt.NDArray[np.bool_], grid: AnyGrid) -> int:
    """Return the number of spots of a contact, without leaving the device that it lives on.

    Every cell takes the largest number among its own and its neighbours' in contact, until nothing changes: a spot is
    then known by the one cell that kept its own. It takes as many passes as the longest way through a spot has cells.
    """
    xp, shape = namespace(contact), tuple(contact.shape)
    own = xp.reshape(xp.arange(1, math.prod(shape) + 1, device=contact.device), shape)
    labels = xp.where(contact, own, 0)
    while True:
        spread = labels
        for axis, periodic in enumerate(grid.periodic):
            for step in (1, -1):
                moved = xp.roll(spread, step, axis=axis)
                if not periodic:  # what came round the edge is no neighbour
                    places = xp.arange(shape[axis], device=contact.device)
                    edge = places == (0 if step == 1 else shape[axis] - 1)
                    along = tuple(-1 if a == axis else 1 for a in range(len(shape)))
                    moved = xp.where(xp.reshape(edge, along), 0, moved)
                spread = xp.where(contact & (moved > spread), moved, spread)
        if bool(xp.all(spread == labels)):
            return int(xp.count_nonzero(contact & (labels == own)))
        labels = spread


def find_spots(contact: npt.NDArray[np.bool_], pressure: Array, grid: AnyGrid, measure: Measure) -> Spots:
    """Return the spots of a contact; along a periodic axis they go on across the edge."""
    import scipy.ndimage

    labels = np.zeros(contact.shape, np.intp)
    box = bounding_box(contact)
    count = 0 if box is None else scipy.ndimage.label(contact[box], output=labels[box])
    pairs = []
    for axis, periodic in enumerate(grid.periodic):
        if periodic:
            first, last = np.take(labels, 0, axis=axis), np.take(labels, -1, axis=axis)
            both = (first > 0) & (last > 0)
            pairs.append(np.stack([first[both], last[both]]))
    if count and pairs:
        import scipy.sparse.csgraph

        rows, columns = np.concatenate(pairs, axis=1)
        links = scipy.sparse.coo_array((np.ones(len(rows)), (rows, columns)), shape=(count + 1, count + 1))
        _, merged = scipy.sparse.csgraph.connected_components(links, directed=False)
        # Label 0, the ground, is in no pair and keeps its own component; the others are numbered anew.
        _, compact = np.unique(np.r_[-1, merged[1:]], return_inverse=True)
        labels, count = compact[labels], int(compact.max())
    cells = np.flatnonzero(contact)
    spot = labels.ravel()[cells] - 1
    weights = measure.on(cells)
    areas = np.bincount(spot, weights=weights, minlength=count).astype(np.float64)
    loads = np.bincount(spot, weights=weights * pressure.ravel()[cells], minlength=count).astype(np.float64)
    return Spots(int(count), areas, loads, labels)
