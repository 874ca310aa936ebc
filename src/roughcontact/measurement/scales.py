"""The waves on which a number of a contact rests, beside those that a spectrum holds."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from roughcontact.measurement.combined_spectrum import CombinedSpectrum
from roughcontact.validation import Array

__all__ = ["Scales", "band_nodes", "scales_of"]

FINEST = 8  # K/A0 depends on waves from the roll-off l to l/8, on shorter ones by a few per cent
HIDDEN = 0.05  # of the mean square height, 2.5 % of the rms height, that may lie in waves beyond the band


class Scales(NamedTuple):
    """The scales of a surface of a given size in the band of a spectrum."""

    longest: float
    """The longest wave, of the band or of the surface [m]."""
    shortest: float
    """The shortest wave of the band, l_c [m]."""
    rolloff: float
    """The wave l at which q^2 C(q) is largest [m]."""
    hidden: float
    """Mean square height of the longer waves over that of the band, if the spectrum is flat beyond it."""

    def rests_on(self, name: str) -> str:
        """Return the waves on which a number rests."""
        if name == "contact_fraction":
            return f"waves down to l_c = {self.shortest:.3g} m: with shorter ones the area is smaller"
        end = self.rolloff / FINEST if name == "interfacial_stiffness_per_area" else self.shortest
        return f"waves from {self.longest:.3g} m to {end:.3g} m"

    def lacking(self, name: str) -> str | None:
        """Return which waves a number needs beyond the band, and what to measure; None if it needs none."""
        if name == "contact_fraction":
            return None
        if self.hidden > HIDDEN:
            return (
                f"waves longer than {self.longest:.3g} m may hold {self.hidden:.0%} of the mean square height: measure "
                f"larger maps, until the spectrum is flat, or press a size of at most {self.longest:.3g} m"
            )
        if name == "interfacial_stiffness_per_area" and self.shortest > self.rolloff / FINEST * (1 + 1e-6):
            return (
                f"needs waves down to an eighth of the roll-off, {self.rolloff / FINEST:.3g} m, and the band ends at "
                f"{self.shortest:.3g} m: measure with finer points or a sharper tip"
            )
        return None


def band_nodes(spectrum: CombinedSpectrum) -> tuple[Array, Array]:
    """Return ln q and ln C at the bins and at both ends of the band, where the line of two bins is continued."""
    q, c = np.log(spectrum.wavenumber), np.log(spectrum.density)
    ends = np.log([spectrum.q_min, spectrum.q_max])
    slopes = (c[1] - c[0]) / (q[1] - q[0]), (c[-1] - c[-2]) / (q[-1] - q[-2])
    first, last = c[0] + slopes[0] * (ends[0] - q[0]), c[-1] + slopes[1] * (ends[1] - q[-1])
    return np.concatenate([ends[:1], q, ends[1:]]), np.concatenate([[first], c, [last]])


def scales_of(spectrum: CombinedSpectrum, size: float) -> Scales:
    """Return the scales of a square of the side `size` [m]."""
    nodes, values = band_nodes(spectrum)
    low, high = max(spectrum.q_min, 2 * math.pi / size), spectrum.q_max
    x = np.linspace(math.log(low), math.log(high), 1000)
    weight = np.exp(2 * x + np.interp(x, nodes, values))  # of the mean square height, over ln q
    flat = (low**2 - (2 * math.pi / size) ** 2) / 2 * math.exp(values[0])
    rolloff = 2 * math.pi / math.exp(x[int(np.argmax(weight))])
    hidden = max(flat, 0.0) / float(np.trapezoid(weight, x))
    return Scales(2 * math.pi / low, 2 * math.pi / high, rolloff, hidden)
