"""Areal surface texture parameters of ISO 25178-2."""

from __future__ import annotations

import math
from dataclasses import dataclass

from roughcontact.surface.parameters.decay import decay_lengths
from roughcontact.surface.parameters.facets import gradient_and_area
from roughcontact.surface.parameters.heights import amplitudes
from roughcontact.surface.surface import Surface
from roughcontact.validation import numeric

__all__ = ["ArealParameters", "areal_parameters"]


@dataclass(frozen=True, slots=True)
class ArealParameters:
    """Field parameters of a scale-limited surface (clauses of ISO 25178-2:2021).

    Parameters
    ----------
    Sq : float
        Root mean square height [m], 4.2.2.
    Ssk : float
        Skewness [-], 4.2.3.
    Sku : float
        Kurtosis [-], 4.2.4; 3 for normally distributed heights.
    Sp : float
        Maximum peak height [m], 4.2.5.
    Sv : float
        Maximum pit depth [m], 4.2.6, positive.
    Sz : float
        Maximum height [m], 4.2.7: Sp + Sv.
    Sa : float
        Arithmetic mean height [m], 4.2.8.
    Sal : float
        Autocorrelation length [m], 4.3.2: the shortest distance over which the autocorrelation falls to 0.2.
        Infinite if it does not within half the length of the surface.
    Str : float
        Texture aspect ratio [-], 4.3.3: Sal over the longest such distance. NaN where that distance exceeds half the
        length of the surface: the aspect ratio cannot be told then, only that it is small.
    Sdq : float
        Root mean square gradient [-], 4.4.2.
    Sdr : float
        Developed interfacial area ratio [-], 4.4.3: the excess of area over the flat one, a share, not percent.
    """

    Sq: float
    Ssk: float
    Sku: float
    Sp: float
    Sv: float
    Sz: float
    Sa: float
    Sal: float
    Str: float
    Sdq: float
    Sdr: float


@numeric
def areal_parameters(surface: Surface, *, decay: float = 0.2) -> ArealParameters:
    """Return the field parameters of ISO 25178-2:2021, clauses 4.2 to 4.4.

    Heights count above their mean. The standard wants a scale-limited surface: level and filter it first, since
    nothing is removed here but the mean. Missing points are left out, as are pairs and triangles that hold one.

    Parameters
    ----------
    surface : Surface
        On a grid of two axes.
    decay : float
        The level of the autocorrelation for Sal and Str.

    Raises
    ------
    ValueError
        If the surface is a line or smaller than 2 x 2, all heights are equal, or `decay` is not between 0 and 1.

    Notes
    -----
    Sdq and Sdr are those of the triangles between neighbouring points, cut along both diagonals: an edge along
    x sees of a wave q the share ``sin(q D/2)/(q D/2)``. Sdq of a rough surface hangs on the spacing.
    """
    if surface.grid.ndim != 2 or min(surface.grid.shape) < 2:
        raise ValueError(f"areal parameters need a surface of 2 x 2 points, not shape {surface.grid.shape}")
    if not 0 < decay < 1:
        raise ValueError(f"decay must lie between 0 and 1, not {decay}")
    heights = surface.heights[surface.measured]
    if heights.max() == heights.min():
        raise ValueError("all heights are equal: there is no texture to measure")
    heights -= heights.mean()
    moments = amplitudes(heights)
    peak, pit = float(heights.max()), -float(heights.min())
    shortest, longest = decay_lengths(surface, decay)
    gradient, area = gradient_and_area(surface)
    return ArealParameters(
        Sq=moments.rms,
        Ssk=moments.skewness,
        Sku=moments.kurtosis,
        Sp=peak,
        Sv=pit,
        Sz=peak + pit,
        Sa=moments.arithmetic,
        Sal=shortest,
        Str=shortest / longest if math.isfinite(longest) else math.nan,
        Sdq=gradient,
        Sdr=area,
    )
