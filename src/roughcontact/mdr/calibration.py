"""The factor of the line's spectrum that gives it the stiffness of the surface (thesis, eq. 4.75 and fig. 29)."""

from __future__ import annotations

import math

import numpy as np

from roughcontact.material import number
from roughcontact.mdr.lattice_sums import lambda_rms

__all__ = ["calibrated_lambda"]

# zeta of lines at Hurst exponents H, to 1 %: fits of `LineCurves` to the arithmetic means of 1000 lines of 2^13 points
# at 25 forces from 1e-5 to 0.07 in equal ratios (benchmarks/mdr.py).
_HURST = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.5, 3.0)
_LINE_PREFACTOR = (1.396, 1.198, 1.056, 0.962, 0.879, 0.808, 0.755, 0.713, 0.686, 0.659, 0.637, 0.612, 0.608)


def calibrated_lambda(
    hurst: float,
    *,
    modes: int | None = None,
    line_prefactor: float | None = None,
    surface_prefactor: float | None = None,
) -> float:
    """Return lambda of C1D = lambda q C2D for which line and surface are equally stiff at low loads (thesis, eq. 4.75).

    ``lambda = lambda_rms (zeta_line / zeta_surface)^(2/alpha)``, alpha = 1/(H + 1), from H = 2 on 1/3, with the
    prefactors zeta of ``k/(E* L) = zeta (F/(E* h L))^alpha``, each with the rms height h of its own line or
    surface. A line of this spectrum is used as it is, and not brought to the rms height of the surface.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, at least 0: below, stiffness is no power law of force.
    modes : int, optional
        See `lambda_rms`.
    line_prefactor : float, optional
        zeta of lines. By default, for H up to 3, what this package finds for lines of 2^13 points between a
        stiffness of 20 springs and a dimensionless force of 0.07, to 1 %.
    surface_prefactor : float, optional
        zeta of surfaces. By default, for H up to 2, the thesis' 1.7/(H + 1) (eq. 4.74).

    Raises
    ------
    ValueError
        If H is out of range, or a prefactor is not positive.

    Notes
    -----
    Prefactors enter with the power 2/alpha: 5 % in one of them are 20 % in lambda at H = 1. Both depend
    on the window of the fit: where it matters, give both from fits in one window. For a single wave (H to
    infinity) they are ``(3/(sqrt(2) pi^2))^(1/3)`` and ``(6/(4 pi^2))^(1/3)``, and lambda is 4: the line's crest
    has half the radius of the surface's, as in the contact of a sphere.
    """
    number("Hurst exponent", hurst)
    if not (math.isfinite(hurst) and hurst >= 0):
        raise ValueError(
            f"hurst must be finite and at least 0, where stiffness is a power of force, not {hurst}"
        )
    if line_prefactor is None:
        if hurst > _HURST[-1]:
            raise ValueError(
                f"give line_prefactor: there is none for H above {_HURST[-1]:g}, such as {hurst}"
            )
        line_prefactor = float(np.interp(hurst, _HURST, _LINE_PREFACTOR))
    if surface_prefactor is None:
        if hurst > 2:
            raise ValueError(f"give surface_prefactor: eq. 4.74 holds for H up to 2, not {hurst}")
        surface_prefactor = 1.7 / (hurst + 1)
    for name, value in (("line_prefactor", line_prefactor), ("surface_prefactor", surface_prefactor)):
        if not (math.isfinite(value) and value > 0):
            raise ValueError(f"{name} must be positive and finite, not {value}")
    steepness = 2 * min(hurst + 1, 3)
    return lambda_rms(hurst, modes) * math.pow(line_prefactor / surface_prefactor, steepness)
