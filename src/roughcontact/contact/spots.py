"""Contact spots: cells in contact that share an edge."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.errors import InputError
from roughcontact.grid import AnyGrid
from roughcontact.slabs.slab_array import SlabArray
from roughcontact.slabs.slabs import Slabs
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.subdomain import bounding_box
from roughcontact.validation import Array

__all__ = ["Spots", "are_labelled", "count_spots", "find_spots"]


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
        0 outside contact, 1 to `count` in it.
    """

    count: int
    areas: Array
    loads: Array
    labels: npt.NDArray[np.intp]


def count_spots(contact: npt.NDArray[np.bool_], grid: AnyGrid) -> int:
    """Return the number of spots of a contact, computed on the device of the mask.

    Each cell in contact takes the largest number among its own and those of its neighbours, until nothing changes: each
    spot then has exactly one cell with its original number. The number of passes is the number of cells along the
    longest path through a spot.
    """
    xp, shape = namespace(contact), tuple(contact.shape)
    own = xp.reshape(xp.arange(1, math.prod(shape) + 1, device=contact.device), shape)
    labels = xp.where(contact, own, 0)
    while True:
        spread = labels
        for axis, periodic in enumerate(grid.periodic):
            for step in (1, -1):
                moved = xp.roll(spread, step, axis=axis)
                if not periodic:  # cells across the edge are not neighbours
                    places = xp.arange(shape[axis], device=contact.device)
                    edge = places == (0 if step == 1 else shape[axis] - 1)
                    along = tuple(-1 if a == axis else 1 for a in range(len(shape)))
                    moved = xp.where(xp.reshape(edge, along), 0, moved)
                spread = xp.where(contact & (moved > spread), moved, spread)
        if bool(xp.all(spread == labels)):
            return int(xp.count_nonzero(contact & (labels == own)))
        labels = spread


def are_labelled(contact: Any) -> bool:
    """Whether `find_spots` supports the array of a contact."""
    return isinstance(contact, np.ndarray | SlabArray)


def find_spots(contact: Any, pressure: Any, grid: AnyGrid, measure: Measure) -> Spots:
    """Return the spots of a contact; along a periodic axis they continue across the edge.

    If the contact is in slabs (a plane that is periodic along both axes), each process labels its rows, and the labels
    are in slabs.

    Raises
    ------
    ValueError
        If the contact is on a device.
    """
    import scipy.ndimage

    if not are_labelled(contact):
        raise InputError("spots are labelled on the host", "use solution.on_host().spots")
    alone = isinstance(contact, np.ndarray)
    whole = SlabArray(contact, (0, len(contact)), Slabs().functions) if alone else contact
    functions, mine = whole.functions, whole.local
    labels, box = np.zeros(mine.shape, np.intp), bounding_box(mine)
    count = 0 if box is None else int(scipy.ndimage.label(mine[box], output=labels[box]))
    counts = functions.communicator.allgather(count)
    before, parts = sum(counts[: functions.rank]), sum(counts)
    np.add(labels, before, out=labels, where=mine)
    spot = _spot_of_part(whole.like(labels), grid.periodic, parts)

    cells = np.flatnonzero(mine)
    part, weights = labels.ravel()[cells] - 1 - before, measure.on(cells)
    forces = weights * (pressure if alone else pressure.local).ravel()[cells]
    own = [np.bincount(part, weights=each, minlength=count) for each in (weights, forces)]
    areas, loads = (
        np.bincount(spot[1:] - 1, weights=np.concatenate(each)).astype(np.float64)
        for each in zip(*functions.communicator.allgather(own), strict=True)
    )
    if len(areas) < parts:
        labels = spot[labels]
    found: Any = labels if alone else whole.like(labels)
    return Spots(len(areas), areas, loads, found)


def _spot_of_part(labels: SlabArray, periodic: tuple[bool, ...], parts: int) -> npt.NDArray[np.intp]:
    """Return the spot of each part; parts meet across a periodic edge, or across the rows of two processes.

    Spots are numbered in the order of their first cells; label 0, the background, is linked to nothing.
    """
    functions, mine = labels.functions, labels.local
    meeting = [(functions.row_beside(labels, 1)[:1], mine[:1])] if periodic[0] else []
    meeting += [(mine[:, -1:], mine[:, :1])] if all(periodic[1:]) and mine.ndim > 1 else []
    pairs = [np.stack([one.ravel(), other.ravel()]) for one, other in meeting]
    links = np.concatenate(
        [np.zeros((2, 0), np.intp), *(pair[:, pair.all(axis=0)] for pair in pairs)], axis=1
    )
    rows, columns = np.concatenate(functions.communicator.allgather(np.unique(links, axis=1)), axis=1)
    if not len(rows):
        return np.arange(parts + 1)
    import scipy.sparse.csgraph

    graph = scipy.sparse.coo_array((np.ones(len(rows)), (rows, columns)), shape=(parts + 1, parts + 1))
    return scipy.sparse.csgraph.connected_components(graph, directed=False)[1].astype(np.intp)
