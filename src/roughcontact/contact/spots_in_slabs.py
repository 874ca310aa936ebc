"""Contact spots of a periodic plane in slabs: labelled by every process, and joined where the rows of two meet."""

from __future__ import annotations

from typing import Any

import numpy as np

from roughcontact.contact.spots import Spots

__all__ = ["find_spots_in_slabs"]


def find_spots_in_slabs(contact: Any, pressure: Any, cell: float) -> Spots:
    """Return the spots of a contact, numbered as in one process; their labels are in slabs.

    Parameters
    ----------
    contact, pressure : SlabArray
        Of a plane that is periodic along both axes.
    cell : float
        Area of a cell [m^2].
    """
    import scipy.ndimage
    import scipy.sparse.csgraph

    functions, mine = contact.functions, contact.local
    labels = np.zeros(mine.shape, np.intp)
    count = int(scipy.ndimage.label(mine, output=labels))
    counts = functions.communicator.allgather(count)
    before, parts = sum(counts[: functions.rank]), sum(counts)
    np.add(labels, before, out=labels, where=mine)

    # Parts of one spot: across the edge along the rows, and to the row above, which another process holds.
    meeting = [(labels[:, 0], labels[:, -1]), (functions.row_beside(contact.like(labels), 1)[:1], labels[:1])]
    pairs = [np.stack([one.ravel(), other.ravel()]) for one, other in meeting]
    mine_links = np.unique(np.concatenate([pair[:, pair.all(axis=0)] for pair in pairs], axis=1), axis=1)
    rows, columns = np.concatenate(functions.communicator.allgather(mine_links), axis=1)
    links = scipy.sparse.coo_array((np.ones(len(rows)), (rows, columns)), shape=(parts + 1, parts + 1))
    # Numbered by the first cell of each, as in one process; label 0, the ground, is linked to nothing.
    _, spot_of_part = scipy.sparse.csgraph.connected_components(links, directed=False)

    part_of_cell = labels[mine] - 1 - before
    cells = np.bincount(part_of_cell, minlength=count)
    loads = np.bincount(part_of_cell, weights=pressure.local[mine], minlength=count) * cell
    of_all = functions.communicator.allgather((cells, loads))
    spot = spot_of_part[1:] - 1
    whole_cells, whole_loads = (np.concatenate(columns) for columns in zip(*of_all, strict=True))
    return Spots(
        int(spot_of_part.max()),
        (np.bincount(spot, weights=whole_cells) * cell).astype(np.float64),
        np.bincount(spot, weights=whole_loads).astype(np.float64),
        contact.like(spot_of_part.astype(np.intp)[labels]),
    )
