"""What is known of the topography of a joint beforehand, and of its modulus: the prior of its parameters."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact.errors import InputError
from roughcontact.measurement.importance import Prior
from roughcontact.measurement.joint_emulator import BAND, HURST, LEAST_AREA
from roughcontact.validation import positive, require, require_numbers

__all__ = ["PARAMETERS", "JointTopography", "prior_of"]

PARAMETERS = ("rms", "rolloff", "hurst", "band", "modulus", "hardness")  # logarithms of all but the exponent
_RMS = (1e-10, 1e-2)  # m, without a topography
_LARGEST = 1e3  # side of a joint over roll-off wavelength, without a topography
_WIDE = 4  # standard deviations at which a prior ends


@dataclass(frozen=True, slots=True)
class JointTopography:
    """The measured topography of both faces of a joint together, with errors.

    Parameters
    ----------
    rms : float
        Rms height of the sum of both faces [m].
    rms_error : float
        Its relative standard deviation.
    rolloff : float
        Roll-off wavelength [m].
    rolloff_error : float
        Its relative standard deviation.
    hurst, hurst_error : float
        Hurst exponent and its standard deviation.

    Raises
    ------
    ValueError
        If a value is not positive, or the Hurst exponent is outside the emulator's.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.JointTopography(rms=1.2e-6, rms_error=0.1, rolloff=1e-4, rolloff_error=0.3).hurst
    0.8
    """

    rms: float
    rms_error: float
    rolloff: float
    rolloff_error: float
    hurst: float = 0.8
    hurst_error: float = 0.15

    def __post_init__(self) -> None:
        require_numbers(self, rms="m", rolloff="m")
        for name in self.__slots__:
            object.__setattr__(self, name, float(positive(getattr(self, name), name)))
        require(
            HURST[0] <= self.hurst <= HURST[1],
            f"hurst must lie between {HURST[0]} and {HURST[1]}, as of the computed joints, not {self.hurst:g}",
            place="hurst",
        )


def prior_of(
    modulus: tuple[float, float],
    area: float,
    profile: JointTopography | None,
    hardness: tuple[float, float] | None = None,
) -> Prior:
    """Return the prior of `PARAMETERS`; modulus and hardness each with a relative error, None for an elastic joint.

    Without a topography rms height and roll-off wavelength are uniform in their logarithms, the latter up to an
    eighth of the side of the joint. Nothing is known of the band beyond the limits of the emulator.

    Raises
    ------
    ValueError
        If the roll-off wavelength of the topography makes the joint smaller than 64 of its squares.
    """
    longest = math.sqrt(area / LEAST_AREA)
    inf = math.inf
    if profile is None:
        rms = (0.0, inf, *np.log(_RMS))
        rolloff = (0.0, inf, math.log(math.sqrt(area) / _LARGEST), math.log(longest))
        hurst = (0.0, inf, *HURST)
    else:
        if profile.rolloff >= longest:
            raise InputError(
                f"{area:.3g} m^2 are {area / profile.rolloff**2:.2g} squares of the roll-off wavelength, and the "
                f"emulator holds joints from {LEAST_AREA:g} on",
                "give the area of the whole joint, or press the measured map itself: rc.loading_curve",
                "area",
            )
        rms = _log_normal(profile.rms, profile.rms_error)
        low = _log_normal(profile.rolloff, profile.rolloff_error)
        rolloff = (*low[:3], min(low[3], math.log(longest)))
        hurst = (profile.hurst, profile.hurst_error, *HURST)
    band = (0.0, inf, *np.log(BAND))
    rows = [rms, rolloff, hurst, band, _log_normal(*modulus)]
    if hardness is not None:
        rows.append(_log_normal(*hardness))
    return Prior(*np.array(rows, dtype=np.float64).T)


def _log_normal(value: float, error: float) -> tuple[float, float, float, float]:
    """Return mean, standard deviation and limits of the logarithm of a value with a relative error."""
    middle = math.log(value)
    return middle, error, middle - _WIDE * error, middle + _WIDE * error
