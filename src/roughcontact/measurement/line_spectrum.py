"""The spectrum of the rows of a map by the median over them, which rows with spikes do not change."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from scipy.stats import chi2

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.measurement.band import PER_DECADE
from roughcontact.surface.analysis.power import PowerSpectrum
from roughcontact.surface.analysis.spectra import power_spectrum
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, Mask

__all__ = ["LineSpectra", "line_spectra"]

_ALIKE = (0.6, 0.8)  # median over mean of rows that are alike: ln 2 = 0.69 of exponential powers
_SURE = 3.0  # standard errors by which a ratio must leave these bounds
_MANY = 0.25  # of the rows: more spoilt ones are a property of the surface
_MEDIAN_ERROR = 1 / math.log(2)  # of the median of exponential numbers, over that of their mean
_RATIO_ERROR = math.sqrt(_MEDIAN_ERROR**2 - 1)  # of median over mean; their covariance is 1 (of unit mean)
_CHANCE = 0.01  # of a sound map to have a profile that counts as spoilt
_LEAST = 8


@dataclass(frozen=True, slots=True, eq=False)
class LineSpectra:
    """Spectra C1D of the profiles along one axis: their mean, and their median over its factor.

    Attributes
    ----------
    mean : PowerSpectrum
        Mean over all profiles.
    median : PowerSpectrum
        Median over the profiles, divided by that of a chi-squared number over its mean: ln 2 for one wave.
        Its freedom is 1.44^2 times smaller than that of the mean.
    ratio : array, shape (n,)
        Median over mean of the profiles without the spoilt ones, as for one wave: 0.69 if they are alike.
    spoilt : array of bool
        Which profiles hold spikes: the power of a bin is beyond chance.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> rough = rc.self_affine(rc.Grid((96, 128), 1e-6, periodic=True), 0.8, 1e-7, 1, amplitudes="gaussian")
    >>> heights = rough.heights.copy()
    >>> heights[7, 50] += 1e-5
    >>> found = rc.line_spectra(rc.Surface(heights, rough.grid))
    >>> np.flatnonzero(found.spoilt).tolist(), f"{found.mean.density[-1] / found.median.density[-1]:.0f}"
    ([7], '25')
    """

    mean: PowerSpectrum
    median: PowerSpectrum
    ratio: Array
    spoilt: Mask


def line_spectra(surface: Surface, direction: Literal["x", "y"] = "x") -> LineSpectra:
    """Return the mean and the median spectrum of the profiles of a map.

    Parameters
    ----------
    surface : Surface
        On a grid of two axes, complete.
    direction : {"x", "y"}
        Along the profiles.

    Returns
    -------
    LineSpectra
        In bins of a tenth of a decade.

    Raises
    ------
    ValueError
        If the profiles are not alike, so that their median has no known factor: waves of one direction, or heights
        that are far from Gaussian.

    Notes
    -----
    Profiles within a correlation length count once in the freedom.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rough = rc.self_affine(rc.Grid((96, 128), 1e-6, periodic=True), 0.8, 1e-7, 1, amplitudes="gaussian")
    >>> bool(abs(rc.line_spectra(rough).ratio.mean() - 0.69) < 0.1)
    True
    """
    if surface.grid.ndim != 2 or min(surface.shape) < _LEAST:
        raise about(
            "surface",
            f"must be a map of at least {_LEAST} x {_LEAST} cells, not {surface.shape}",
            "give a map",
        )
    mean = power_spectrum(surface, direction).rebinned(PER_DECADE)
    flat = surface.levelled("auto")
    rows, axis = (flat.heights, 1) if direction == "x" else (flat.heights.T, 0)
    line = Grid(rows.shape[1], surface.grid.spacing[axis], surface.grid.periodic[axis])
    spectra = [power_spectrum(Surface(row, line), level="mean").rebinned(PER_DECADE) for row in rows]
    each, waves = np.array([one.density for one in spectra]), spectra[0].count / 2
    # Only neighbouring waves are correlated by a window, so that a bin of one wave has both degrees of freedom.
    degrees = 2 * waves / (1 + (waves / spectra[0].freedom - 1) * (1 - 1 / waves))
    many = chi2.median(degrees) / degrees
    limit = np.median(each, axis=0) / many * chi2.isf(_CHANCE / each.size, degrees) / degrees
    spoilt = (each > limit).any(axis=1)
    spacing, periodic = (
        (along[1 - axis], along[axis]) for along in (surface.grid.spacing, surface.grid.periodic)
    )
    sound = Grid((int((~spoilt).sum()), rows.shape[1]), spacing, periodic)
    freedom = power_spectrum(Surface(rows[~spoilt], sound), "x", level="mean").rebinned(PER_DECADE).freedom
    number = np.maximum(freedom / spectra[0].freedom, 1.0)  # of independent profiles
    # Of N exponential numbers the median is 1, 0.83, 0.78, 0.76 for N = 1, 3, 5, 7: ln 2 + 1/(2 (N + 0.63)).
    factor = many + (1 - many) * 1.63 / (number + 0.63)
    ratio = math.log(2) * np.median(each[~spoilt], axis=0) / each[~spoilt].mean(axis=0) / factor
    error = _SURE * _RATIO_ERROR * ratio / np.sqrt(number)
    wrong = (ratio + error < _ALIKE[0]) | (ratio - error > _ALIKE[1])
    if wrong.any() or spoilt.mean() > _MANY:
        worst = int(np.argmax(np.abs(ratio / math.log(2) - 1)))
        raise InputError(
            f"the profiles along {direction} are not alike: median over mean is {ratio[worst]:.2g} at a wavelength of "
            f"{mean.wavelength[worst]:.3g} m, and {spoilt.sum()} of {len(rows)} profiles hold spikes",
            "use the mean, rc.power_spectrum(surface, direction)",
            "surface",
        )
    median = replace(mean, density=np.median(each, axis=0) / factor, freedom=freedom / _MEDIAN_ERROR**2)
    return LineSpectra(mean, median, ratio, spoilt)
