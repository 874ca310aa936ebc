"""Spectral moments: of a surface, and of a spectrum on a grid."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.surface.generation.wave_grid import (
    Spectrum,
    Support,
    multiplicity,
    wave_powers,
    wavenumbers,
)
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric, require, require_numbers

__all__ = ["Moments", "grid_moments", "surface_moments"]


@dataclass(frozen=True, slots=True)
class Moments:
    """Profile moments m0, m2, m4, as used in random-field and asperity theory (Nayak 1971).

    The moments of a straight cut, averaged over all directions if the surface has a lay. With the spectrum C2D of
    an isotropic surface ``m0 = 2 pi int q C2D dq``, ``m2 = pi int q^3 C2D dq`` and
    ``m4 = (3 pi/4) int q^5 C2D dq``; of a line ``mn = 2 int q^n C1D dq``.

    Parameters
    ----------
    m0 : float
        Mean square height [m^2].
    m2 : float
        Mean square slope of a profile [-]; the areal one is ``2 m2``.
    m4 : float
        Mean square second derivative of a profile [1/m^2]; that of the Laplacian of a surface is ``8/3 m4``.
    dimension : {2, 1}
        Whether these belong to a surface (2) or to a line (1). The meaning of the three rms values depends on it.

    Raises
    ------
    ValueError
        If a moment is negative or not a number, or `dimension` is neither 1 nor 2.

    Examples
    --------
    >>> import roughcontact as rc
    >>> moments = rc.Moments(m0=1e-12, m2=5e-3, m4=1e8)
    >>> f"{moments.rms_height:.3g} m, slope {moments.rms_slope:.3g}, Nayak {moments.nayak:.3g}"
    '1e-06 m, slope 0.1, Nayak 4'
    """

    m0: float
    m2: float
    m4: float
    dimension: int = 2

    def __post_init__(self) -> None:
        require_numbers(self, m0="m^2", m4="1/m^2")
        for name in ("m0", "m2", "m4"):
            require(
                getattr(self, name) >= 0,
                f"{name} must not be negative, not {getattr(self, name)}",
                place=name,
            )
        if self.dimension not in (1, 2):
            raise about("dimension", f"must be 2 (a surface) or 1 (a line), not {self.dimension}")

    @property
    def rms_height(self) -> float:
        """Root mean square height about the mean [m]."""
        return math.sqrt(self.m0)

    @property
    def rms_slope(self) -> float:
        """Root mean square of ``|grad z|``, ``sqrt(2 m2)`` (thesis, eq. 4.18); of a line ``sqrt(m2)`` [-]."""
        return math.sqrt(self.dimension * self.m2)

    @property
    def rms_curvature(self) -> float:
        """Root mean square of half the Laplacian of z, ``sqrt(2/3 m4)``; of a line of z'', ``sqrt(m4)`` [1/m].

        Half the Laplacian is the mean of the two principal curvatures where the surface is level.
        """
        return math.sqrt(self.m4 * (2 / 3 if self.dimension == 2 else 1))

    @property
    def nayak(self) -> float:
        """Nayak's parameter ``m0 m4 / m2^2`` [-], at least 3/2 on an isotropic surface; NaN if m2 is 0 or infinite."""
        return self.m0 * self.m4 / self.m2**2 if 0 < self.m2 < math.inf else math.nan

    @property
    def profile(self) -> Moments:
        """The same moments as those of a line: a straight cut through the surface."""
        return replace(self, dimension=1)


def grid_moments(grid: Grid, spectrum: Spectrum, *, support: Support = "square") -> Moments:
    """Return the moments of `spectrum` as sums over the waves of `grid`.

    They are the moments of every surface with exact amplitudes that is synthesised on the grid with that spectrum, and
    the means over surfaces with Gaussian amplitudes.

    Parameters
    ----------
    grid : Grid
        One period; of a nodal grid without its last row and column.
    spectrum : callable or PlanarSpectrum
        C2D [m^4], on a line C1D [m^3], see `synthesise`.
    support : {"square", "disc"}
        See `self_affine`.

    Returns
    -------
    Moments
        m0, m2 and m4 of a profile.

    Raises
    ------
    ValueError
        If the spectrum belongs to another number of axes, is negative or not finite, or leaves no wave.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> spectrum = rc.SelfAffineSpectrum(hurst=0.8).scaled(1e-6, grid)
    >>> f"{rc.grid_moments(grid, spectrum).rms_height:.3g} m"
    '1e-06 m'
    """
    powers = wave_powers(spectrum, grid.shape, grid.spacing, support) * multiplicity(grid.shape)
    return _summed(powers, grid)


@numeric
@analysed_on_host
def surface_moments(
    surface: Surface, *, derivative: Literal["spectral", "difference"] | None = None
) -> Moments:
    """Return the moments of the heights of a surface or a line.

    Parameters
    ----------
    surface : Surface
        Remove its tilt first, which would count as slope: see `Surface.levelled`.
    derivative : {"spectral", "difference"}, optional
        Method for slopes and curvatures; by default "spectral" on a periodic grid without missing points, otherwise
        "difference". "spectral" treats any surface as one period of a periodic one, including a step at its edges.

    Returns
    -------
    Moments
        The areal mean squares of the gradient and of the Laplacian, as profile moments: ``m2 = <|grad z|^2>/2`` and
        ``m4 = 3/8 <(lap z)^2>``.

    Raises
    ------
    ValueError
        If "spectral" is given with points missing, or no two neighbours are measured.

    Notes
    -----
    Differences of neighbours, ``(z[i+1] - z[i])/D`` and the second differences, damp a wave q along an axis: its
    mean square slope by ``s^2`` and its mean square curvature by ``s^4``, ``s = sin(qD/2)/(qD/2)``, which is
    0.64 for the shortest waves. Differences with a missing neighbour are left out of the means.

    Examples
    --------
    >>> import math
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> moments = rc.surface_moments(rc.shapes.wave(grid, amplitude=1e-7, wavelength=32e-6))
    >>> f"slope {moments.rms_slope:.5f} = {2 * math.pi / 32e-6 * 1e-7 / math.sqrt(2):.5f}"
    'slope 0.01388 = 0.01388'
    """
    grid, whole = surface.grid, surface.missing == 0
    if derivative is None:
        derivative = "spectral" if all(grid.periodic) and whole else "difference"
    if derivative == "spectral":
        if not whole:
            raise InputError(
                f"{surface.missing} points are missing", "use derivative='difference' or fill them first"
            )
        import scipy.fft

        transform = scipy.fft.rfftn(surface.heights - surface.heights.mean()) / grid.size
        return _summed(np.abs(transform) ** 2 * multiplicity(grid.shape), grid)
    require(
        derivative == "difference",
        f"derivative must be 'spectral' or 'difference', not {derivative!r}",
        place="derivative",
    )
    return _by_differences(surface)


def _summed(powers: Array, grid: Grid) -> Moments:
    """Return the moments of waves of the given mean squares [m^2]."""
    squared = wavenumbers(grid.shape, grid.spacing) ** 2
    gradient, laplacian = float((squared * powers).sum()), float((squared**2 * powers).sum())
    return _from_areal(float(powers.sum()), gradient, laplacian, grid.ndim)


def _from_areal(height: float, gradient: float, laplacian: float, dimension: int) -> Moments:
    """Return the moments from the mean squares of height, gradient and Laplacian."""
    # The means over all directions of cos^2 and of cos^4.
    squares, fourths = (1.0, 1.0) if dimension == 1 else (1 / 2, 3 / 8)
    return Moments(height, squares * gradient, fourths * laplacian, dimension)


def _by_differences(surface: Surface) -> Moments:
    heights, grid = surface.heights, surface.grid
    gradient, laplacian = 0.0, np.zeros(grid.shape)
    for axis, (step, periodic) in enumerate(zip(grid.spacing, grid.periodic, strict=True)):
        ahead, behind = np.roll(heights, -1, axis), np.roll(heights, 1, axis)
        if not periodic:
            ends = [(slice(None),) * axis + (end,) for end in (-1, 0)]
            ahead[ends[0]] = behind[ends[1]] = np.nan
        slopes = (ahead - heights) / step
        laplacian += (ahead - 2 * heights + behind) / step**2
        gradient += _mean_square(slopes)
    return _from_areal(float(np.nanvar(heights)), gradient, _mean_square(laplacian), grid.ndim)


def _mean_square(field: Array) -> float:
    known = field[~np.isnan(field)]
    if known.size == 0:
        raise InputError("no point has enough measured neighbours for differences: the grid is too small")
    return float(np.mean(known**2))
