"""Plane longitudinal waves at a layer of springs: impedance and speed in the bodies, reflection and transmission.

The equations are those of `roughcontact.theory.ultrasound`.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from roughcontact.theory.joints.conductance import Pair
from roughcontact.validation import Array, numeric, pair, positive, require

__all__ = ["impedance", "reflection", "speed", "transmission"]


@numeric
def impedance(modulus: float, poisson_ratio: float, density: float) -> float:
    """Return the acoustic impedance of longitudinal waves [Pa s/m].

    Parameters
    ----------
    modulus, poisson_ratio : float
        Young's modulus [Pa] and Poisson's ratio, below 1/2 [-].
    density : float
        Density [kg/m^3].

    Returns
    -------
    float
        Density times speed of sound [Pa s/m].

    Examples
    --------
    >>> from roughcontact.theory import ultrasound
    >>> f"{ultrasound.impedance(206e9, 0.3, 7850):.3g}"
    '4.67e+07'
    """
    return density * speed(modulus, poisson_ratio, density)


@numeric
def speed(modulus: float, poisson_ratio: float, density: float) -> float:
    """Return the speed of longitudinal waves [m/s].

    Parameters
    ----------
    modulus, poisson_ratio : float
        Young's modulus [Pa] and Poisson's ratio, below 1/2 [-].
    density : float
        Density [kg/m^3].

    Returns
    -------
    float
        ``sqrt(E (1 - nu)/(density (1 + nu)(1 - 2 nu)))`` [m/s].

    Examples
    --------
    >>> from roughcontact.theory import ultrasound
    >>> f"{ultrasound.speed(206e9, 0.3, 7850):.0f} m/s"
    '5944 m/s'
    """
    message = f"poisson_ratio must be above -1 and below 0.5, not {poisson_ratio}"
    require(-1 < poisson_ratio < 0.5, message, place="poisson_ratio")
    stretch = (1 - poisson_ratio) / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))
    return math.sqrt(float(positive(modulus, "modulus") / positive(density, "density")) * stretch)


@numeric
def reflection(
    stiffness: float | Array, frequency: float | Array, impedances: Pair, mass: float = 0.0
) -> Array:
    """Return the reflection r of a joint, a complex amplitude of displacement.

    Parameters
    ----------
    stiffness, frequency : float or array
        K/A0 [Pa/m] and frequency [Hz].
    impedances : tuple of float
        Acoustic impedances of the body of the incident wave and of the other [Pa s/m], see `impedance`.
    mass : float
        Mass per area that moves with the mean of both surfaces [kg/m^2]; 0 for a dry joint.

    Returns
    -------
    complex array
        r [-]; its size is the measured reflection, and -r that of stress.

    Examples
    --------
    >>> from roughcontact.theory import ultrasound
    >>> r = ultrasound.reflection([2.51e13, 2.255e14], 5e6, (46.2e6, 46.2e6))  # a steel joint at 10 and 100 MPa
    >>> abs(r).round(5).tolist()
    [0.9994, 0.95496]
    """
    spring, inertia, first, second = _terms(stiffness, frequency, impedances, mass)
    difference = (first - second) * (1 + spring * inertia)
    return np.asarray(
        (difference + 2 * spring * first * second - 2 * inertia)
        / _denominator(spring, inertia, first, second)
    )


@numeric
def transmission(
    stiffness: float | Array, frequency: float | Array, impedances: Pair, mass: float = 0.0
) -> Array:
    """Return the transmission t of a joint, a complex amplitude of displacement.

    Parameters
    ----------
    stiffness, frequency : float or array
        K/A0 [Pa/m] and frequency [Hz].
    impedances : tuple of float
        Acoustic impedances of the body of the incident wave and of the other [Pa s/m].
    mass : float
        Mass per area between the surfaces [kg/m^2].

    Returns
    -------
    complex array
        t [-]; the transmitted part of the power is ``z2/z1 |t|^2``, the rest of ``|r|^2``.

    Examples
    --------
    >>> from roughcontact.theory import ultrasound
    >>> t = ultrasound.transmission(2.51e13, 1.2e5, (46.2e6, 46.2e6))
    >>> f"{abs(t):.3f}"
    '0.822'
    """
    spring, inertia, first, second = _terms(stiffness, frequency, impedances, mass)
    return np.asarray(2 * first * (1 - spring * inertia) / _denominator(spring, inertia, first, second))


def _terms(
    stiffness: float | Array, frequency: float | Array, impedances: Pair, mass: float
) -> tuple[Any, Any, Array, Array]:
    """Return ``i w/(2 K)``, ``i w m/2``, and both impedances."""
    half = 0.5j * (2 * math.pi) * positive(frequency, "frequency")
    spring = half / positive(stiffness, "stiffness")
    return spring, half * positive(mass, "mass", zero=True), *pair(impedances, "impedances")


def _denominator(spring: Any, inertia: Any, first: Array, second: Array) -> Any:
    return (first + second) * (1 + spring * inertia) + 2 * spring * first * second + 2 * inertia
