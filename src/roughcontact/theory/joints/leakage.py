"""Flow through a joint by theory: Bruggeman's effective medium, and Persson's critical constriction.

A cell of gap g has the conductance g^3 in its surroundings, the effective medium (Bruggeman, Ann. Phys. 416, 636
(1935)). The theory uses the distribution of the gaps and not their places. Its open cells cease to percolate where half
of the area is closed; Dapp and others (Phys. Rev. Lett. 108, 244301 (2012)) moved this threshold.

Persson and Yang (J. Phys.: Condens. Matter 20, 315011 (2008), arXiv:0805.0699) let one constriction take the whole
drop: the one at the magnification at which the open area just percolates. Both are heuristic.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy.optimize
from scipy.special import erfinv

from roughcontact.errors import about
from roughcontact.theory.persson_theory.persson import contact_fraction
from roughcontact.theory.persson_theory.persson_separation import GAMMA, mean_gap
from roughcontact.theory.random_surfaces.waves import Spectrum, Waves
from roughcontact.validation import Array, numeric, positive, require

__all__ = ["CriticalConstriction", "bruggeman", "critical_constriction"]

THRESHOLD = 0.5  # closed part of the area at which two-dimensional effective media stop to conduct
PERCOLATION = (
    0.4  # relative contact area at which an open path closes in Persson and Yang's computed contacts
)
STEP = 1e-3  # relative difference of areas of a derivative


@numeric
def bruggeman(conductances: Array, threshold: float = THRESHOLD) -> float:
    """Return the conductance of an effective medium.

    It is the solution kappa of ``mean((m - kappa)/(m + s kappa)) = 0`` with ``s = threshold/(1 - threshold)``. Against
    flows through six pressed random surfaces it was 9 % too high at A/A0 = 0.05, 16 % at 0.17 and 50 % at 0.28.

    Parameters
    ----------
    conductances : array
        Conductances m of cells of equal size, such as their cubed gaps [m^3]; 0 where closed.
    threshold : float
        Closed part of the area from which nothing flows, above 0 and below 1.

    Returns
    -------
    float
        Conductance of the medium, in the unit of `conductances`; 0 if the closed part reaches the threshold.

    Raises
    ------
    ValueError
        If a conductance is negative or the threshold is out of range.

    Examples
    --------
    >>> from roughcontact.theory import leakage
    >>> round(leakage.bruggeman([1.0, 4.0]), 12)  # of two kinds of equal area: the geometric mean
    2.0
    """
    m = positive(conductances, "the conductances", zero=True).ravel()
    if not 0 < threshold < 1:
        raise about("threshold", f"must lie between 0 and 1, not at {threshold}")
    require(m.size > 0, "there are no conductances", place="conductances")
    largest = float(m.max())
    if np.mean(m == 0) >= threshold:
        return 0.0
    s, m = threshold / (1 - threshold), m / largest

    def excess(kappa: float) -> float:
        return float(np.mean((m - kappa) / (m + s * kappa)))

    lowest = np.finfo(float).tiny
    if excess(lowest) <= 0:
        return 0.0
    # In the logarithm, because the conductance falls by decades near the threshold.
    root = scipy.optimize.brentq(
        lambda x: excess(float(np.exp(x))), np.log(lowest), 0.0, xtol=1e-13, rtol=1e-14
    )
    return largest * float(np.exp(root))


@dataclass(frozen=True, slots=True)
class CriticalConstriction:
    """The constriction that takes the whole drop in Persson's theory.

    Attributes
    ----------
    wavenumber : float
        Shortest waves of the surface that the magnification resolves [rad/m]; the constriction is ``2 pi/q`` wide and
        long.
    gap : float
        Its gap u1 [m].

    Examples
    --------
    >>> from roughcontact.theory import leakage
    >>> leakage.CriticalConstriction(1e5, 1e-7).transmissivity
    1e-21
    """

    wavenumber: float
    gap: float

    @property
    def transmissivity(self) -> float:
        """Cubed gap of a square constriction [m^3], to compare with that of `roughcontact.gap_flow`."""
        return self.gap**3


@numeric
def critical_constriction(
    pressure: float,
    modulus: float,
    spectrum: Spectrum,
    *,
    threshold: float = PERCOLATION,
    gamma: float = GAMMA,
) -> CriticalConstriction | None:
    """Return the critical constriction of a nominally flat, isotropic surface; None if no open path is left.

    Persson's theory gives the contact fraction A(q) with the waves up to q, see `persson`. The area in contact at q is
    pressed by ``p/A(q)`` on the waves beyond q: its mean gap u(q) is that of `persson_separation.mean_gap`. The area
    that opens with the next wave has the gap ``u1 = u + A du/dA``. At the critical q, A is `threshold`.

    Parameters
    ----------
    pressure : float
        Nominal pressure p [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    spectrum : Waves, measured or continuous spectrum
        See `Waves.of`.
    threshold : float
        Relative contact area at which a path closes, above 0 and below 1; see `roughcontact.sealing_load`.
    gamma : float
        See `persson_separation`.

    Returns
    -------
    CriticalConstriction or None

    Raises
    ------
    ValueError
        If a number is out of range, or the spectrum has no limits.

    Notes
    -----
    Heuristic, for many waves between the longest and the critical one: the square, the threshold and gamma are not
    derived. docs/concepts/gap-flow.md compares it with computed flows.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import leakage
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> place = leakage.critical_constriction(1e8, 1e11, spectrum)
    >>> f"{1e6 * 2 * 3.14159 / place.wavenumber:.0f} um wide, gap {1e9 * place.gap:.0f} nm"
    '802 um wide, gap 939 nm'
    >>> leakage.critical_constriction(5e9, 1e11, spectrum) is None  # closed
    True
    """
    p = float(positive(pressure, "the pressure [Pa]"))
    if not 0 < threshold < 1:
        raise about("threshold", f"must lie between 0 and 1, not at {threshold}")
    waves = Waves.of(spectrum)
    if contact_fraction(p, modulus, waves) >= threshold:
        return None

    def slope(area: float) -> float:
        """Return the slope of the waves that leave this fraction in contact: `contact_fraction` inverted."""
        return math.sqrt(2) * p / (modulus * float(erfinv(area)))

    def volume(area: float) -> float:
        """Return the volume of the gap within this fraction, per nominal area [m]."""
        rest = waves.slope**2 - slope(area) ** 2
        kept = rest > 0
        if not kept.any():
            return 0.0
        shorter = Waves(waves.wavenumber[kept], waves.power[kept], np.sqrt(rest[kept]))
        return area * float(mean_gap(p / area, modulus, shorter, gamma=gamma))

    more, less = (threshold * (1 + sign * STEP) for sign in (1, -1))
    wavenumber = float(np.interp(slope(threshold), waves.slope, waves.wavenumber))
    return CriticalConstriction(wavenumber, (volume(more) - volume(less)) / (more - less))
