"""Contact that is too small to see: the spots that need a mark, and the part of the map to enlarge."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from scipy import ndimage

from roughcontact.contact.solution import Solution
from roughcontact.plot.drawing.raster import Window, part
from roughcontact.validation import Array, Mask

__all__ = ["contact_window", "faint_spots"]


_FAINT = 0.02  # a smaller part of the map in contact is invisible on the page
_NARROW = 0.01  # a spot narrower than this part of the side looks like dust
_NEAR = 0.03  # marks closer than this part of the side would overlap
_MARKS = 100  # more marks would hide what they mark
_LARGE = 1 / 6  # enlarged part of the side if contact is spread out
_LEAST = 12  # smallest number of cells along a side of an enlarged part
_BLOCKS = 128


def faint_spots(solution: Solution, window: Window) -> tuple[Array, Array]:
    """Return the spots that are invisible if `window` fills the picture: numbers from 0, and cells.

    The cell is that of the largest pressure, shape ``(n, 2)``: row, column. Among neighbours, only the spot with the
    largest load gets a mark; spots beside a visible one get none. If contact is easy to see, there are no marks.
    """
    contact = solution.contact[window]
    none = np.zeros(0, dtype=int), np.zeros((0, 2), dtype=int)
    if contact.mean() > _FAINT:
        return none
    spots = solution.spots
    labels = np.where(contact, spots.labels[window], 0)
    present = np.unique(labels[contact]) - 1
    wide = np.sqrt(spots.areas[present] / solution.problem.grid.cell_area) >= _NARROW * min(contact.shape)
    narrow = present[~wide]
    if narrow.size == 0:
        return none
    narrow = narrow[np.argsort(-spots.loads[narrow], kind="stable")]
    # The cell of the largest pressure lies in its spot; the centre of a spot across the edge of a periodic map may not.
    cells = np.array(ndimage.maximum_position(solution.pressure[window], labels, narrow + 1))

    # Neighbours are found by squares of the map: one mark for each square, and none in or beside the square of a
    # visible spot.
    side = max(1.0, _NEAR * max(contact.shape))
    seen = np.argwhere(np.isin(labels, present[wide] + 1))
    taken = np.zeros([int(n / side) + 1 for n in contact.shape], dtype=bool)
    taken[tuple((seen / side).astype(int).T)] = True
    taken = ndimage.binary_dilation(taken, np.ones((3, 3), dtype=bool))
    marked: list[int] = []
    for index, square in enumerate((cells / side).astype(int)):
        if not taken[tuple(square)] and len(marked) < _MARKS:
            taken[tuple(square)] = True
            marked.append(index)
    return narrow[marked], cells[marked] + [rows_or_columns.start for rows_or_columns in window]


def contact_window(solution: Solution) -> Window | None:
    """Return the cells around the contact to enlarge, or None if the whole map is good enough.

    The window is that of the whole contact if it extends over less than half of each side. If the contact is spread out
    and too faint to see, it is the part that carries the most load. The window has the proportions of the map.
    """
    contact = solution.contact
    if not contact.any():
        return None
    centre, share = _surroundings(contact, part(solution.problem.grid, None))
    if share < 1 / 2:
        whole = _window(contact.shape, centre, share)
        if share <= _LARGE or contact[whole].mean() > _FAINT:
            return _smaller(whole, contact.shape)
    if contact.mean() > _FAINT:
        return None
    heavy = _window(contact.shape, _heaviest(solution.pressure, _LARGE), _LARGE)
    if contact[heavy].any():
        centre, share = _surroundings(contact, heavy)
        heavy = _window(contact.shape, centre, min(share, _LARGE))
    return _smaller(heavy, contact.shape)


def _surroundings(contact: Mask, window: Window) -> tuple[list[float], float]:
    """Return the centre of the contact in `window`, and the part of the map that shows it with a margin."""
    spans = [np.flatnonzero(contact[window].any(axis=axis)) for axis in (1, 0)]
    centre = [cells.start + (s[0] + s[-1] + 1) / 2 for cells, s in zip(window, spans, strict=True)]
    share = max(float(s[-1] - s[0] + 1) / n for s, n in zip(spans, contact.shape, strict=True))
    return centre, 1.3 * share


def _window(shape: tuple[int, ...], centre: Sequence[float], share: float) -> Window:
    """Return the cells around `centre` (row, column), `share` of each side long, moved to lie on the map."""
    sizes = [min(n, max(math.ceil(share * n), _LEAST)) for n in shape]
    first = [min(max(round(c - s / 2), 0), n - s) for c, s, n in zip(centre, sizes, shape, strict=True)]
    y, x = (slice(start, start + size) for start, size in zip(first, sizes, strict=True))
    return y, x


def _smaller(window: Window, shape: tuple[int, ...]) -> Window | None:
    """Return the window, or None if it is almost as large as the map."""
    shares = [(cells.stop - cells.start) / n for cells, n in zip(window, shape, strict=True)]
    return window if min(shares) <= 1 / 2 else None


def _heaviest(pressure: Array, share: float) -> list[float]:
    """Return the centre (row, column) of the part, `share` of each side long, that carries the most load."""
    # Blocks first: a smooth average over many cells of a large map would take longer than the solve.
    strides = [-(-n // _BLOCKS) for n in pressure.shape]
    blocks = pressure
    for axis, stride in enumerate(strides):
        blocks = np.add.reduceat(blocks, np.arange(0, blocks.shape[axis], stride), axis=axis)
    # A Gaussian has its maximum at the middle of the load; that of a box would not be unique.
    smooth = ndimage.gaussian_filter(blocks, [share * n / 4 for n in blocks.shape], mode="constant")
    peak = np.unravel_index(int(np.argmax(smooth)), smooth.shape)
    return [(int(block) + 0.5) * stride for block, stride in zip(peak, strides, strict=True)]
