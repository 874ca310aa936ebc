"""A short cosine wave on a long one, on springs: z = h1 cos(q1 x) + h2 cos(q2 x), q2 much larger than q1.

Section 4.4.2 of the thesis, with its equations 4.38 to 4.41, 4.45 and 4.46 corrected: the force on one crest of the
long wave, up to the depth 2 h2 at which the short wave is flat for the first time; and the hierarchy of waves
h_n = h0 C^(-nH), q_n = q0 C^n in which each step leads to the next.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import hyp2f1

from roughcontact.validation import Array, numeric, pair, positive, require, require_numbers, whole

__all__ = ["FLAT_FORCE", "FLAT_STIFFNESS", "Hierarchy", "flat", "force", "stiffness"]

# In units of E* h2^(3/2)/(q1 h1^(1/2)) and of E* (h2/h1)^(1/2)/q1 where the short wave is flat for the first time.
# The thesis has 16/(3 pi) and 4 (eqs 4.40 and 4.41).
FLAT_FORCE = 64 / (9 * np.pi)
FLAT_STIFFNESS = 8 / np.pi


@numeric
def force(
    depth: ArrayLike, long_wave: tuple[ArrayLike, ArrayLike], short_amplitude: ArrayLike, modulus: ArrayLike
) -> Array:
    """Return the force on one crest of the long wave [N] (thesis, eq. 4.38, corrected).

    Parameters
    ----------
    depth : float or array
        Indentation depth d from first touch, at most 2 h2 [m].
    long_wave : tuple of (float or array)
        Its amplitude h1 [m] and wavenumber q1 [rad/m].
    short_amplitude : float or array
        h2 of the short wave [m]; its wavenumber does not matter if it is much larger than q1.
    modulus : float or array
        Reduced modulus E* [Pa].

    Returns
    -------
    float or array
        F [N].

    Raises
    ------
    ValueError
        If the depth exceeds 2 h2, where the short wave has been flattened, or h1/2, where the contact extends beyond
        ``q1 |x| = 1`` and the crest of the long wave is not a parabola.

    Notes
    -----
    The integral over the crest is F = 2 E* h2^(3/2)/(q1 h1^(1/2)) s^2 2F1(1/2, 1/2; 3; s) with s = d/(2 h2).

    Examples
    --------
    >>> from roughcontact.theory import two_cosines
    >>> at_flat, _ = two_cosines.flat((1e-5, 1e3), 1e-7, 1e11)
    >>> round(float(two_cosines.force(2e-7, (1e-5, 1e3), 1e-7, 1e11) / at_flat), 6)
    1.0
    """
    s, h1, q1, h2, e = _given(depth, long_wave, short_amplitude, modulus)
    return 2 * e * h2**1.5 / (q1 * np.sqrt(h1)) * s**2 * hyp2f1(1 / 2, 1 / 2, 3, s)


@numeric
def stiffness(
    depth: ArrayLike, long_wave: tuple[ArrayLike, ArrayLike], short_amplitude: ArrayLike, modulus: ArrayLike
) -> Array:
    """Return the stiffness of one crest of the long wave [N/m]: the derivative of `force`.

    Parameters
    ----------
    depth : float or array
        Indentation depth d from first touch, at most 2 h2 [m].
    long_wave : tuple of (float or array)
        Its amplitude h1 [m] and wavenumber q1 [rad/m].
    short_amplitude : float or array
        h2 of the short wave [m].
    modulus : float or array
        Reduced modulus E* [Pa].

    Returns
    -------
    float or array
        k [N/m].

    Examples
    --------
    >>> from roughcontact.theory import two_cosines
    >>> k = two_cosines.stiffness(2e-7, (1e-5, 1e3), 1e-7, 1e11)
    >>> round(float(k) / (1e11 * 1e-1 / 1e3) * 3.141592653589793, 6)  # 8/pi E* (h2/h1)^(1/2)/q1
    8.0
    """
    s, h1, q1, h2, e = _given(depth, long_wave, short_amplitude, modulus)
    return 2 * e / q1 * np.sqrt(h2 / h1) * s * hyp2f1(1 / 2, 1 / 2, 2, s)


@numeric
def flat(
    long_wave: tuple[ArrayLike, ArrayLike], short_amplitude: ArrayLike, modulus: ArrayLike
) -> tuple[Array, Array]:
    """Return force [N] and stiffness [N/m] where the short wave is flat for the first time, at d = 2 h2.

    64/(9 pi) E* h2^(3/2)/(q1 h1^(1/2)) and 8/pi E* (h2/h1)^(1/2)/q1 (thesis, eqs 4.40 and 4.41, corrected).

    Parameters
    ----------
    long_wave : tuple of (float or array)
        Its amplitude h1 [m] and wavenumber q1 [rad/m].
    short_amplitude : float or array
        h2 of the short wave [m].
    modulus : float or array
        Reduced modulus E* [Pa].

    Returns
    -------
    array, array
        Force [N] and stiffness [N/m].

    Examples
    --------
    >>> from roughcontact.theory import two_cosines
    >>> force, stiffness = two_cosines.flat((1e-5, 1e3), 1e-7, 1e11)
    >>> round(float(force), 4), round(float(stiffness) / 1e7, 4)
    (2.2635, 2.5465)
    """
    depth = 2 * positive(short_amplitude, "short_amplitude [m]")
    return (
        force(depth, long_wave, short_amplitude, modulus),
        stiffness(depth, long_wave, short_amplitude, modulus),
    )


@dataclass(frozen=True, slots=True)
class Hierarchy:
    """Waves h_n = h0 C^(-nH), q_n = q0 C^n for n = 0, 1, 2, ... (thesis, eqs 4.42 to 4.44).

    Parameters
    ----------
    amplitude, wavenumber : float
        h0 [m] and q0 [rad/m] of the longest wave.
    ratio : float
        C, above 1; the results are asymptotic in it.
    hurst : float
        H, between 0 and 2.

    Raises
    ------
    ValueError
        If C is not above 1; if H is 0 or less: shorter waves would be as high as longer ones (eq. 4.48); if H is
        2 or more: they would be too flat to matter on the crest of the longer wave (eqs 4.50 and 4.51).

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.theory import two_cosines
    >>> waves = two_cosines.Hierarchy(amplitude=1e-6, wavenumber=1e3, ratio=10.0, hurst=1.0)
    >>> waves.amplitudes(2).round(9).tolist(), waves.wavenumbers(2).round(3).tolist()
    ([1e-06, 1e-07], [1000.0, 10000.0])
    >>> force, stiffness = waves.corners(2, 1e11)
    >>> round(float(np.diff(np.log(stiffness))[0] / np.diff(np.log(force))[0]), 6)  # k ~ F^(1/(H+1))
    0.5
    """

    amplitude: float
    wavenumber: float
    ratio: float
    hurst: float

    def __post_init__(self) -> None:
        require_numbers(self)
        positive(self.amplitude, "amplitude [m]")
        positive(self.wavenumber, "wavenumber [rad/m]")
        require(
            self.ratio > 1,
            f"ratio must exceed 1: each wave is shorter than the one before, not {self.ratio}",
            place="ratio",
        )
        require(
            self.hurst > 0,
            "hurst must exceed 0: shorter waves would be as high as longer ones (eq. 4.48)",
            value=self.hurst,
            place="hurst",
        )
        require(
            self.hurst < 2,
            "hurst must be below 2: shorter waves would be too flat to matter (eqs 4.50, 4.51)",
            value=self.hurst,
            place="hurst",
        )

    def amplitudes(self, count: int) -> Array:
        """Return h_n of the first `count` waves [m] (thesis, eq. 4.44).

        Parameters
        ----------
        count : int
            Number of waves.

        Returns
        -------
        array
            h_n [m], shape (count,).
        """
        order = np.arange(whole(count, "count"), dtype=np.float64)
        return self.amplitude * self.ratio ** (-self.hurst * order)

    def wavenumbers(self, count: int) -> Array:
        """Return q_n of the first `count` waves [rad/m] (thesis, eq. 4.43).

        Parameters
        ----------
        count : int
            Number of waves.

        Returns
        -------
        array
            q_n [rad/m], shape (count,).
        """
        return self.wavenumber * self.ratio ** np.arange(whole(count, "count"), dtype=np.float64)

    def corners(self, count: int, modulus: ArrayLike) -> tuple[Array, Array]:
        """Return force [N] and stiffness [N/m] where wave n + 1 is flat on wave n, for n below `count`.

        Thesis, eqs 4.45 and 4.46, corrected. The points lie on a line of slope 1/(H+1) (eq. 4.47).

        Parameters
        ----------
        count : int
            Number of corners.
        modulus : float or array
            Reduced modulus E* [Pa].

        Returns
        -------
        array, array
            Force [N] and stiffness [N/m], each of shape (count,).
        """
        e, h, q = (
            positive(modulus, "modulus [Pa]"),
            self.amplitudes(whole(count, "count") + 1),
            self.wavenumbers(count),
        )
        scale = e / q * np.sqrt(h[1:] / h[:-1])
        return FLAT_FORCE * scale * h[1:], FLAT_STIFFNESS * scale


def _given(
    depth: ArrayLike, long_wave: tuple[ArrayLike, ArrayLike], short_amplitude: ArrayLike, modulus: ArrayLike
) -> tuple[Array, Array, Array, Array, Array]:
    """Return s = d/(2 h2), h1, q1, h2 and E*."""
    d, h2 = positive(depth, "depth [m]", zero=True), positive(short_amplitude, "short_amplitude [m]")
    h1, q1 = pair(long_wave, "amplitude [m] and wavenumber [rad/m] of the long_wave")
    require(
        d <= 2 * h2,
        "depth must not exceed 2 h2: there the short wave is flat at the crest",
        value=d,
        place="depth",
    )
    require(
        2 * d <= h1,
        "depth must not exceed h1/2: contact would reach q1 |x| = 1, where the long wave is not a parabola",
        value=d,
        place="depth",
    )
    return d / (2 * h2), h1, q1, h2, positive(modulus, "modulus [Pa]")
