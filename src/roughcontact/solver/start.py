"""A first pressure that every solver can begin with."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.solver.control import Control, Force
from roughcontact.solver.inner_product import Measure

__all__ = ["start_pressure"]

Array = npt.NDArray[np.float64]


def start_pressure(
    measure: Measure, separation: Array, control: Control, initial: Array, self_influence: float
) -> Array:
    """Return `initial` without tension and without pressure on missing cells, under the right force.

    Where nothing is left, the cells of the lowest separation carry all: the force, or what moves it by the
    depth.
    """
    xp = namespace(separation)
    p = xp.where(xp.isfinite(separation) & (initial > 0), initial, 0.0)
    if not bool(xp.any(p > 0)):
        lowest = separation == xp.min(separation)
        p = xp.where(lowest, 1.0 if isinstance(control, Force) else control.value / self_influence, p)
    if isinstance(control, Force):
        p *= control.value / measure.total(p)
    return p  # type: ignore[no-any-return]
