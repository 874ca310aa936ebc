"""Tamaas, under the AGPL: never a dependency of this project, only measured."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import tamaas

PACKAGE = "tamaas"
SETTINGS = "PolonskyKeerRey on the pressure; free: dcfft"
START = 3e-8  # its error is the mean |gap| under pressure; the residual comes out up to five times smaller

tamaas.set_log_level(tamaas.LogLevel.error)


def solve(
    heights: npt.NDArray[np.float64],
    spacing: tuple[float, float],
    modulus: float = 1.0,
    *,
    force: float,
    periodic: bool,
    tolerance: float,
) -> tuple[npt.NDArray[np.float64], float | None]:
    """Return the pressure [Pa]; the depth is lost in the solver's own shift of the gaps."""
    lengths = [n * step for n, step in zip(heights.shape, spacing, strict=True)]
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, lengths, list(heights.shape))
    model.E, model.nu = modulus, 0.0
    solver = tamaas.PolonskyKeerRey(model, heights.copy(), tolerance)
    solver.max_iter = 10_000
    if not periodic:
        tamaas.ModelFactory.registerNonPeriodic(model, "dcfft")
        solver.setIntegralOperator("dcfft")
    solver.solve(force / (lengths[0] * lengths[1]))
    return np.array(model.traction).reshape(heights.shape), None
