"""Spectral moments of a measured spectrum over a band."""

from __future__ import annotations

import math

import numpy as np

from roughcontact.surface.analysis.power import PowerSpectrum, require_measured
from roughcontact.surface.moments import Moments
from roughcontact.validation import numeric, require

__all__ = ["spectrum_moments"]


@numeric(q_min="rad/m", q_max="rad/m")
def spectrum_moments(
    spectrum: PowerSpectrum, *, q_min: float | None = None, q_max: float | None = None
) -> Moments:
    """Return the profile moments m0, m2 and m4 that the waves between `q_min` and `q_max` contribute.

    Parameters
    ----------
    spectrum : PowerSpectrum
        Of a surface (assumed to be isotropic) or of its profiles. Between its bins a power law is assumed.
    q_min, q_max : float, optional
        The band [rad/m]; by default the reliable band. On a fractal m2 and m4 depend on `q_max`: state it.

    Returns
    -------
    Moments
        ``m0 = 2 pi int q C2D dq``, ``m2 = pi int q^3 C2D dq``, ``m4 = (3 pi/4) int q^5 C2D dq``, or
        ``mn = 2 int q^n C1D dq``.

    Raises
    ------
    ValueError
        If fewer than two bins with power lie in the band.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> q = np.geomspace(1e5, 1e6, 101)
    >>> one = np.ones(q.size)
    >>> moments = rc.spectrum_moments(rc.PowerSpectrum(q, 1 / q, "C1D", one, one, 1e5, 1e6))
    >>> f"m0 = {moments.m0:.4f} = 2 ln(10)"
    'm0 = 4.6052 = 2 ln(10)'
    """
    require_measured(spectrum)
    band = spectrum.within(q_min, q_max)
    keep = band.density > 0
    require(keep.sum() >= 2, f"moments need two bins with power in the band, not {int(keep.sum())}")
    ln_q, ln_c = np.log(band.wavenumber[keep]), np.log(band.density[keep])
    areal = spectrum.kind == "C2D"
    factors = (2 * math.pi, math.pi, 3 * math.pi / 4) if areal else (2.0, 2.0, 2.0)
    moments = np.zeros(3)
    for i, factor in enumerate(factors):
        # Each stretch is a power law: exp(a + b t) over the width w, whose integral is its mean by logarithms times w.
        logs = ln_c + (2 * i + (2 if areal else 1)) * ln_q
        rise, width = np.diff(logs), np.diff(ln_q)
        flat = np.abs(rise) < 1e-8
        mean = np.exp(logs[:-1]) * np.where(flat, 1 + rise / 2, np.expm1(rise) / np.where(flat, 1, rise))
        moments[i] = factor * float(mean @ width)
    m0, m2, m4 = (float(value) for value in moments)
    return Moments(m0, m2, m4, dimension=2 if areal else 1)
