"""How much of two rough bodies touches under a load, found on large cells; and a refusal of what does not fit."""

from __future__ import annotations

import platform
from typing import Any

import numpy as np

from roughcontact.arrays import is_numpy
from roughcontact.contact.memory_model import MemoryModel, Touch, share_peak
from roughcontact.contact.problem import Body, separation_of
from roughcontact.grid import Grid
from roughcontact.halfspace.operators.build import half_space
from roughcontact.memory import most_memory, require_memory
from roughcontact.slabs.agreement import by_each
from roughcontact.slabs.slab_array import SlabArray
from roughcontact.solver import tuning
from roughcontact.solver.active_set import ActiveSet
from roughcontact.solver.control import Control, Specification, Start
from roughcontact.solver.nested_iteration import block_separation, coarse_operator, nested_start
from roughcontact.solver.subdomain import SubdomainSolver, bounding_box, prolong
from roughcontact.surface.surface import Surface
from roughcontact.threads import one_blas_thread

__all__ = ["require_memory_for_load", "touch_of"]

FEWEST = 2**16  # cells: fewer fit every machine
SIDE = 256  # cells to the longer side of the grid that tells, at most
# Exponent of the contact in the size of its cells, about: of nominally flat surfaces and of fractals (H = 0.8), from
# 256 to 2048 cells along a side.
SHRINKAGE = 1 / 4
ERROR = 1.2  # of the model: what it says is at least so much too large, or less


def touch_of(surface: Surface, modulus: float, control: Control) -> Touch:
    """Return how much of a map touches under a load on the half-space of a reduced modulus [Pa]."""
    assert isinstance(surface.grid, Grid)
    operator, separation, solver = half_space(surface.grid, modulus), separation_of(surface), ActiveSet()
    while max(separation.shape) > SIDE and (coarser := coarse_operator(operator, separation.shape)):
        operator, separation = coarser[0], block_separation(separation, coarser[1])
    spec = Specification(control, tuning.COARSE_TOLERANCE)
    with one_blas_thread():
        start = Start(*nested_start(operator, separation, control, solver))
        state, subdomain = SubdomainSolver(operator).solve(solver, separation, spec, start)
    pressed = prolong(state.pressure, subdomain, separation.shape) > 0
    overlap = (separation < state.depth) | pressed
    box = bounding_box(overlap)
    counts = np.count_nonzero(pressed), np.count_nonzero(overlap), 0 if box is None else overlap[box].size
    contact, overlapping, boxed = (float(count) / separation.size for count in counts)
    finer = (max(separation.shape) / max(surface.grid.shape)) ** SHRINKAGE
    return Touch(contact * finer, overlapping * finer, boxed)


def require_memory_for_load(surface: Body, modulus: float, control: Control, *, curve: bool = False) -> None:
    """Refuse a load on the half-space, or a curve up to it, that this machine has not the memory for.

    How much touches is asked only where the heaviest load might not fit.

    Raises
    ------
    ValueError
        If the model says so, even if it says too much by as much as it errs.
    """
    grid = surface.grid
    if grid.size < FEWEST or not (isinstance(surface, Surface) and isinstance(grid, Grid) and grid.ndim == 2):
        return
    shape = " x ".join(map(str, grid.shape))
    what = f"{'a curve' if curve else 'this load'} on {shape} cells"
    heights: Any = surface.heights
    if isinstance(heights, SlabArray):
        _require_memory_in_slabs(heights, what, curve=curve)
        return
    model = MemoryModel.of(grid)
    if not is_numpy(surface.heights) or model.peak(Touch(), curve=curve) / ERROR <= most_memory():
        return
    need = model.peak(touch_of(surface, modulus, control), curve=curve)
    require_memory(round(need / ERROR), what, "press a part, average cells, or take a smaller load")


def _require_memory_in_slabs(heights: SlabArray, what: str, *, curve: bool) -> None:
    """Refuse on all processes what the machine of one of them has not the memory for: several may share it."""
    communicator, machine = heights.functions.communicator, platform.node()
    told = communicator.allgather((machine, share_peak(heights.local.size, curve=curve) / ERROR))
    here = [need for name, need in told if name == machine]
    what = f"{what}, held by {len(told)} processes of which {len(here)} share this machine,"
    remedy = "press a part, average cells, take more machines"
    by_each(communicator, lambda: require_memory(round(sum(here)), what, remedy))
