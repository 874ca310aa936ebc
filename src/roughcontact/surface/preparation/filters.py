"""The Gaussian filter of surface texture (ISO 16610-61 for areas, ISO 16610-21 for profiles)."""

from __future__ import annotations

import math

import numpy as np

from roughcontact.errors import InputError, placed
from roughcontact.surface.in_memory import on_host_only
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, lengths_method, require

__all__ = ["ALPHA", "filtered", "gaussian_mean", "require_cells"]


# The constant of the standard: at the cut-off wavelength the filter transmits one half.
ALPHA = math.sqrt(math.log(2) / math.pi)
# Beyond this many times alpha * cut-off the weight is below the rounding of the largest one.
_REACH = math.sqrt(53 * math.log(2) / math.pi)
# With fewer cells per cut-off wave the sampled weights do not have the required transmission.
_CELLS = 4


@on_host_only
@lengths_method
def filtered(
    surface: Surface, *, short_cutoff: float | None = None, long_cutoff: float | None = None
) -> Surface:
    """Return the surface without the waves shorter than one cut-off and longer than another.

    Parameters
    ----------
    surface : Surface
    short_cutoff : float, optional
        Wavelength [m] below which waves are removed (the S-filter; low-pass).
    long_cutoff : float, optional
        Wavelength [m] above which waves are removed, including the mean (the L-filter; high-pass). With both, the long
        waves are removed from the result of the S-filter (the S-L surface; band-pass).

    Returns
    -------
    Surface
        The filtered surface; missing points stay missing.

    Raises
    ------
    ValueError
        If no cut-off is given, the two leave no band, or a cut-off has too few cells: four, or two on a periodic
        grid without missing points.

    Notes
    -----
    The Gaussian filter of ISO 16610-61 for areas and ISO 16610-21 for profiles. A wave of length l is transmitted by
    exp(-pi (alpha c/l)^2) = 2^(-(c/l)^2) by a low-pass of cut-off c, alpha^2 = ln 2 / pi, and by one minus this by a
    high-pass. Along a periodic axis this is exact. Along a free axis the heights within reach are averaged with the
    weights exp(-pi (x/(alpha c))^2), divided by their sum: near an edge, about half a cut-off wide, the mean is taken
    over the cells that exist (regression of order 0). Missing points have no weight and stay missing.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> waves = rc.shapes.wave(grid, 1e-6, wavelength=16e-6)
    >>> f"{waves.filtered(short_cutoff=16e-6).rms / waves.rms:.3f}"  # of a wave at the cut-off one half stays
    '0.500'
    """
    if short_cutoff is None and long_cutoff is None:
        raise InputError(
            "a filter needs a cut-off",
            "give short_cutoff, long_cutoff or both [m]",
            "short_cutoff, long_cutoff",
        )
    if short_cutoff is not None and long_cutoff is not None and not short_cutoff < long_cutoff:
        raise InputError(
            f"the short cut-off of {short_cutoff:g} m must be below the long one of {long_cutoff:g} m",
            "exchange them",
            "short_cutoff, long_cutoff",
        )
    grid = surface.grid
    for name, cutoff in (("short_cutoff", short_cutoff), ("long_cutoff", long_cutoff)):
        if cutoff is not None:
            with placed(name):
                require_cells(cutoff, surface)
    if short_cutoff is not None and short_cutoff >= max(grid.lengths):
        raise InputError(
            f"a cut-off of {short_cutoff:g} m leaves nothing of a map of {max(grid.lengths):g} m",
            "give a shorter one, such as 1e-5 m",
            "short_cutoff",
        )
    if short_cutoff is not None:
        heights = gaussian_mean(surface.heights, grid.spacing, grid.periodic, (short_cutoff,) * grid.ndim)
        surface = surface.with_heights(heights, f"Gaussian filter: waves below {short_cutoff:.6g} m removed")
    if long_cutoff is not None:
        mean = gaussian_mean(surface.heights, grid.spacing, grid.periodic, (long_cutoff,) * grid.ndim)
        line = f"Gaussian filter: waves above {long_cutoff:.6g} m removed"
        surface = surface.with_heights(surface.heights - mean, line)
    return surface


def gaussian_mean(
    heights: Array,
    spacing: tuple[float, ...],
    periodic: tuple[bool, ...],
    cutoffs: tuple[float | None, ...],
) -> Array:
    """Return the Gaussian mean of the measured heights around each of them; NaN stays NaN.

    Parameters
    ----------
    heights : array, shape (ny, nx) or (n,)
        Heights [m].
    spacing : tuple of float
        Size of a cell [m].
    periodic : tuple of bool
        Which axes repeat themselves.
    cutoffs : tuple of float or None
        For each axis the wavelength with transmission one half [m], or None for no mean along it.
    """
    measured = ~np.isnan(heights)
    # Heights count from their mean: heights far from zero keep their digits.
    level = float(heights[measured].mean())
    mean = np.where(measured, heights - level, 0.0)
    whole = bool(measured.all())
    weight = measured.astype(np.float64)
    for axis, (step, repeats, cutoff) in enumerate(zip(spacing, periodic, cutoffs, strict=True)):
        if cutoff is None:
            continue
        reach = ALPHA * cutoff / step
        mean = _weighted_sum(mean, axis, reach, repeats)
        if whole:  # the weights separate into one factor an axis
            ones = np.ones([n if k == axis else 1 for k, n in enumerate(heights.shape)])
            mean /= _weighted_sum(ones, axis, reach, repeats)
        else:
            weight = _weighted_sum(weight, axis, reach, repeats)
    if not whole:
        mean = np.divide(mean, weight, out=np.full(heights.shape, np.nan), where=measured)
    return mean + level


def _weighted_sum(values: Array, axis: int, reach: float, periodic: bool) -> Array:
    """Return the sum along `axis` with the weights exp(-pi (k/reach)^2), `reach` in cells.

    On a periodic axis they are the weights whose transmission is exact at every wave of the grid.
    """
    import scipy.fft

    count = values.shape[axis]
    if periodic:
        waves = scipy.fft.rfftfreq(count)
        transmission = np.exp(-math.pi * (reach * waves) ** 2)
        length = count
    else:
        last = min(count - 1, math.ceil(_REACH * reach))
        length = scipy.fft.next_fast_len(count + last, real=True)
        kernel = np.zeros(length)
        kernel[: last + 1] = np.exp(-math.pi * (np.arange(last + 1) / reach) ** 2)
        kernel[length - last :] = kernel[last:0:-1]
        transmission = scipy.fft.rfft(kernel).real
    shape = [1] * values.ndim
    shape[axis] = -1
    spectrum = scipy.fft.rfft(values, n=length, axis=axis) * transmission.reshape(shape)
    result = scipy.fft.irfft(spectrum, n=length, axis=axis)
    return np.ascontiguousarray(np.take(result, range(count), axis=axis))


def require_cells(cutoff: float, surface: Surface) -> None:
    """Refuse a cut-off that the grid cannot resolve.

    Raises
    ------
    ValueError
        If a wave of this length has too few cells, or the cut-off is not positive and finite.
    """
    require(
        math.isfinite(cutoff) and cutoff > 0,
        f"a cut-off must be positive and finite [m], not {cutoff}",
        place="cutoff",
    )
    grid = surface.grid
    exact = all(grid.periodic) and surface.missing == 0
    least = (2 if exact else _CELLS) * max(grid.spacing)
    if cutoff < least * (1 - 1e-9):
        raise InputError(
            f"a cut-off of {cutoff:g} m is too short for cells of {max(grid.spacing):g} m",
            f"give at least {least:.10g} m",
        )
