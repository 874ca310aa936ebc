"""ASPHER: nested grids, the |q| preconditioner, and the exact operator by FFT. Square grids only."""

from __future__ import annotations

from typing import Any

import aspher
import numpy as np

PACKAGE = "aspher"
SETTINGS = "solve_nested, |q| preconditioner by FFT, float then double; backend fft or periodic"
START = {"normal": 1e-8}  # its tolerance bounds the energy; the residual comes out up to four times as large


def normal(problem: Any, tolerance: float, **settings: Any) -> dict[str, Any]:
    (n, nx), (step, dx) = problem.heights.shape, problem.spacing
    if (n, step) != (nx, dx):
        raise ValueError("ASPHER solves squares of square cells")
    exact = {"backend": "periodic" if problem.periodic else "fft", "precond_engine": "fft"}
    coarsest = n
    while coarsest % 2 == 0 and coarsest > 64:
        coarsest //= 2
    found = aspher.solve_nested(
        grid_size=n,
        gap=np.negative(problem.heights).ravel(),
        p_nominal=problem.force / (n * step) ** 2,
        domain_size=n * step,
        E_star=problem.modulus,
        coarsest=coarsest,
        tol=tolerance,
        light_result=True,
        **(settings or exact | {"precision": "float_then_double"}),
    )
    pressure = np.asarray(found.pressure, dtype=np.float64).reshape(n, n)
    counts = {"products": found.matvec_count, "preconditioners": found.precond_count}
    return {"pressure": pressure, "status": found.status, "tolerance": found.effective_tol} | counts
