"""A note where the force stands on probable faults of the measurement: streaks, pieces of streaks, a few cells."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from roughcontact.arrays import is_numpy
from roughcontact.contact.solution import Solution
from roughcontact.labels.note import Note, Rank
from roughcontact.surface.preparation.streaks import stands_out, streaks_and_pieces
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, Mask

__all__ = ["fault_notes"]

BORNE = 0.2  # of the force, by streaks: with less, stiffness and area change by less than they scatter between maps
ALONG = 5.0  # times the force on pieces along the other axis: edges of particles are as frequent along both
# Of the cells in contact, if they carry half of the force. On made rough surfaces and smooth bodies it is 0.2 or more
# (docs/concepts/spikes.md).
FEW = 0.125
_CHOSEN = 10_000  # cells in contact from which the share of streaks is estimated


def fault_notes(solution: Solution) -> Iterator[Note]:
    """Yield a note if streaks, pieces of streaks along one axis, or a few cells carry a large part of the force."""
    surface, pressure = solution.problem.surface, solution.pressure
    is_map = isinstance(surface, Surface) and surface.grid.ndim == 2 and is_numpy(surface.heights)
    if not is_map or not solution.resolved_from_below:
        return
    heights, total = surface.heights, pressure.sum()  # type: ignore[union-attr]
    if found := _of_lines(solution, heights):
        yield found
        return
    ordered = np.sort(pressure[pressure > 0])[::-1]
    few = 1 + int(np.searchsorted(np.cumsum(ordered), total / 2))
    if few < FEW * ordered.size:
        yield Note(
            Rank.DOUBTFUL,
            f"{few} of {ordered.size} cells in contact carry half of the force, fewer than on rough surfaces. Look at "
            "the picture of the pressure. If these cells are faults or particles, mask the most loaded ones by "
            f"{_mask_of(pressure >= ordered[few - 1], pressure)}, and press again.",
        )


def _of_lines(solution: Solution, heights: Array) -> Note | None:
    """Return a note if streaks or their pieces carry a large part of the force."""
    pressure, total = solution.pressure, solution.pressure.sum()
    cells = np.flatnonzero(solution.contact)
    cells = cells[:: -(-len(cells) // _CHOSEN)]
    loads = pressure.ravel()[cells]
    if loads[stands_out(heights, cells)].sum() < 0.5 * BORNE * loads.sum():
        return None  # without a search of the whole map, which takes its memory several times
    streaks, rows, columns = streaks_and_pieces(heights)
    if (share := pressure[streaks].sum() / total) >= BORNE:
        return Note(
            Rank.DOUBTFUL,
            f"Streaks along scan lines carry {share:.0%} of the force, on {np.count_nonzero(pressure[streaks])} cells: "
            "they are faults of the measurement. Remove them by despiked().",
        )
    pieces = {"rows": rows, "columns": columns}
    borne = {axis: pressure[cells].sum() / total for axis, cells in pieces.items()}
    for axis, other in (("rows", "columns"), ("columns", "rows")):
        if borne[axis] >= max(BORNE, ALONG * borne[other]):
            return Note(
                Rank.DOUBTFUL,
                f"{np.count_nonzero(pressure[pieces[axis]])} cells in runs along {axis}, far above the {axis} on both "
                f"sides, carry {borne[axis]:.0%} of the force. If they are faults, such as pieces of streaks, mask the "
                f"most loaded ones by {_mask_of(pieces[axis], pressure)}, and press again.",
            )
    return None


def _mask_of(cells: Mask, pressure: Array) -> str:
    """Return the call that masks the box around the most loaded cluster of cells."""
    from scipy.ndimage import find_objects, label, sum_labels

    clusters, count = label(cells, np.ones((3, 3)))
    most = int(np.argmax(sum_labels(pressure, clusters, np.arange(1, count + 1))))
    box = ", ".join(f"slice({part.start}, {part.stop})" for part in find_objects(clusters)[most])
    return f"masked(box=({box}))"
