"""Tamaas, under the AGPL: never a dependency of this project, only measured."""

from __future__ import annotations

from typing import Any

import numpy as np
import tamaas

PACKAGE = "tamaas"
SETTINGS = (
    "PolonskyKeerRey on the pressure, free: dcfft; on the gap for adhesion; KatoSaturated for a hardness"
)
START = {"normal": 3e-8, "adhesion": 1e-12}  # of the mean |gap| under pressure, up to five times the residual
tamaas.set_log_level(tamaas.LogLevel.error)


def normal(problem: Any, tolerance: float) -> dict[str, Any]:
    shape, gap = problem.heights.shape, tamaas.PolonskyKeerRey.gap
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [*problem.lengths], [*shape])
    model.E, model.nu = problem.modulus, 0.0
    given, target = (model, problem.heights, tolerance), problem.force / np.prod(problem.lengths)
    if problem.work:
        solver, target = tamaas.PolonskyKeerRey(*given, gap, gap), problem.mean_gap
        law = tamaas.ExponentialAdhesionFunctional(problem.heights)
        law.parameters = {"rho": problem.range, "surface_energy": problem.work}
        solver.addFunctionalTerm(law)
    elif np.isfinite(problem.hardness):
        solver = tamaas.KatoSaturated(*given, problem.hardness)
    else:
        solver = tamaas.PolonskyKeerRey(*given)
    solver.max_iter = 100_000 if problem.work else 10_000
    if not problem.periodic:
        tamaas.ModelFactory.registerNonPeriodic(model, "dcfft")
        solver.setIntegralOperator("dcfft")
    ended = "converged" if solver.solve(target) <= tolerance else "step limit"
    return {"pressure": np.array(model.traction), "gap": np.array(model["gap"]), "status": ended}


plasticity = adhesion = normal
