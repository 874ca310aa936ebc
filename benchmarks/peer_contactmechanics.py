"""ContactMechanics with SurfaceTopography: the code behind contact.engineering."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from ContactMechanics import FreeFFTElasticHalfSpace, PeriodicFFTElasticHalfSpace
from ContactMechanics.Optimization import constrained_conjugate_gradients
from SurfaceTopography import Topography

PACKAGE = "ContactMechanics"
SETTINGS = "constrained_conjugate_gradients (Polonsky-Keer)"
START = 3e-8  # its tolerance is a length; it is given as a part of the largest height


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
    lengths = tuple(n * step for n, step in zip(heights.shape, spacing, strict=True))
    half_space = PeriodicFFTElasticHalfSpace if periodic else FreeFFTElasticHalfSpace
    substrate = half_space(heights.shape, modulus, lengths)
    result = constrained_conjugate_gradients(
        substrate,
        Topography(heights, lengths, periodic=periodic),
        external_force=force,
        pentol=tolerance * float(np.ptp(heights)),
        forcetol=np.inf,  # what is meant here is the force outside the contact before it is set to zero
        maxiter=10_000,
    )
    ny, nx = heights.shape
    pressure = np.maximum(result.jac[:ny, :nx], 0) / (spacing[0] * spacing[1])
    # On a periodic grid its offset holds a mean displacement by a convention of its own.
    return pressure, None if periodic else float(result.offset + heights.max())
