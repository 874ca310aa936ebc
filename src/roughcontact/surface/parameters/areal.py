"""Areal surface texture parameters of ISO 25178-2."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import map_coordinates, spline_filter

from roughcontact.errors import InputError
from roughcontact.surface.analysis.correlation import autocorrelation
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.parameters.heights import amplitudes
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric, require

__all__ = ["ArealParameters", "areal_parameters", "gradient_and_area"]

_HALVINGS = 30  # bisections of half a cell: to a billionth of it


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
        Texture aspect ratio [-], 4.3.3: Sal over the longest such distance. NaN if that distance exceeds half the
        length of the surface: then only an upper bound of the ratio is known.
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
@analysed_on_host
def areal_parameters(surface: Surface, *, decay: float = 0.2) -> ArealParameters:
    """Return the field parameters of ISO 25178-2:2021, clauses 4.2 to 4.4.

    Heights count above their mean, over all measured points of the map as one evaluation area: there are no sections as
    in a profile (`profile_parameters`). No filter is applied and no form is removed except the mean. The standard
    requires a scale-limited surface: remove tilt or form (the F-operation: `Surface.levelled`,
    `Surface.without_form`), then filter by the Gaussian of ISO 16610-61 (`Surface.filtered`: ``short_cutoff`` is the
    nesting index of the S-filter, ``long_cutoff`` that of the L-filter; ISO 25178-3 takes the latter as the side of
    the evaluation area). Missing points are left out, as are pairs and triangles that hold one.

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
        raise InputError(f"areal parameters need a surface of 2 x 2 points, not shape {surface.grid.shape}")
    require(0 < decay < 1, f"decay must lie between 0 and 1, not {decay}", place="decay")
    heights = surface.heights[surface.measured]
    require(heights.max() != heights.min(), "all heights are equal: there is no texture to measure")
    heights -= heights.mean()
    arithmetic, rms, skewness, kurtosis = amplitudes(heights)
    peak, pit = float(heights.max()), -float(heights.min())
    shortest, longest = decay_lengths(surface, decay)
    gradient, area = gradient_and_area(surface)
    return ArealParameters(
        Sq=rms,
        Ssk=skewness,
        Sku=kurtosis,
        Sp=peak,
        Sv=pit,
        Sz=peak + pit,
        Sa=arithmetic,
        Sal=shortest,
        Str=shortest / longest if math.isfinite(longest) else math.nan,
        Sdq=gradient,
        Sdr=area,
    )


def gradient_and_area(surface: Surface) -> tuple[float, float]:
    """Return the root mean square gradient and the relative excess of area of the surface through its points.

    Sdq and Sdr (ISO 25178-2:2021, 4.4.2 and 4.4.3). Between four points the surface is cut into triangles along each
    of the two diagonals, and the results are averaged. Triangles with a missing corner are left out. Along a periodic
    axis the last points are joined to the first.

    Raises
    ------
    ValueError
        If no triangle is complete.
    """
    z, (dy, dx) = surface.heights, surface.grid.spacing
    z = np.pad(z, [(0, 1) if periodic else (0, 0) for periodic in surface.grid.periodic], mode="wrap")
    along_x, along_y = np.diff(z, axis=1) / dx, np.diff(z, axis=0) / dy
    squares = area = 0.0
    number = 0
    # Each triangle has one edge along x, above or below, and one along y, left or right.
    for x in (along_x[:-1], along_x[1:]):
        for y in (along_y[:, :-1], along_y[:, 1:]):
            steepness = x**2 + y**2
            steepness = steepness[~np.isnan(steepness)]
            number += steepness.size
            squares += float(steepness.sum())
            # sqrt(1 + s) - 1 without loss for small slopes.
            area += float((steepness / (np.sqrt(1 + steepness) + 1)).sum())
    require(number, "no three neighbouring points are measured: there is no gradient")
    return float(np.sqrt(squares / number)), area / number


def decay_lengths(surface: Surface, level: float) -> tuple[float, float]:
    """Return the shortest and the longest distance over which the autocorrelation falls to `level` of its maximum [m].

    Sal and the length that Str compares it with (ISO 25178-2:2021, 4.3.2 and 4.3.3).
    The search goes along rays at every degree to the first place where the autocorrelation falls to the level, on a
    cubic spline through the lags. The longest is infinite if along some ray the level is not reached within half the
    length of the surface.
    """
    lags = autocorrelation(surface)
    middle = [axis.size // 2 for axis in lags.lags]
    share = np.where(lags.pairs > 0, lags.value, 0.0) / lags.value[tuple(middle)]
    smooth = spline_filter(share, order=3, mode="mirror")
    steps = surface.grid.spacing

    def values(radius: Array, angle: Array | float) -> Array:
        rows = middle[0] + radius * np.sin(angle) / steps[0]
        columns = middle[1] + radius * np.cos(angle) / steps[1]
        # Beyond the largest lags the autocorrelation is unknown.
        known = (rows <= share.shape[0] - 1) & (columns <= share.shape[1] - 1) & (columns >= 0)
        found = map_coordinates(smooth, [rows, columns], order=3, prefilter=False, mode="mirror")
        return np.where(known, found, np.nan)

    reach = math.hypot(*(axis[-1] for axis in lags.lags))
    radius = np.arange(0.0, reach + min(steps), min(steps) / 2)
    angles = np.radians(np.arange(0, 180))  # the other half is equal by symmetry
    first = [int(np.argmax(values(radius, angle) <= level)) for angle in angles]
    if not any(first):
        return math.inf, math.inf
    # Zero lag is above the level: a first place of 0 means that the level is not reached.
    falls = np.array([place > 0 for place in first])
    outer = radius[np.array(first)[falls]]
    inner = outer - min(steps) / 2
    for _ in range(_HALVINGS):
        half = (inner + outer) / 2
        below = values(half, angles[falls]) <= level
        inner, outer = np.where(below, inner, half), np.where(below, half, outer)
    return float(outer.min()), float(outer.max()) if falls.all() else math.inf
