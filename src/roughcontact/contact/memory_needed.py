"""The peak memory of a load or a curve before it is computed, from measured bytes per cell."""

from __future__ import annotations

import math
import platform
from typing import Any

from roughcontact.arrays import is_numpy
from roughcontact.contact.problem import Body
from roughcontact.errors import InputError
from roughcontact.grid import AnyGrid, Grid, RadialGrid
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import Operator, capabilities
from roughcontact.kernels.buffers import MOST
from roughcontact.memory import require_memory
from roughcontact.slabs.agreement import by_each
from roughcontact.slabs.slab_array import SlabArray
from roughcontact.validation import shown

__all__ = ["largest_maps", "memory_needed", "require_memory_for"]

# Bytes per cell in addition to the heights: for a load on few cells and for the heaviest load, and the same for a
# curve. They depend on the geometry, and on whether a constant pressure causes no displacement: then all cells are
# solved for, even under a light load. For rings they are bytes per pair of rings, because the matrix is full.
# `benchmarks/memory.py` measures them on maps of 512 x 512 and 2048 x 2048 cells, and lines of up to 640 000; the
# lower bound of a periodic line is that of 8100 cells (tests/contact/test_memory_needed.py). Lower bounds are rounded
# down, because a load that fits must not be refused. Every load writes at least 9 bytes: the separation and the mask of
# missing cells.
BYTES = {
    (Geometry.SURFACE, False): (9, 95, 60, 155),
    (Geometry.SURFACE, True): (40, 75, 45, 105),
    (Geometry.LINE, False): (9, 300, 60, 300),
    (Geometry.LINE, True): (60, 300, 60, 300),
    (Geometry.FOUNDATION, False): (9, 75, 60, 140),
    (Geometry.RING, False): (8, 75, 8, 75),
}


def memory_needed(
    surface: Body | AnyGrid, *, operator: Operator | None = None, curve: bool = False
) -> tuple[int, int]:
    """Return the peak memory of a load in addition to the surface: of a light load, and in full contact.

    Parameters
    ----------
    surface : Surface, RadialProfile, Grid or RadialGrid
        The surface, or its grid.
    operator : Operator, optional
        The body, if it is not the half-space.
    curve : bool
        Whether a curve leads up to the load.

    Returns
    -------
    tuple of int
        The smallest and the largest memory of a load [bytes]; for a surface in slabs, those of this process. Python and
        its libraries take about 150 MB more.

    Raises
    ------
    ValueError
        If `surface` is neither a surface nor a grid.

    Notes
    -----
    The numbers come from a table of measured bytes per cell, see docs/how-to/memory.md. The second one contains up to
    64 MB for arrays that are kept for the next load and for the matrix of a contact of at most 2000 cells.

    Examples
    --------
    >>> import roughcontact as rc
    >>> for periodic in (False, True):
    ...     light, full = rc.memory_needed(rc.Grid((16384, 16384), 1e-7, periodic))
    ...     print(f"{light / 1e9:.0f} to {full / 1e9:.0f} GB")
    2 to 26 GB
    11 to 20 GB
    """
    grid = getattr(surface, "grid", surface)
    if not isinstance(grid, Grid | RadialGrid):
        raise InputError(f"a surface or its grid is wanted, not {shown(surface)}", place="surface")
    heights: Any = getattr(surface, "heights", None)
    stated = capabilities(operator)
    geometry = stated.geometry or Geometry.of(grid)
    still = all(grid.periodic) if stated.semidefinite is None else stated.semidefinite
    row = BYTES.get((geometry, still), BYTES[geometry, False])
    cells = heights.local.size if isinstance(heights, SlabArray) else grid.size
    if operator is None and geometry is Geometry.RING:
        cells *= cells
    light, full = (cells * each for each in (row[2:] if curve else row[:2]))
    return light, full + min(full + 16 * grid.size**2, MOST)  # arrays that are kept, a matrix and its factors


def largest_maps(memory: float) -> tuple[int, int]:
    """Return the cells per side of free square maps that fit a memory [bytes]: for light loads, in full contact."""
    light, full, *_ = BYTES[Geometry.SURFACE, False]
    heights = 8  # bytes of a cell
    return math.isqrt(int(memory / (light + heights))), math.isqrt(
        int(max(0, memory - MOST) / (full + heights))
    )


def require_memory_for(surface: Body, operator: Operator | None = None, *, curve: bool = False) -> None:
    """Raise an error if no load or curve fits into memory; warn if a heavy load may not fit.

    Raises
    ------
    ValueError
        If this machine has less memory than the lightest load takes.
    """
    heights: Any = surface.heights
    in_slabs = isinstance(heights, SlabArray)
    if not (in_slabs or is_numpy(heights)):
        return
    light, full = memory_needed(surface, operator=operator, curve=curve)
    what = f"{'a curve' if curve else 'a load'} on {' x '.join(map(str, surface.grid.shape))} cells"
    remedy = "press a part, or average cells"
    if not in_slabs:
        require_memory(light, full, what, remedy)
        return
    # Several processes may share a machine: all of them raise the error if one machine has too little memory.
    communicator, machine = heights.functions.communicator, platform.node()
    needed_by_all = communicator.allgather((machine, light, full))
    here = [needed for name, *needed in needed_by_all if name == machine]
    light, full = (sum(needed) for needed in zip(*here, strict=True))
    what = f"{what}, held by {len(needed_by_all)} processes of which {len(here)} share this machine,"
    by_each(communicator, lambda: require_memory(light, full, what, remedy))
