r"""An adhesive wave on a flat, in plane strain (Johnson, Int. J. Solids Struct. 32, 423 (1995)).

The limit of Johnson, Kendall and Roberts: an attraction of no range. Westergaard's contact of half width a, less the
tension that opens the cracks beside it, whose stress intensity is that of w:

    s = sin^2(pi a/L)
    p = (pi E* D/L) s - T             T = sqrt(2 E* w tan(pi a/L)/L)
    d = D (s - s ln s) - C T          C = -(L/(pi E*)) ln s

with the amplitude D, the wavelength L, and the compliance C of the contact. In full contact there is no crack, and a
wave without a flaw would never detach.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.validation import Array, number, numeric, positive_scalar, require

__all__ = ["AdhesiveWave"]


@dataclass(frozen=True, slots=True)
class AdhesiveWave:
    """An adhesive wave of heights ``D cos(2 pi x/L)`` on a flat.

    Parameters
    ----------
    amplitude : float
        D [m].
    wavelength : float
        L [m].
    modulus : float
        Reduced modulus E* [Pa].
    work : float
        Work of adhesion w [J/m^2].

    Raises
    ------
    ValueError
        If a number is not positive and finite.

    Examples
    --------
    >>> from roughcontact.theory import adhesive_wave
    >>> wave = adhesive_wave.AdhesiveWave(amplitude=1e-7, wavelength=1e-5, modulus=1e9, work=0.05)
    >>> f"alpha {wave.number:.3f}, at half contact {float(wave.mean_pressure(2.5e-6)) / 1e6:.2f} MPa"
    'alpha 0.101, at half contact 12.55 MPa'
    >>> f"{float(wave.depth(2.5e-6)) * 1e9:.1f} nm deep"
    '77.7 nm deep'
    """

    amplitude: float
    wavelength: float
    modulus: float
    work: float

    def __post_init__(self) -> None:
        for name in ("amplitude", "wavelength", "modulus", "work"):
            positive_scalar(getattr(self, name), f"the {name}")

    @property
    def full_pressure(self) -> float:
        """Mean pressure of full contact without adhesion, ``pi E* D/L`` [Pa]."""
        return math.pi * self.modulus * self.amplitude / self.wavelength

    @property
    def number(self) -> float:
        """Johnson's alpha, ``sqrt(2 E* w/L)`` over the pressure of full contact."""
        return math.sqrt(2 * self.modulus * self.work / self.wavelength) / self.full_pressure

    @numeric
    def mean_pressure(self, half_width: npt.ArrayLike) -> Array:
        """Return the mean pressure of the equilibrium with a contact of half width a, tension negative.

        Parameters
        ----------
        half_width : float or array
            a [m], between 0 and half a wavelength.

        Returns
        -------
        float or array
            p [Pa].
        """
        sine, tension = self._contact(half_width)
        return np.asarray(self.full_pressure * sine - tension)

    @numeric
    def depth(self, half_width: npt.ArrayLike) -> Array:
        """Return the indentation depth of the equilibrium with a contact of half width a.

        Parameters
        ----------
        half_width : float or array
            a [m], between 0 and half a wavelength.

        Returns
        -------
        float or array
            d [m], from first touch; the mean displacement is zero.
        """
        sine, tension = self._contact(half_width)
        compliance = -self.wavelength / (math.pi * self.modulus) * np.log(sine)
        return np.asarray(self.amplitude * (sine - sine * np.log(sine)) - compliance * tension)

    def _contact(self, half_width: npt.ArrayLike) -> tuple[Array, Array]:
        """Return sin^2(pi a/L) and the tension T [Pa]."""
        a = np.asarray(number(half_width, "half width [m]"))
        inside = (a > 0) & (2 * a < self.wavelength)
        require(inside, "the half width must lie between 0 and half a wavelength [m]", value=a)
        phase = math.pi * a / self.wavelength
        tension = np.sqrt(2 * self.modulus * self.work * np.tan(phase) / self.wavelength)
        return np.asarray(np.sin(phase) ** 2), np.asarray(tension)
