"""ASPHER: nested grids, the |q| preconditioner, and the exact operator by FFT."""

from __future__ import annotations

from typing import Any

import aspher
import numpy as np
import numpy.typing as npt

PACKAGE = "aspher"
SETTINGS = "solve_nested, |q| preconditioner by FFT, float then double; backend fft or periodic"
START = 1e-8  # its tolerance bounds the energy; the residual comes out up to four times as large


def solve(
    heights: npt.NDArray[np.float64],
    spacing: tuple[float, float],
    modulus: float = 1.0,
    *,
    force: float,
    periodic: bool,
    tolerance: float,
) -> tuple[npt.NDArray[np.float64], float | None]:
    """Return the pressure [Pa] and the depth since first touch [m]. Square grids only."""
    settings = {"backend": "periodic" if periodic else "fft", "precond_engine": "fft"}
    settings |= {"precision": "float_then_double"}
    return solve_nested(heights, spacing, modulus, force=force, tolerance=tolerance, **settings), None


def solve_nested(
    heights: npt.NDArray[np.float64],
    spacing: tuple[float, float],
    modulus: float,
    *,
    force: float,
    tolerance: float,
    **settings: Any,
) -> npt.NDArray[np.float64]:
    """Return the pressure [Pa] on nested grids."""
    n, step = heights.shape[0], spacing[0]
    if heights.shape != (n, n) or spacing != (step, step):
        raise ValueError("ASPHER solves squares of square cells")
    result = aspher.solve_nested(
        grid_size=n,
        gap=np.negative(heights).ravel(),
        p_nominal=force / (n * step) ** 2,
        domain_size=n * step,
        E_star=modulus,
        coarsest=coarsest(n),
        tol=tolerance,
        light_result=True,
        **settings,
    )
    return np.asarray(result.pressure, dtype=np.float64).reshape(n, n)


def coarsest(n: int) -> int:
    """Return the coarsest grid of a nest that halves n down to 64 cells a side, or as far as it goes."""
    while n % 2 == 0 and n > 64:
        n //= 2
    return n
