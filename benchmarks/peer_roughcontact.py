"""Ours: roughcontact, with nothing set."""

from __future__ import annotations

import time

import numpy as np
import numpy.typing as npt

import roughcontact as rc

PACKAGE = "roughcontact"
SETTINGS = "press(surface, modulus, force=...)"
START = 1e-8  # the default: no setting that a user would have to choose

rc.press  # noqa: B018  # an import that fails does so here, not inside the first measurement


def solve(
    heights: npt.NDArray[np.float64],
    spacing: tuple[float, float],
    modulus: float = 1.0,
    *,
    force: float,
    periodic: bool,
    tolerance: float,
) -> tuple[npt.NDArray[np.float64], float | None]:
    """Return the pressure [Pa] and the depth since first touch [m]."""
    grid = rc.Grid(heights.shape, spacing, periodic=periodic)
    solution = rc.press(rc.Surface(heights, grid), modulus, force=force, tolerance=tolerance)
    return solution.pressure, solution.depth


def product_seconds(
    pressure: npt.NDArray[np.float64], spacing: tuple[float, float], *, periodic: bool
) -> float:
    """Return the least time of an exact product with the whole grid [s]: what a load is counted in."""
    operator, seconds = rc.half_space(rc.Grid(pressure.shape, spacing, periodic=periodic), 1.0), []
    for _ in range(6):  # the first makes the kernel
        start = time.perf_counter()
        operator.apply(pressure)
        seconds.append(time.perf_counter() - start)
    return min(seconds)
