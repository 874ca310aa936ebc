"""The heights of N cosine waves of one amplitude and independent phases: beat waves (thesis, fig. 24).

z = h0 sum_i (1 - cos phi_i), the depth below the common peak. Its density starts with z^(N/2 - 1).
"""

from __future__ import annotations

from functools import partial

import numpy as np
from scipy.special import binom, gammaln, j0

from roughcontact.theory.springs import cosine
from roughcontact.theory.springs.height_distribution import HeightDistribution
from roughcontact.validation import Array, numeric, positive, require, scalar

__all__ = ["beat_wave"]

# Terms of the series at the peak, whose ratio is at most NEAR/2.
NEAR, TERMS = 1.0, 60
# Largest argument of the Bessel functions in the Fourier sums of 2, 3, 4, ... waves: the remainder is below 2e-6 of
# the fraction and 2e-10 of the excess, which falls faster.
FAR = {2: 3e4, 3: 1e4, 4: 3e3}
FAR_OF_MANY = 1e3


@numeric
def beat_wave(modes: int, amplitude: float) -> HeightDistribution:
    """Return the distribution of the heights of several waves with independent phases.

    Parameters
    ----------
    modes : int
        Number N of waves.
    amplitude : float
        h0 of each wave [m].

    Returns
    -------
    HeightDistribution

    Raises
    ------
    ValueError
        If `modes` is not a positive whole number.

    Notes
    -----
    Phases of waves with incommensurable wavenumbers are independent along a long line; those of adjacent harmonics of
    one period are not.

    Computed near the peak from the power series of the N-fold convolution of 1/(pi sqrt(z(2 - z))), and further down
    from the Fourier series of the bounded heights, whose coefficients are J0^N. One wave has a closed form (thesis,
    eq. 4.33). The relative error is below 2e-6 for up to eight waves; for more waves the absolute error is 1e-15,
    where the fraction is small.

    Examples
    --------
    >>> from roughcontact.theory import beat_wave, cosine
    >>> one = beat_wave.beat_wave(1, 1e-6).force(1e-6, 1e-3, 1e11)
    >>> round(float(one / cosine.force(1e-6, 1e-6, 1e-3, 1e11)), 6)  # one wave is the cosine
    1.0
    """
    given = scalar(modes, "modes")
    require(
        given >= 1 and given % 1 == 0, f"modes must be a positive whole number, not {modes}", place="modes"
    )
    n, h0 = int(given), float(positive(amplitude, "amplitude [m]"))
    name = f"{n} waves of independent phases" if n > 1 else "One cosine"
    if n == 1:
        wave = {"amplitude": h0, "length": 1.0, "modulus": 1.0}
        return HeightDistribution(name, partial(cosine.stiffness, **wave), partial(cosine.force, **wave))
    return HeightDistribution(name, partial(_integral, h0, n, 1), partial(_integral, h0, n, 2))


def _integral(amplitude: float, n: int, order: int, u: Array) -> Array:
    """Return the integral of the density of an order (1: fraction, 2: excess) at u."""
    depth = np.asarray(u / amplitude, dtype=np.float64)
    # The distribution is symmetric about n: fraction and excess below follow from those above.
    mirrored = np.minimum(depth, np.maximum(2 * n - depth, 0.0))
    near = mirrored <= NEAR
    values = np.empty(depth.shape)
    values[near] = _near_peak(mirrored[near], n, order)
    values[~near] = _fourier(mirrored[~near], n, order)
    below = depth > n
    values = np.where(below, depth - n + values if order == 2 else 1 - values, values)
    return amplitude ** (order - 1) * values[()]


def _near_peak(u: Array, n: int, order: int) -> Array:
    # One wave: density z^(-1/2) sum_k b_k z^k, b_k = binom(2k, k)/8^k/(pi sqrt 2), whose Laplace transform has the
    # coefficients b_k Gamma(k + 1/2): their N-th power belongs to the sum of N waves, Gamma inverts the transform.
    k = np.arange(TERMS)
    one = binom(2 * k, k) / 8.0**k / (np.pi * np.sqrt(2)) * np.exp(gammaln(k + 0.5))
    c = one
    for _ in range(n - 1):
        c = np.convolve(c, one)[:TERMS]
    power = n / 2 + order - 1
    terms = c * np.exp(-gammaln(k + power + 1))
    value: Array = u**power * np.polynomial.polynomial.polyval(u, terms)
    return value


def _fourier(u: Array, n: int, order: int) -> Array:
    # With x = u - n in (-n, n): density (1/2n) (1 + 2 sum_k J0(w)^n cos(w x)), w = pi k/n, integrated from -n.
    w = np.pi / n * np.arange(1, int(FAR.get(n, FAR_OF_MANY) * n / np.pi))
    c = j0(w) ** n / n
    if order == 1:
        waves = [np.sum(c / w * np.sin(w * x)) for x in u - n]
        return u / (2 * n) + np.asarray(waves, dtype=np.float64)
    start = np.cos(n * w)
    waves = [np.sum(c / w**2 * (start - np.cos(w * x))) for x in u - n]
    return u**2 / (4 * n) + np.asarray(waves, dtype=np.float64)
