r"""The pull-off of hard rough surfaces from their bearing area: Ciavarella's model (BAM).

Meccanica 53, 241 (2018). Heights are Gaussian, of rms h, under a flat at the separation u of the mean planes. The
attraction w/range acts where the undeformed gap is between 0 and the range; the reaction is that of Persson
(Phys. Rev. Lett. 99, 125502 (2007)) at small loads, with the smallest wavenumber q0:

    p(u) = 3/(8 gamma) E* q0 h exp(-u/(gamma h)) - w/range [erfc((u - range)/(sqrt2 h)) - erfc(u/(sqrt2 h))]/2

The largest tension over u is the pull-off. For a range far below h it is positive if

    h^2 < 8 gamma exp(1/(2 gamma^2))/(3 sqrt(2 pi)) w/(E* q0)

which for gamma = 1/2 is 0.63 w/E* times the longest wave. The formulas were not compared with the paper itself.

**Constants.** 3/(8 gamma) and gamma = 1/2 are for a Hurst exponent near 0.8 without roll-off. The energy of
partial contact with ``gamma=0.5`` in `persson_separation.reference_pressure` gives 1.07 E* q0 h there in place of
0.75 (``benchmarks/stickiness.py``): the rms height above is then 0.84 times as large, with the same uncertainty.

**Limits.** The attraction does not change the contact (hard solids, small Tabor number); the attracted area is that of
undeformed surfaces; separations are of the order of h. Short waves have no influence; according to Pastewka and
Robbins they are decisive (`pastewka_robbins`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize_scalar
from scipy.special import erfc

from roughcontact.validation import Array, number, numeric, positive_scalar

__all__ = ["BearingAreaModel"]

HIGHEST = 9.0  # standard deviations: 1e-19 of the heights are larger
SAMPLES = 400  # separations at which the search for the largest tension starts


@dataclass(frozen=True, slots=True)
class BearingAreaModel:
    """A hard rough surface that attracts a flat over the area within the range below it.

    Parameters
    ----------
    rms : float
        Root mean square height h [m].
    wavenumber : float
        Smallest wavenumber of the roughness, q0 [rad/m]: 2 pi over the longest wave.
    modulus : float
        Reduced modulus E* [Pa].
    work : float
        Work of adhesion w [J/m^2].
    range : float
        Largest gap of the attraction w/range [m].
    gamma : float
        Decay length of the reaction over h [-].

    Raises
    ------
    ValueError
        If a number is not positive and finite.

    Examples
    --------
    >>> import math
    >>> from roughcontact.theory import bearing_area_model
    >>> for rms in (1e-9, 1e-8, 3e-8):
    ...     pad = bearing_area_model.BearingAreaModel(rms, 2 * math.pi / 1e-6, modulus=1e8, work=0.05, range=2e-9)
    ...     print(f"{pad.pull_off_pressure / 1e6:.3g} MPa, sticks below {pad.sticking_rms * 1e9:.0f} nm")
    17 MPa, sticks below 18 nm
    0.693 MPa, sticks below 18 nm
    0 MPa, sticks below 18 nm
    """

    rms: float
    wavenumber: float
    modulus: float
    work: float
    range: float
    gamma: float = 0.5

    def __post_init__(self) -> None:
        for name in ("rms", "wavenumber", "modulus", "work", "range", "gamma"):
            positive_scalar(getattr(self, name), f"the {name}")

    @numeric
    def attracted_fraction(self, separation: npt.ArrayLike) -> Array:
        """Return the attracted area over the nominal area.

        Parameters
        ----------
        separation : float or array
            Of the mean planes, u [m].

        Returns
        -------
        float or array
            A_att/A0.

        Examples
        --------
        >>> from roughcontact.theory import bearing_area_model
        >>> pad = bearing_area_model.BearingAreaModel(1e-8, 6e6, modulus=1e8, work=0.05, range=2e-9)
        >>> [round(float(share), 3) for share in pad.attracted_fraction([0.0, 1e-8, 3e-8])]
        [0.079, 0.053, 0.001]
        """
        u = np.asarray(number(separation, "separation [m]"))
        width = math.sqrt(2) * self.rms
        return np.asarray(0.5 * (erfc((u - self.range) / width) - erfc(u / width)))

    @numeric
    def pressure(self, separation: npt.ArrayLike) -> Array:
        """Return the mean pressure at a separation, tension negative.

        Parameters
        ----------
        separation : float or array
            Of the mean planes, u [m].

        Returns
        -------
        float or array
            p [Pa].

        Examples
        --------
        >>> from roughcontact.theory import bearing_area_model
        >>> pad = bearing_area_model.BearingAreaModel(1e-8, 6e6, modulus=1e8, work=0.05, range=2e-9)
        >>> [f"{float(p) / 1e6:.2f} MPa" for p in pad.pressure([0.0, 1e-8, 2e-8])]
        ['2.52 MPa', '-0.72 MPa', '-0.25 MPa']
        """
        u = np.asarray(number(separation, "separation [m]"))
        reaction = self._stiffness * self.rms * np.exp(-u / (self.gamma * self.rms))
        return np.asarray(reaction - self.work / self.range * self.attracted_fraction(u))

    @property
    def pull_off_pressure(self) -> float:
        """Largest mean tension [Pa], positive: zero if there is none."""
        reach = self.range + HIGHEST * self.rms
        separations = np.linspace(0.0, reach, SAMPLES)
        k = int(np.argmin(self.pressure(separations)))
        ends = separations[max(k - 1, 0)], separations[min(k + 1, SAMPLES - 1)]
        found = minimize_scalar(
            lambda u: float(self.pressure(u)), bounds=ends, method="bounded", options={"xatol": 1e-9 * reach}
        )
        return max(0.0, -float(found.fun))

    @property
    def sticking_rms(self) -> float:
        """Rms height [m] below which there is a pull-off force, if the range is far below it."""
        peak = math.exp(0.5 / self.gamma**2) / math.sqrt(2 * math.pi)
        return math.sqrt(peak * self.work / self._stiffness)

    @property
    def _stiffness(self) -> float:
        """Factor of the reaction: its pressure at separation zero over the rms height [Pa/m]."""
        return 3 / (8 * self.gamma) * self.modulus * self.wavenumber
