"""Large contact regions by conjugate gradients."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.contact.conjugate_gradient import Relaxed, relax
from roughcontact.contact.measure import Measure
from roughcontact.contact.problem import Control, Force
from roughcontact.contact.refinement import relax_in_single
from roughcontact.halfspace.operator import Linear

__all__ = ["press_region"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]


def press_region(
    operator: Linear,
    separation: Array,
    control: Control,
    region: Mask,
    pressure: Array,
    displacement: Array,
    *,
    limit: float,
    max_steps: int,
    single: bool = False,
) -> Relaxed:
    """Press on a region alone and let go of cells that would pull, until none does.

    The counterpart of `press_cells`: both end with a pressure that is nowhere negative, so that cells are
    added only to a region whose answer is known. (Adding while letting go, as the method does where each
    region is solved exactly, runs in circles where it is not.)

    Parameters
    ----------
    operator, separation, control
        The problem.
    region : bool array
        Cells that may carry pressure.
    pressure, displacement : array
        Where to start [Pa], and its image [m].
    limit : float
        Largest error of the displacement on the cells that are kept [m].
    max_steps : int
        Largest number of products.
    single : bool
        Whether to work in single precision inside.
    """
    measure = Measure(operator.weights)
    depth = None if isinstance(control, Force) else control.value
    p, u, steps, xp = pressure, displacement, 0, namespace(pressure)
    while True:
        kept = xp.where(region & (p > 0), p, 0.0)
        if isinstance(control, Force):
            if not bool(xp.any(kept > 0)):  # nothing of the guess is left
                kept = xp.where(region, xp.ones_like(p), 0.0)
            kept *= control.value / measure.total(kept)
        if bool(xp.any(kept != p)):
            u, steps = u + operator.apply(kept - p), steps + 1
        solve = relax_in_single if single else relax
        found = solve(
            operator, region, separation, kept, u, depth=depth, limit=limit, max_steps=max_steps - steps
        )
        p, u, steps = found.pressure, found.displacement, steps + found.steps
        pulls = p < 0
        if not bool(xp.any(pulls)):
            return replace(found, steps=steps)
        region = region & ~pulls
        if steps >= max_steps or not bool(xp.any(region)):
            p = xp.where(p > 0, p, 0.0)
            return replace(found, pressure=p, displacement=operator.apply(p), steps=steps + 1)
