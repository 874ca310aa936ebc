"""Reflection of ultrasound at a joint, and the stiffness of a joint from a measured reflection.

To a wave that is long beside the distance of the spots, a joint is a layer of springs, K/A0 per area. A normal, plane,
longitudinal wave of angular frequency w is partly reflected by it (Kendall and Tabor, Proc. R. Soc. A 323, 321 (1971);
Baik and Thompson, J. Nondestr. Eval. 4, 177 (1984)). With z = density times speed of sound, and displacements that
depend on time as ``exp(i w t)``,

    r = (z1 - z2 + i w z1 z2/K)/(z1 + z2 + i w z1 z2/K)        t = 2 z1/(z1 + z2 + i w z1 z2/K)

The model has these limits:

* The wavelength is much longer than the distance of the spots, or they scatter. K/A0 at two frequencies is then the
  same, see `combined`.
* The beam is at least ten times as wide as the longest waves of the roughness. A reflection averaged over a beam is not
  that of the averaged stiffness where the stiffness varies over larger distances.
* The attenuation in the bodies is removed, by a reference reflection of an open surface.
* The wave moves the surfaces by so little that nothing flows: under a hardness its stiffness is that of unloading,
  ``solution.flattened.interfacial_stiffness_per_area``.
* A fluid in the gap adds its bulk modulus over the mean gap to K/A0.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.special import chdtrc

from roughcontact.errors import InputError
from roughcontact.theory.joints.conductance import Pair
from roughcontact.theory.joints.plane_waves import impedance, reflection, speed, transmission
from roughcontact.validation import Array, numeric, pair, positive, require

__all__ = [
    "LARGEST_AMPLIFICATION",
    "SecondHarmonic",
    "amplification",
    "best_frequency",
    "combined",
    "expected_amplification",
    "impedance",
    "reflection",
    "second_harmonic",
    "speed",
    "stiffness_from_reflection",
    "transmission",
]

LARGEST_AMPLIFICATION = 20.0  # of the relative error of a reflection, up to which a stiffness is inferred
UNLIKELY = 0.01  # chance of larger differences, below which two frequencies disagree
WEAK = 0.1  # largest relative change of the stiffness during a wave, for its second harmonic


class SecondHarmonic(NamedTuple):
    """The second harmonic of a wave at a joint.

    Attributes
    ----------
    reflected, transmitted, opening : array
        Amplitudes in the body of the incident wave and in the other, and mean opening of the joint [m].

    Examples
    --------
    >>> from roughcontact.theory import ultrasound
    >>> ultrasound.second_harmonic(1e-9, 2.255e14, 0.0, 5e6, (46.2e6, 46.2e6)).opening.item()  # a linear spring
    0.0
    """

    reflected: Array
    transmitted: Array
    opening: Array


@numeric
def amplification(reflected: float | Array, impedances: Pair) -> Array:
    """Return by which factor the stiffness is less certain than the reflection it is inferred from.

    Parameters
    ----------
    reflected : float or array
        Size of the reflection, below 1 and above that of a stiff joint, ``|z1 - z2|/(z1 + z2)``.
    impedances : tuple of float
        Acoustic impedances of both bodies [Pa s/m].

    Returns
    -------
    array
        Relative error of K/A0 over that of the reflection [-].

    Raises
    ------
    ValueError
        If no stiffness reflects this.

    Examples
    --------
    >>> from roughcontact.theory import ultrasound
    >>> ultrasound.amplification([0.99940, 0.95496, 3**-0.5], (46.2e6, 46.2e6)).round(1).tolist()
    [833.6, 11.4, 1.5]
    """
    square, least = _squares(reflected, impedances)
    return np.asarray(square * (1 - least) / ((1 - square) * (square - least)))


@numeric
def expected_amplification(stiffness: float | Array, frequency: float | Array, impedances: Pair) -> Array:
    """Return by which factor an inferred stiffness will be less certain than the reflection, before it is measured.

    Parameters
    ----------
    stiffness, frequency : float or array
        Expected K/A0 [Pa/m] and frequency [Hz].
    impedances : tuple of float
        Acoustic impedances of both bodies [Pa s/m].

    Returns
    -------
    array
        `amplification` of the size of the reflection that is expected [-].

    Examples
    --------
    >>> from roughcontact.theory import ultrasound
    >>> ultrasound.expected_amplification([2.51e13, 2.255e14], 5e6, (46.2e6, 46.2e6)).round(1).tolist()
    [836.9, 11.4]
    """
    first, second = pair(impedances, "impedances")
    least = ((first - second) / (first + second)) ** 2
    # The square of the reflection is (least + ratio)/(1 + ratio): a small 1 - |r|^2 must not be a difference.
    angular = 2 * math.pi * positive(frequency, "frequency")
    ratio = (angular / positive(stiffness, "stiffness") / (1 / first + 1 / second)) ** 2
    return np.asarray((1 + ratio) * (least / ratio + 1) / (1 - least))


@numeric
def best_frequency(stiffness: float | Array, impedances: Pair) -> Array:
    """Return the frequency at which an error of the reflection changes the stiffness least [Hz].

    For like bodies it is ``sqrt(2) K/(2 pi z)``, where the reflection is ``1/sqrt(3)``.

    Parameters
    ----------
    stiffness : float or array
        Expected K/A0 [Pa/m].
    impedances : tuple of float
        Acoustic impedances of both bodies [Pa s/m].

    Returns
    -------
    array
        Frequency [Hz].

    Examples
    --------
    >>> from roughcontact.theory import ultrasound
    >>> (ultrasound.best_frequency([2.51e13, 2.255e14], (46.2e6, 46.2e6)) / 1e6).round(2).tolist()
    [0.12, 1.1]
    """
    first, second = pair(impedances, "impedances")
    least = ((first - second) / (first + second)) ** 2
    square = (1 + least + np.sqrt((1 + least) ** 2 + 12 * least)) / 6  # least of dlnK/d|r|, by its derivative
    angular = positive(stiffness, "stiffness") * (1 / first + 1 / second)
    return np.asarray(angular * np.sqrt((square - least) / (1 - square)) / (2 * math.pi))


@numeric
def stiffness_from_reflection(
    reflected: float | Array, frequency: float | Array, impedances: Pair, error: float | Array = 0.0
) -> tuple[Array, Array]:
    """Return the stiffness K/A0 of a joint by its measured reflection, with its error [Pa/m].

    Parameters
    ----------
    reflected, frequency : float or array
        Size of the reflection [-] and frequency [Hz].
    impedances : tuple of float
        Acoustic impedances of both bodies [Pa s/m].
    error : float or array
        Standard error of the reflection [-].

    Returns
    -------
    tuple of array
        K/A0 and its standard error [Pa/m].

    Raises
    ------
    ValueError
        If no stiffness reflects this, or if the relative error of the stiffness is more than 20 times that of the
        reflection.

    Examples
    --------
    >>> from roughcontact.theory import ultrasound
    >>> k, error = ultrasound.stiffness_from_reflection(0.955, 5e6, (46.2e6, 46.2e6), error=0.002)
    >>> f"{k / 1e12:.0f} +- {error / 1e12:.0f} N/um/mm^2"
    '225 +- 5 N/um/mm^2'
    """
    square, least = _squares(reflected, impedances)
    first, second = pair(impedances, "impedances")
    angular = 2 * math.pi * positive(frequency, "frequency")
    stiffness = np.asarray(angular / (1 / first + 1 / second) * np.sqrt((1 - square) / (square - least)))
    factor = np.broadcast_to(amplification(reflected, impedances), stiffness.shape)
    if (worst := factor.max()) > LARGEST_AMPLIFICATION:
        better = best_frequency(stiffness.flat[factor.argmax()], impedances)
        raise InputError(
            f"the stiffness is {worst:.0f} times less certain than the reflection, "
            f"and up to {LARGEST_AMPLIFICATION:.0f} times are allowed",
            f"measure at about {better / 1e6:.2g} MHz",
            "reflected",
        )
    return stiffness, np.asarray(stiffness * factor * positive(error, "error", zero=True) / np.sqrt(square))


@numeric
def combined(stiffness: Array, error: Array) -> tuple[Array, Array]:
    """Return one stiffness of a joint from those at several frequencies, with its error.

    Parameters
    ----------
    stiffness, error : array, shape (..., n)
        K/A0 at n frequencies and its standard errors [Pa/m].

    Returns
    -------
    tuple of array, shape (...)
        Weighted mean and its standard error [Pa/m].

    Raises
    ------
    ValueError
        If there is only one frequency, or if the differences are so large beside the errors that chance exceeds them
        in 1 % of measurements.

    Examples
    --------
    >>> from roughcontact.theory import ultrasound
    >>> k, error = ultrasound.combined([225e12, 231e12], [5e12, 4e12])
    >>> f"{k / 1e12:.1f} +- {error / 1e12:.1f}"
    '228.7 +- 3.1'
    """
    values, errors = np.broadcast_arrays(positive(stiffness, "stiffness"), positive(error, "error"))
    require(values.ndim and values.shape[-1] > 1, "one frequency cannot be compared", place="stiffness")
    weights = errors**-2.0 / np.sum(errors**-2.0, axis=-1, keepdims=True)
    mean = np.sum(weights * values, axis=-1)
    misfit = np.sum(((values - mean[..., None]) / errors) ** 2, axis=-1)
    require(
        chdtrc(values.shape[-1] - 1, misfit) >= UNLIKELY,
        "the frequencies give different stiffnesses",
        "use lower frequencies, and remove the attenuation by a reference reflection",
        place="stiffness",
    )
    return np.asarray(mean), np.asarray(np.sum(errors**-2.0, axis=-1) ** -0.5)


@numeric
def second_harmonic(
    amplitude: float | Array,
    stiffness: float | Array,
    slope: float | Array,
    frequency: float | Array,
    impedances: Pair,
) -> SecondHarmonic:
    """Return the second harmonic that a joint makes of a wave, because K/A0 depends on the pressure.

    Bodies make a second harmonic too: measure it without the joint.

    Parameters
    ----------
    amplitude, stiffness : float or array
        Displacement of the incident wave [m], and K/A0 [Pa/m].
    slope : float or array
        Derivative of K/A0 by the nominal pressure [1/m]. Take it from points of a curve whose pressures differ by 20 %
        or more; for ``K ~ p^a`` it is ``a K/p``.
    frequency : float or array
        Frequency of the incident wave [Hz].
    impedances : tuple of float
        Acoustic impedances of the body of the incident wave and of the other [Pa s/m].

    Returns
    -------
    SecondHarmonic
        Amplitudes in both bodies and the mean opening [m].

    Raises
    ------
    ValueError
        If the stiffness changes by more than 10 % during the wave, where the series ends.

    Examples
    --------
    >>> from roughcontact.theory import ultrasound
    >>> wave = ultrasound.second_harmonic(1e-9, 2.255e14, 2e6, 5e6, (46.2e6, 46.2e6))
    >>> f"{wave.transmitted * 1e12:.3f} pm"
    '0.140 pm'
    """
    first, second = pair(impedances, "impedances")
    k, angular = positive(stiffness, "stiffness"), 2 * math.pi * positive(frequency, "frequency")
    rate = positive(slope, "slope", zero=True)
    through = np.abs(transmission(stiffness, frequency, impedances))
    closing = angular * second * through * positive(amplitude, "amplitude") / k
    require(
        rate * closing <= WEAK,
        f"the stiffness changes by more than {WEAK:.0%} during the wave",
        "give a smaller amplitude",
        place="amplitude",
    )
    force = rate * k * closing**2 / 4
    damped = np.abs(1 + k * (1 / first + 1 / second) / (2j * angular))
    in_first, in_second = (np.asarray(force / (2 * angular * z * damped)) for z in (first, second))
    return SecondHarmonic(in_first, in_second, np.asarray(rate * closing**2 / 4))


def _squares(reflected: float | Array, impedances: Pair) -> tuple[Array, Array]:
    """Return the squares of a reflection and of that of a stiff joint."""
    size, (first, second) = positive(reflected, "reflected"), pair(impedances, "impedances")
    least = np.abs(first - second) / (first + second)
    require(
        (size > least) & (size < 1),
        f"no stiffness reflects this: |r| must be above {np.max(least):.4g}, that of a stiff joint, and below 1",
        "correct the reference reflection or the impedances",
        place="reflected",
        value=size,
    )
    return size**2, least**2
