"""ASPHER with its hierarchical matrices at their default order, which err by more than a certificate allows."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from peer_aspher import START, solve_nested

PACKAGE = "aspher"
SETTINGS = "solve_nested, H2 matrices of order 6, active set; its answers are judged, not certified"
START = START
GOAL = math.inf


def solve(
    heights: npt.NDArray[np.float64],
    spacing: tuple[float, float],
    modulus: float = 1.0,
    *,
    force: float,
    periodic: bool,
    tolerance: float,
) -> tuple[npt.NDArray[np.float64], float | None]:
    """Return the pressure [Pa]. Square grids that are not periodic only."""
    if periodic:
        raise ValueError("its hierarchical matrices are of free surfaces")
    return solve_nested(heights, spacing, modulus, force=force, tolerance=tolerance, active_set=True), None
