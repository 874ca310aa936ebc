"""From the spectrum of a surface to that of its profiles and back, for isotropic surfaces."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal

import numpy as np
from scipy.special import gammaln

from roughcontact.errors import InputError
from roughcontact.surface.analysis.hurst import fit_spectrum
from roughcontact.surface.analysis.power import PowerSpectrum, require_measured
from roughcontact.validation import Array, numeric, require

__all__ = ["cut_factor", "profile_spectrum", "surface_spectrum"]


@numeric
def cut_factor(hurst: float) -> float:
    """Return C1D/(q C2D) of straight cuts through an unlimited self-affine surface.

    ``sqrt(pi) Gamma(H + 1/2)/Gamma(H + 1)`` (beside thesis, eq. 2.10, whose C1D is not that of a cut).

    Parameters
    ----------
    hurst : float
        Hurst exponent H, above -1/2.

    Returns
    -------
    float
        The factor [-].

    Raises
    ------
    ValueError
        If H is not above -1/2, where the spectrum of a cut diverges.

    Examples
    --------
    >>> import roughcontact as rc
    >>> f"{rc.cut_factor(1.0):.6f}"  # pi/2
    '1.570796'
    """
    if not -0.5 < hurst < math.inf:
        raise InputError(
            f"a cut has a finite spectrum for a Hurst exponent above -1/2, not {hurst}", place="hurst"
        )
    return math.sqrt(math.pi) * math.exp(gammaln(hurst + 0.5) - gammaln(hurst + 1))


def profile_spectrum(spectrum: PowerSpectrum) -> PowerSpectrum:
    """Return C1D of straight cuts through an isotropic surface of the spectrum C2D.

    ``C1D(k) = 2 int_0^inf C2D(sqrt(k^2 + u^2)) du``.

    Parameters
    ----------
    spectrum : PowerSpectrum
        Of kind C2D. Between its bins a power law is assumed, beyond the last one zero.

    Returns
    -------
    PowerSpectrum
        Of kind C1D, in the bins that hold power.

    Raises
    ------
    ValueError
        If the spectrum is not a C2D, or has fewer than two bins with power.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> q = np.geomspace(1e3, 1e8, 101)
    >>> one = np.ones(q.size)
    >>> profile = rc.profile_spectrum(rc.PowerSpectrum(q, q**-4.0, "C2D", one, one, 1e3, 1e8))
    >>> f"{profile.density[0] / q[0] ** -3:.4f} = {rc.cut_factor(1.0):.4f}"
    '1.5708 = 1.5708'
    """
    require_measured(spectrum)
    require(spectrum.kind == "C2D", "the spectrum is that of profiles already: C1D", place="spectrum")
    ln_q, ln_c = _with_power(spectrum)
    q = np.exp(ln_q)
    # With q = k cosh t the integral is 2 int C2D q dt, and its integrand smooth.
    reach = np.arccosh(np.maximum(q[-1] / q, 1))
    nodes, weights = np.polynomial.legendre.leggauss(200)
    t = reach[:, None] * (nodes + 1) / 2
    at = ln_q[:, None] + np.log(np.cosh(t))
    values = np.exp(np.interp(at, ln_q, ln_c) + at)
    density = reach * (values @ weights)  # the half length of the interval takes the factor 2
    return _like(spectrum, ln_q, density, "C1D")


@numeric
def surface_spectrum(
    profile: PowerSpectrum, *, method: Literal["law", "abel"] = "law", hurst: float | None = None
) -> PowerSpectrum:
    """Return C2D of an isotropic surface from the spectrum C1D of its profiles.

    Parameters
    ----------
    profile : PowerSpectrum
        Of kind C1D; a single measured profile is enough for "law".
    method : {"law", "abel"}
        "law" divides by the factor of a self-affine cut, ``C2D = C1D/(q cut_factor(H))``: exact inside the band of
        a self-affine surface and never noisier than the profile, but up to a factor of two too large near the
        short end of a band, where the shorter waves that a cut adds are missing, and wrong on a plateau.
        "abel" inverts the cut, ``C2D(q) = -1/pi int_q^inf C1D'(k) dk/sqrt(k^2 - q^2)``: exact for any isotropic
        spectrum, but it differentiates: it needs the average of many profiles in bins of about a tenth of a decade
        (`PowerSpectrum.rebinned`). Beyond the last bin C1D is extrapolated from the last two.
    hurst : float, optional
        Hurst exponent for "law"; by default fitted to the profile.

    Returns
    -------
    PowerSpectrum
        Of kind C2D. The freedom is that of the profile; the error of the inversion is not included.

    Raises
    ------
    ValueError
        If the spectrum is not a C1D, or an inverted density is not positive (coarser bins help).

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> profile = rc.power_spectrum(surface, "x")
    >>> areal = rc.surface_spectrum(profile, hurst=0.8)
    >>> f"{profile.density[0] / (areal.density[0] * areal.wavenumber[0]):.4f} = {rc.cut_factor(0.8):.4f}"
    '1.7079 = 1.7079'
    """
    require(profile.kind == "C1D", "the spectrum is that of a surface already: C2D")
    if method == "law":
        exponent = fit_spectrum(profile).hurst if hurst is None else hurst
        return replace(
            profile,
            density=profile.density / (profile.wavenumber * cut_factor(exponent)),
            kind="C2D",
        )
    require(method == "abel", f"method must be 'law' or 'abel', not {method!r}", place="method")
    ln_k, ln_c = _with_power(profile)
    density = _abel(ln_k, ln_c)
    if not (density > 0).all():
        raise InputError(
            f"{int((density <= 0).sum())} of {density.size} inverted densities are not positive: the profile's "
            "spectrum is too noisy to be differentiated",
            "take coarser bins with rebinned(), or method='law'",
        )
    return _like(profile, ln_k, density, "C2D")


def _abel(ln_k: Array, ln_c: Array) -> Array:
    """Return the inverse of the cut of a spectrum that is a power law between its points."""
    slope = -np.diff(ln_c) / np.diff(ln_k)
    last = max(float(slope[-1]), 0.1)
    nodes, weights = np.polynomial.legendre.leggauss(24)
    density = np.zeros(ln_k.shape)
    for i, start in enumerate(ln_k):
        # -C1D'(k) dk/sqrt(k^2 - q^2) with k = q cosh t: slope * C1D/k dt, stretch by stretch, where it is smooth.
        edges = np.arccosh(np.exp(ln_k[i:] - start))
        if edges.size > 1:
            half = np.diff(edges)[:, None] / 2
            t = edges[:-1, None] + half * (nodes + 1)
            ln_cosh = np.log(np.cosh(t))
            local = ln_c[i:-1, None] - slope[i:, None] * (start + ln_cosh - ln_k[i:-1, None])
            values = slope[i:, None] * np.exp(local - start - ln_cosh)
            density[i] = float((half * values * weights).sum())
        # The rest falls like exp(-(last + 1) t), and before that like a power of cosh.
        tail = edges[-1] + 40 / (last + 1) * ((np.arange(4000) + 0.5) / 4000) ** 2
        width = 40 / (last + 1) * 2 * (np.arange(4000) + 0.5) / 4000 / 4000
        ln_cosh = tail + np.log1p(np.exp(-2 * tail)) - math.log(2)
        density[i] += last * float(
            np.exp(ln_c[-1] - last * (start + ln_cosh - ln_k[-1]) - start - ln_cosh) @ width
        )
    return density / math.pi


def _with_power(spectrum: PowerSpectrum) -> tuple[Array, Array]:
    """Return the logarithms of wavenumber and density of the bins that hold power."""
    keep = spectrum.density > 0
    require(keep.sum() >= 2, f"two bins with power are needed, not {int(keep.sum())}")
    return np.log(spectrum.wavenumber[keep]), np.log(spectrum.density[keep])


def _like(spectrum: PowerSpectrum, ln_q: Array, density: Array, kind: Literal["C1D", "C2D"]) -> PowerSpectrum:
    """Return `density` at the bins of `spectrum` that hold power, and positive ones only."""
    source = spectrum.selected(spectrum.density > 0)
    return replace(source, wavenumber=np.exp(ln_q), density=density, kind=kind).selected(density > 0)
