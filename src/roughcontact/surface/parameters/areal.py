"""Areal surface texture parameters of ISO 25178-2."""

from __future__ import annotations

import math
from dataclasses import dataclass

from roughcontact.surface.parameters.decay import decay_lengths
from roughcontact.surface.parameters.facets import gradient_and_area
from roughcontact.surface.parameters.heights import amplitudes
from roughcontact.surface.surface import Surface
from roughcontact.theory.tools.numeric import numeric

__all__ = ["ArealParameters", "areal_parameters"]


@dataclass(frozen=True, slots=True)
class ArealParameters:
    """Field parameters of a scale-limited surface (clauses of ISO 25178-2:2021).

    Attributes
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
        length of the surface: the aspect ratio is small then, and no more is known of it.
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

    Heights count above their mean. The standard wants a scale-limited surface: remove its tilt and filter it first,
    since nothing is removed here but the mean. Missing points are left out, as are pairs and triangles that hold one.

    Parameters
    ----------
    surface : Surface
        On a grid of two axes.
    decay : float
        The level of the autocorrelation for Sal and Str.

    Returns
    -------
    ArealParameters
        Heights [m], lengths [m] and ratios [-] by the names of the standard.

    Raises
    ------
    ValueError
        If the surface is a line or smaller than 2 x 2, all heights are equal, or `decay` is not between 0 and 1.

    Notes
    -----
    Sdq and Sdr are those of the triangles between neighbouring points, cut along both diagonals: an edge along
    x keeps of a wave q the fraction ``sin(q D/2)/(q D/2)``. Sdq of a rough surface depends on the spacing.

    Examples
    --------
    >>> import roughcontact as rc
    >>> wave = rc.shapes.wave(rc.Grid((64, 64), 1e-6, periodic=True), amplitude=1e-6, wavelength=32e-6)
    >>> parameters = rc.areal_parameters(wave)
    >>> f"Sq = {parameters.Sq:.3g} m, Sz = {parameters.Sz:.2g} m, Sku = {parameters.Sku:.2f}"
    'Sq = 7.07e-07 m, Sz = 2e-06 m, Sku = 1.50'
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
