"""The amplitude parameters that surfaces and profiles share."""

from __future__ import annotations

import numpy as np

from roughcontact.validation import Array

__all__ = ["amplitudes"]


def amplitudes(heights: Array) -> tuple[float, float, float, float]:
    """Return arithmetic mean deviation, rms, skewness and kurtosis of `heights` about their mean, which is zero."""
    rms = float(np.sqrt(np.mean(heights**2)))
    scaled = heights / rms
    return (
        float(np.mean(np.abs(heights))),
        rms,
        float(np.mean(scaled**3)),
        float(np.mean(scaled**4)),
    )
