"""The steps of a convolution in machine code one by one, for planes whose rows lie on several processes.

They do with a row or a column what `CompiledConvolution` does, to the last bit. Planes are in slabs because they are
large: no memory is kept for the next.
"""

from __future__ import annotations

import numpy as np

from roughcontact.kernels.buffers import aligned
from roughcontact.kernels.compiled_convolution import LARGE, PARTS
from roughcontact.kernels.loader import functions
from roughcontact.kernels.plane_plan import Indices, PlanePlan
from roughcontact.threads import threads
from roughcontact.validation import Array

__all__ = ["filter_columns", "transform_rows", "transform_rows_back"]


def transform_rows(plan: PlanePlan, local: Array) -> Array:
    """Return the spectrum of some rows, shape (blocks, rows, 2 lanes), with memory for whole lanes of rows."""
    shape = plan.blocks, plan.padded(len(local)), 2 * plan.lanes
    spectrum = aligned(shape[0] * shape[1] * shape[2], plan.precision, kept=False).reshape(shape)
    _along_rows("transform_rows", plan, np.ascontiguousarray(local, plan.precision), spectrum)
    return spectrum


def transform_rows_back(plan: PlanePlan, spectrum: Array, shape: tuple[int, int]) -> Array:
    """Return the rows of a spectrum, of which there are ``shape[0]``."""
    local = np.empty(shape, plan.precision)
    _along_rows("transform_rows_back", plan, local, spectrum)
    return local


def filter_columns(
    plan: PlanePlan, columns: Array, multiplier: Array, edges: Indices, places: Indices
) -> None:
    """Multiply whole columns in place between transforms there and back.

    Parameters
    ----------
    plan : PlanePlan
    columns : array
        Some blocks in pieces, one spectrum of some rows after the other.
    multiplier : array, shape (blocks, My//2 + 1, lanes)
        As `PlanePlan.in_blocks` makes it, of these blocks.
    edges, places : int array
        For each piece and after the last: its first row, and how many rows there is memory for before it.
    """
    blocks = len(multiplier)
    if not blocks:
        return
    workers, scratch = _shared(plan, columns.nbytes)
    pieces = columns, blocks, len(edges) - 1, edges, places
    wide = -(-blocks // (PARTS * workers))
    run = functions("fft", plan.precision)["filter_columns"]
    run(*pieces, *plan.across, multiplier, wide, *scratch, workers=workers)


def _along_rows(name: str, plan: PlanePlan, local: Array, spectrum: Array) -> None:
    (ny, nx), rows = local.shape, spectrum.shape[1]
    if not rows:
        return
    workers, scratch = _shared(plan, local.nbytes)
    many = -(-rows // (PARTS * workers * plan.lanes)) * plan.lanes
    run = functions("fft", plan.precision)[name]
    run(local, ny, nx, spectrum, rows, *plan.along, many, *scratch, workers=workers)


def _shared(plan: PlanePlan, size: int) -> tuple[int, tuple[Array, int, int]]:
    """Return the number of threads that share work on `size` bytes, and the memory of each."""
    workers = threads() if size >= LARGE else 1
    return workers, (aligned(workers * plan.scratch, plan.precision, kept=False), plan.scratch, plan.raw)
