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
from roughcontact.validation import Array, Mask, require

__all__ = ["LineSpectra", "line_spectra"]

_ALIKE = (0.6, 0.8)  # median over mean of rows that are alike: ln 2 = 0.69 of exponential powers
_SURE = 4.0  # standard errors by which a ratio must differ from ln 2 as well
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
    >>> rough = rc.self_affine(rc.Grid((96, 128), 1e-6, periodic=True), 0.8, 1e-7, 2, amplitudes="gaussian")
    >>> heights = rough.heights.copy()
    >>> heights[7, 50] += 1e-5
    >>> found = rc.line_spectra(rc.Surface(heights, rough.grid))
    >>> np.flatnonzero(found.spoilt).tolist(), f"{found.mean.density[-1] / found.median.density[-1]:.0f}"
    ([7], '1041')
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
    require(direction in ("x", "y"), f"direction must be 'x' or 'y', not {direction!r}", place="direction")
    if surface.grid.ndim != 2 or min(surface.shape) < _LEAST:
        raise about(
            "surface",
            f"must be a map of at least {_LEAST} x {_LEAST} cells, not {surface.shape}",
            "give a map",
        )
    flat = surface.levelled("auto")
    rows, axis = (flat.heights, 1) if direction == "x" else (flat.heights.T, 0)
    steps, repeating = surface.grid.spacing, surface.grid.periodic
    line, across = Grid(rows.shape[1], steps[axis], repeating[axis]), (repeating[1 - axis],)
    alone = power_spectrum(Surface(rows[0], line), level="mean")
    fine = np.array([power_spectrum(Surface(row, line), level="mean").density for row in rows])
    limit = np.median(fine, axis=0) / math.log(2) * -math.log(_CHANCE / fine.size)
    spoilt = (fine > limit).any(axis=1)
    if spoilt.mean() > _MANY:
        raise _not_alike(f"{spoilt.sum()} of {len(rows)} profiles along {direction} hold spikes")
    sound = Grid(
        (int((~spoilt).sum()), rows.shape[1]), (steps[1 - axis], steps[axis]), (*across, *line.periodic)
    )
    whole = power_spectrum(Surface(rows[~spoilt], sound), "x", level="mean")
    number = np.maximum(whole.freedom / alone.freedom, 1.0)  # of independent profiles
    ratio = np.median(fine[~spoilt], axis=0) / fine[~spoilt].mean(axis=0) * math.log(2) / _factor(2.0, number)
    bins = alone.rebinned(PER_DECADE)
    index = np.repeat(np.arange(bins.count.size), (bins.count / alone.count[0]).astype(int))

    def mean(values: Array) -> Array:
        return np.asarray(np.bincount(index, values) / np.bincount(index))

    waves = np.bincount(index)
    for found, each, wave in (
        (ratio, number, alone.wavelength),
        (mean(ratio), mean(number) * waves, bins.wavelength),
    ):
        error = _SURE * _RATIO_ERROR * math.log(2) / np.sqrt(each)
        wrong = (np.abs(found - math.log(2)) > error) & ((found < _ALIKE[0]) | (found > _ALIKE[1]))
        if wrong.any():
            worst = int(np.argmax(wrong))
            raise _not_alike(
                f"the profiles along {direction} are not alike at a wavelength of {wave[worst]:.3g} m: their median "
                f"is {found[worst]:.2g} of their mean, not 0.69"
            )
    # Only neighbouring waves are correlated by a window, so that a bin of one wave has both degrees of freedom.
    degrees = 2 * waves / (1 + (1 / alone.freedom[0] - 1) * (1 - 1 / waves))
    binned = np.array([mean(row) for row in fine])
    number = mean(number * whole.density) / np.maximum(
        mean(whole.density), 1e-300
    )  # the strongest wave counts
    density, freedom = (
        np.median(binned, axis=0) / _factor(degrees, number),
        whole.rebinned(PER_DECADE).freedom,
    )
    # All waves of a bin count alike, as in the median.
    average = replace(power_spectrum(surface, direction).rebinned(PER_DECADE), density=binned.mean(axis=0))
    median = replace(average, density=density, freedom=freedom / _MEDIAN_ERROR**2)
    return LineSpectra(average, median, mean(ratio), spoilt)


def _factor(degrees: Array | float, number: Array) -> Array:
    """Return the median of N chi-squared numbers over their mean.

    Of N exponential numbers it is 1, 0.83, 0.78, 0.76 for N = 1, 3, 5, 7: ln 2 + 1/(2 (N + 0.63)).
    """
    many = chi2.median(degrees) / degrees
    return np.asarray(many + (1 - many) * 1.63 / (number + 0.63))


def _not_alike(problem: str) -> InputError:
    return InputError(problem, "use the mean, rc.power_spectrum(surface, direction)", "surface")
