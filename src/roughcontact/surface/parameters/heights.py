"""The amplitude parameters that surfaces and profiles share."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughcontact.validation import Array

__all__ = ["Amplitudes", "amplitudes"]


@dataclass(frozen=True, slots=True)
class Amplitudes:
    """Moments of heights about their mean: arithmetic [m], root mean square [m], skewness and kurtosis [-]."""

    arithmetic: float
    rms: float
    skewness: float
    kurtosis: float


def amplitudes(heights: Array) -> Amplitudes:
    """Return the moments of `heights`, which have zero mean and are not all equal."""
    rms = float(np.sqrt(np.mean(heights**2)))
    scaled = heights / rms
    return Amplitudes(
        arithmetic=float(np.mean(np.abs(heights))),
        rms=rms,
        skewness=float(np.mean(scaled**3)),
        kurtosis=float(np.mean(scaled**4)),
    )
