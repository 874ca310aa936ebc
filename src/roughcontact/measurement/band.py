"""The wavelengths that a map holds reliably."""

from __future__ import annotations

import math

import numpy as np

from roughcontact.measurement.bins import binned
from roughcontact.measurement.instrument import Instrument
from roughcontact.measurement.signal import Signal
from roughcontact.measurement.tip_image import tip_limit
from roughcontact.surface.surface import Surface

__all__ = ["PER_DECADE", "bin_centres", "reliable_band"]

PER_DECADE = 10  # bins to a factor of ten in wavenumber
_CELLS = 4.0  # in the shortest wave


def bin_centres(least: float, most: float) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """Return the centres of all bins that hold wavenumbers between two [rad/m]: the same ones for all maps."""
    first, last = (math.floor(PER_DECADE * math.log10(q) + 1e-9) for q in (least, most))
    return np.asarray(10 ** ((np.arange(first, max(last, first + 1) + 1) + 0.5) / PER_DECADE))


def reliable_band(
    surface: Surface, signal: Signal, instrument: Instrument
) -> tuple[tuple[float, float], str]:
    """Return the shortest and the longest reliable wavelength [m], and what limits the shortest.

    The limits are four cells, the resolution, twice the lag at which summits are as sharp as the tip, and the first bin
    in which noise exceeds the signal. The longest wave is a third of a free map. Rows of a map hold waves in all
    directions, whose blur is not that of their own wavelength: there the limit is twice the resolution.
    """
    across = surface.grid.ndim == 2 and signal.spectrum.kind == "C1D"
    shortest = {
        "cells": _CELLS * max(surface.grid.spacing),
        "resolution": (2 if across else 1) * (instrument.resolution or 0.0),
        "tip": tip_limit(surface, instrument.tip_radius),
        "noise": 0.0,
    }
    longest = 2 * math.pi / signal.spectrum.q_min
    reached = max(shortest.values())
    if signal.noise.any() and reached < longest:
        centres = bin_centres(signal.spectrum.q_min, 2 * math.pi / reached)
        ratio = binned([signal], [(reached, longest)], centres, np.zeros(centres.size)).ratio[0]
        if (lost := np.flatnonzero(ratio >= 1)).size:
            shortest["noise"] = 2 * math.pi / (centres[lost[0]] * 10 ** (-0.5 / PER_DECADE))
    limit = max(shortest, key=lambda name: shortest[name])
    return (shortest[limit], longest), limit
