"""Persson's theory of hysteretic friction: a rough rigid surface that slides over a viscoelastic half-space.

Each wave of the surface deforms the half-space in the part P of the area that is in contact at its magnification
(Persson, J. Chem. Phys. 115, 3840 (2001)). In contact the deformation is smaller than the roughness: later papers
multiply by S = gamma + (1 - gamma) P^2, gamma about 1/2, which is an estimate. gamma = 1 is the theory of 2001.

Domain: surfaces with isotropic random waves over some decades, far from full contact. The theory contains no finite
size, no adhesion, no shear of the interface and no flash temperature. Computed contacts of surfaces with few waves
differ from both, see docs/concepts/sliding-hysteresis.md.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
import numpy.typing as npt
from scipy.interpolate import CubicSpline
from scipy.special import erf

from roughcontact.theory.random_surfaces.waves import Spectrum, Waves
from roughcontact.theory.tools.quadrature import double_exponential
from roughcontact.validation import Array, numeric, positive_scalar, require

__all__ = ["DynamicModulus", "contact_fraction", "friction_coefficient"]


class DynamicModulus(Protocol):
    """A viscoelastic material; `roughcontact.Viscoelastic` is one.

    Examples
    --------
    >>> import roughcontact as rc
    >>> complex(rc.viscoelastic.standard_solid(1.0, 3.0, 1.0).complex_modulus(1.0))
    (2+1j)
    """

    def complex_modulus(self, angular_frequency: Array, /) -> npt.NDArray[np.complex128]:
        """Return storage + i loss of E* at angular frequencies.

        Parameters
        ----------
        angular_frequency : array
            [rad/s]

        Returns
        -------
        array of complex
            [Pa]
        """


@numeric
def friction_coefficient(
    pressure: float, material: DynamicModulus, spectrum: Spectrum, speed: float, *, gamma: float = 1.0
) -> float:
    """Return the hysteretic friction over the normal force [-].

    Parameters
    ----------
    pressure : float
        Nominal pressure [Pa].
    material : Viscoelastic
        Of the half-space.
    spectrum : Waves, measured or continuous spectrum
        Of the surface, isotropic; see `Waves.of`.
    speed : float
        Sliding speed [m/s].
    gamma : float
        From 0 to 1: the factor S = gamma + (1 - gamma) P^2 of the deformation [-]; 1 in the theory of 2001, about 1/2
        in later papers.

    Returns
    -------
    float

    Raises
    ------
    ValueError
        If pressure or speed is not positive, or gamma is not between 0 and 1.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson_friction
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e8, 1e-3)
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(2e-5)
    >>> [round(persson_friction.friction_coefficient(1e5, rubber, spectrum, 0.01, gamma=g), 3) for g in (1.0, 0.5)]
    [0.698, 0.367]
    """
    require(0 <= gamma <= 1, f"gamma must lie between 0 and 1, not {gamma}", place="gamma")
    waves, cosine, weights, modulus = _driven(material, spectrum, speed)
    part = _fractions(pressure, waves, modulus, weights)[:-1]
    lost = (modulus.imag * cosine) @ weights
    each = waves.power * waves.wavenumber**2 * part * (gamma + (1 - gamma) * part**2)
    return float(each @ lost) / (4 * np.pi * positive_scalar(pressure, "pressure"))


@numeric
def contact_fraction(pressure: float, material: DynamicModulus, spectrum: Spectrum, speed: float) -> float:
    """Return the relative real contact area during sliding [-].

    Parameters
    ----------
    pressure : float
        Nominal pressure [Pa].
    material : Viscoelastic
        Of the half-space.
    spectrum : Waves, measured or continuous spectrum
        Of the surface, isotropic.
    speed : float
        Sliding speed [m/s].

    Returns
    -------
    float

    Raises
    ------
    ValueError
        If pressure or speed is not positive.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson_friction
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e8, 1e-3)
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(2e-5)
    >>> [round(persson_friction.contact_fraction(1e5, rubber, spectrum, v), 4) for v in (1e-9, 0.01)]
    [0.2701, 0.0042]
    """
    waves, _, weights, modulus = _driven(material, spectrum, speed)
    return float(_fractions(pressure, waves, modulus, weights)[-1])


def _driven(
    material: DynamicModulus, spectrum: Spectrum, speed: float
) -> tuple[Waves, Array, Array, npt.NDArray[np.complex128]]:
    """Return waves, the cosines and weights of all directions, and the modulus of each wave in each direction."""
    waves = Waves.of(spectrum)
    nodes, weights = double_exponential()
    cosine = np.sin(np.pi / 2 * nodes)  # a quarter of the circle; from 0 with full relative precision
    frequency = positive_scalar(speed, "speed") * np.multiply.outer(waves.wavenumber, cosine)
    return waves, cosine, 2 * np.pi * weights, material.complex_modulus(frequency)


def _fractions(pressure: float, waves: Waves, modulus: npt.NDArray[np.complex128], weights: Array) -> Array:
    """Return P at each node, and at last that of all waves."""
    squares = np.append(0.0, waves.slope**2)
    density = (np.abs(modulus) ** 2 @ weights) / (16 * np.pi * positive_scalar(pressure, "pressure") ** 2)
    distinct = np.append(True, np.diff(squares) > 0)
    spline = CubicSpline(squares[distinct], np.append(density[:1], density)[distinct])
    spread = spline.antiderivative()(np.append(squares[1:], waves.rms_slope**2))
    return np.asarray(erf(1 / (2 * np.sqrt(np.maximum(spread, 1e-300)))))
