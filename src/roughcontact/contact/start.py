"""A first pressure that every solver can begin with."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from roughcontact.contact.measure import Measure
from roughcontact.contact.problem import Control, Force

__all__ = ["start_pressure"]

Array = npt.NDArray[np.float64]


def start_pressure(
    measure: Measure, separation: Array, control: Control, initial: Array, self_influence: float
) -> Array:
    """Return `initial` without tension and without pressure on missing cells, under the right force.

    Where nothing is left, the cell of the lowest separation carries all: the force, or what moves it by the
    depth.
    """
    p = np.where(np.isfinite(separation), np.maximum(initial, 0.0), 0.0)
    if not p.any():
        lowest = np.unravel_index(np.argmin(separation), separation.shape)
        p[lowest] = 1.0 if isinstance(control, Force) else control.value / self_influence
    if isinstance(control, Force):
        p *= control.value / measure.total(p)
    return np.asarray(p)
