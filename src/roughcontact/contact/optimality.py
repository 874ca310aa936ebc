"""The certificate: one dimensionless residual for all solvers and all operators."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

__all__ = ["displacement_scale", "residual"]

Array = npt.NDArray[np.float64]

# Below this part of what the largest pressure does in its own cell, a displacement is rounding: a flat
# periodic surface under uniform pressure does not move at all, and nothing could be relative to that.
FLOOR = 1e-7


def displacement_scale(pressure: Array, displacement: Array, self_influence: float) -> float:
    """Return the displacement that residuals are relative to [m]: the largest one."""
    floor = FLOOR * self_influence * float(pressure.max(initial=0.0))
    return max(float(np.abs(displacement).max(initial=0.0)), floor)


def residual(pressure: Array, gap: Array, scale: float) -> float:
    """Return by how much the conditions of contact are violated, relative to `scale`.

    The largest of ``|gap|`` where there is pressure and of ``-gap`` where there is none. It is infinite for
    a negative pressure, or for numbers that are none. It speaks of the algebra, not of the grid.
    """
    if not np.isfinite(pressure).all() or (pressure < 0).any():
        return math.inf
    violation = np.where(pressure > 0, np.abs(gap), -gap).max()
    if np.isnan(violation):
        return math.inf
    return max(0.0, float(violation)) / scale if scale > 0 else (0.0 if violation <= 0 else math.inf)
