"""The memory that a load or a curve takes at its peak, before it is tried."""

from __future__ import annotations

from typing import Any

from roughcontact.arrays import is_numpy
from roughcontact.contact.memory_model import MemoryModel, Touch, share_peak
from roughcontact.contact.touch import touch_of
from roughcontact.grid import Grid
from roughcontact.labels.variables import force_unit
from roughcontact.material import Solid, as_modulus
from roughcontact.slabs.slab_array import SlabArray
from roughcontact.solver.loads import control_of
from roughcontact.surface.surface import Surface
from roughcontact.validation import exactly_one, numeric, shown

__all__ = ["memory_needed"]


@numeric(modulus="Pa", force=force_unit, depth="m", pressure="Pa")
def memory_needed(
    surface: Surface | Grid,
    modulus: float | Solid | tuple[Solid, Solid] | None = None,
    *,
    force: float | None = None,
    depth: float | None = None,
    pressure: float | None = None,
    curve: bool = False,
) -> int:
    """Return the memory that a load takes at its peak, beside the surface [bytes].

    Parameters
    ----------
    surface : Surface or Grid
        A map of two axes, or its grid.
    modulus : float, Solid or pair of Solids, optional
        Reduced modulus E* [Pa], or what it follows from: needed with a load.
    force, depth, pressure : float, optional
        At most one: the load, see `press`; of a curve the largest. Without one, what the heaviest load takes; a light
        one may take up to 20 MB more, for a matrix between the cells in contact.
    curve : bool
        Whether a curve leads up to the load.

    Returns
    -------
    int
        Memory of arrays [bytes]; of a surface in slabs that of this process, whatever the load. On a free grid light
        loads take far less than heavy ones. Python and its libraries take some 150 MB beside it.

    Raises
    ------
    ValueError
        If there is no map of two axes, or a load without a surface of NumPy's and a modulus.

    Notes
    -----
    A model of what is alive at once (``roughcontact.contact.memory_model``), for elastic loads on the half-space by
    the default solver. How much touches is found on larger cells, 64 to 256 of them along the longer side.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((16384, 16384), 1e-7, periodic=True)
    >>> f"{rc.memory_needed(grid) / 1e9:.0f} GB, a curve {rc.memory_needed(grid, curve=True) / 1e9:.0f} GB"
    '15 GB, a curve 20 GB'
    """
    grid = surface if isinstance(surface, Grid) else getattr(surface, "grid", None)
    if not isinstance(grid, Grid) or grid.ndim != 2:
        raise ValueError(f"a map or its grid of two axes is wanted, not {shown(surface)}")
    heights: Any = getattr(surface, "heights", None)
    if isinstance(heights, SlabArray):
        return share_peak(heights.local.size, curve=curve)
    touch, loads = Touch(), {"force": force, "depth": depth, "pressure": pressure}
    if any(load is not None for load in loads.values()):
        if modulus is None or not isinstance(surface, Surface):
            raise ValueError(
                "what a load takes depends on how much touches: give the surface and the modulus"
            )
        if not is_numpy(surface.heights):
            raise ValueError("how much touches is asked of heights of NumPy alone: leave out the load")
        touch = touch_of(surface, as_modulus(modulus), control_of(*exactly_one(**loads), grid))
    return MemoryModel.of(grid).peak(touch, curve=curve)
