"""Adhesion: L-BFGS-B on the gap, at an offset; its half-space holds the mean displacement by a spring."""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy.optimize
from Adhesion.Interactions import Exponential
from Adhesion.System import BoundedSmoothContactSystem, make_system
from ContactMechanics import PeriodicFFTElasticHalfSpace
from SurfaceTopography import Topography

PACKAGE = "Adhesion"
SETTINGS = "BoundedSmoothContactSystem, SciPy's L-BFGS-B on the gap"
START = {"adhesion": 1e-8}  # of the gradient, over the largest attraction


def adhesion(problem: Any, tolerance: float) -> dict[str, Any]:
    heights = problem.heights
    system = make_system(
        interaction=Exponential(problem.work, problem.range),
        surface=Topography(heights, problem.lengths, periodic=True),
        substrate=PeriodicFFTElasticHalfSpace(heights.shape, problem.modulus, problem.lengths),
        system_class=BoundedSmoothContactSystem,
    )
    offset, most = problem.rigid_depth - float(heights.max()), problem.work / problem.range
    found = scipy.optimize.minimize(
        system.primal_objective(offset, gradient=True),
        np.maximum(-heights - offset, 0.0).ravel(),
        jac=True,
        method="L-BFGS-B",
        bounds=scipy.optimize.Bounds(0.0, np.inf),
        options={"gtol": tolerance * most, "ftol": 0.0, "maxcor": 20, "maxiter": 20_000, "maxfun": 40_000},
    )
    ended = "converged" if found.success else str(found.message)
    return {"gap": found.x.reshape(heights.shape), "status": ended, "products": int(found.nfev)}
