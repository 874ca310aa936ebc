"""ContactMechanics with SurfaceTopography: the code behind contact.engineering."""

from __future__ import annotations

from typing import Any

import numpy as np
from ContactMechanics import FreeFFTElasticHalfSpace, PeriodicFFTElasticHalfSpace
from ContactMechanics.Factory import make_plastic_system
from ContactMechanics.Optimization import constrained_conjugate_gradients
from SurfaceTopography import PlasticTopography, Topography

PACKAGE = "ContactMechanics"
SETTINGS = "constrained_conjugate_gradients (Polonsky-Keer), with a plastic topography for a hardness"
START = {
    "normal": 3e-8,
    "plasticity": 3e-8,
}  # its tolerance is a length; given as a part of the largest height


def normal(problem: Any, tolerance: float) -> dict[str, Any]:
    shape, periodic = problem.heights.shape, problem.periodic
    kind = PeriodicFFTElasticHalfSpace if periodic else FreeFFTElasticHalfSpace
    substrate = kind(shape, problem.modulus, problem.lengths)
    surface = Topography(problem.heights, problem.lengths, periodic=periodic)
    # What `forcetol` means here is the force outside the contact before it is set to zero.
    given = {"pentol": tolerance * float(np.ptp(problem.heights)), "forcetol": np.inf, "maxiter": 10_000}
    given["external_force"] = problem.force
    if np.isfinite(problem.hardness):
        plastic = PlasticTopography(surface, problem.hardness)
        found = make_plastic_system(substrate=substrate, surface=plastic).minimize_proxy(**given)
    else:
        found = constrained_conjugate_gradients(substrate, surface, **given)
    pressure = np.maximum(found.jac[: shape[0], : shape[1]], 0) / np.prod(problem.spacing)
    answer = {"pressure": pressure, "status": "converged" if found.success else str(found.message)}
    # On a periodic grid its offset holds a mean displacement by a convention of its own.
    return answer if periodic else answer | {"own_depth": float(found.offset + problem.heights.max())}


plasticity = normal
