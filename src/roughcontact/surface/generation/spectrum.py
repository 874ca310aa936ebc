"""Power spectra: the self-affine law with its limits, and spectra that depend on the direction."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.surface.generation.wave_grid import Support
from roughcontact.surface.moments import Moments, grid_moments
from roughcontact.units import in_si
from roughcontact.validation import Array, moderate, numeric, require_numbers

__all__ = ["DirectionalSpectrum", "SelfAffineSpectrum", "StretchedSpectrum"]


@dataclass(frozen=True, slots=True)
class SelfAffineSpectrum:
    """C2D(q), a power law q^(-2(H+1)) between its limits (thesis, eqs 2.10, 2.13 and fig. 34).

    With the default scale it is only a shape, and a surface is scaled by its rms height; `scaled` sets the scale.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, from -1 to 3. Heights are white at -1, on a line at -1/2.
    rolloff : float, optional
        Waves longer than this [m] have the amplitude of this one (a plateau).
    long_cutoff : float, optional
        Longer waves than this [m] are absent.
    short_cutoff : float, optional
        Shorter waves than this [m] are absent.
    dimension : {2, 1}
        C2D of a surface, or the two-sided C1D ~ q^(-2H-1) of a line.
    scale : float
        Value of the power law at 1 rad/m: of C2D in m^4, of C1D in m^3.

    Raises
    ------
    ValueError
        If H is out of range, or a wavelength or the scale is not positive, or the limits leave no wave.

    Examples
    --------
    >>> import roughcontact as rc
    >>> spectrum = rc.SelfAffineSpectrum(hurst=0.8, long_cutoff=1e-4, short_cutoff=1e-6).scaled(rms=1e-6)
    >>> moments = spectrum.moments()
    >>> f"{moments.rms_height:.3g} m, slope {moments.rms_slope:.3f}"
    '1e-06 m, slope 0.290'
    """

    hurst: float
    rolloff: float | None = None
    long_cutoff: float | None = None
    short_cutoff: float | None = None
    dimension: int = 2
    scale: float = 1.0

    def __post_init__(self) -> None:
        require_numbers(self, rolloff="m", long_cutoff="m", short_cutoff="m")
        if not -1 <= self.hurst <= 3:
            raise about("hurst", f"must lie between -1 and 3, not {self.hurst}")
        for name in ("rolloff", "long_cutoff", "short_cutoff"):
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and value > 0):
                raise InputError(f"{name} must be positive and finite [m], not {value}", place=name)
        longest = min(v for v in (self.long_cutoff, math.inf) if v is not None)
        if self.short_cutoff is not None and not self.short_cutoff <= longest:
            raise InputError(
                f"short_cutoff {self.short_cutoff} m exceeds long_cutoff {longest} m: no wave is left",
                place="short_cutoff, long_cutoff",
            )
        if self.dimension not in (1, 2):
            raise about("dimension", f"must be 2 (a surface) or 1 (a line), not {self.dimension}")
        if not (math.isfinite(self.scale) and self.scale > 0):
            raise about("scale", f"must be positive and finite, not {self.scale}")

    @property
    def q_min(self) -> float:
        """Smallest wavenumber [rad/m], that of `long_cutoff`; 0 without one."""
        return 0.0 if self.long_cutoff is None else 2 * math.pi / self.long_cutoff

    @property
    def q_max(self) -> float:
        """Largest wavenumber [rad/m], that of `short_cutoff`; infinite without one."""
        return math.inf if self.short_cutoff is None else 2 * math.pi / self.short_cutoff

    @property
    def q_rolloff(self) -> float:
        """Wavenumber [rad/m] below which the spectrum is flat; 0 without a plateau."""
        return 0.0 if self.rolloff is None else 2 * math.pi / self.rolloff

    def __call__(self, wavenumber: Array) -> Array:
        """Return C(q), m^4 on a surface and m^3 on a line, at the `wavenumber` q [rad/m]; zero at q = 0."""
        q = np.asarray(in_si(wavenumber, "rad/m", "wavenumber"), dtype=np.float64)
        bent = np.maximum(q, self.q_rolloff)
        with np.errstate(divide="ignore"):
            shape = np.where(q > 0, self.scale * bent ** (-2 * self.hurst - self.dimension), 0.0)
        # A wave on a limit belongs to the spectrum, despite rounding of its wavelength.
        shape[q < self.q_min * (1 - 1e-9)] = 0
        shape[q > self.q_max * (1 + 1e-9)] = 0
        return shape

    def moments(self) -> Moments:
        """Return the moments of the continuous spectrum, in closed form (thesis, eq. 4.18).

        An integral that diverges without a limit is infinite: m0 without `long_cutoff` or
        `rolloff` for H >= 0, and m2 without `short_cutoff` for H <= 1, for example.

        Returns
        -------
        Moments
            m0, m2 and m4 of a profile.

        Examples
        --------
        >>> import roughcontact as rc
        >>> moments = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-4, short_cutoff=1e-6).scaled(rms=1e-6).moments()
        >>> f"m0 = {moments.m0:.3g} m^2, m2 = {moments.m2:.3g}, m4 = {moments.m4:.3g} m^-2"
        'm0 = 1e-12 m^2, m2 = 0.0419, m4 = 2.46e+11 m^-2'
        """
        # The angular mean of cos^n times the range of angles; for a line its two sides.
        factors = (2.0, 2.0, 2.0) if self.dimension == 1 else (2 * math.pi, math.pi, 3 * math.pi / 4)
        m0, m2, m4 = (factor * self._integral(n) for n, factor in zip((0, 2, 4), factors, strict=True))
        return Moments(m0, m2, m4, self.dimension)

    @numeric(rms="m")
    def scaled(self, rms: float, grid: Grid | None = None, support: Support = "square") -> SelfAffineSpectrum:
        """Return the spectrum with the scale for an rms height.

        Parameters
        ----------
        rms : float
            Root mean square height [m].
        grid : Grid, optional
            The rms height is that of the waves of this grid, as in `self_affine`. By default it is that of all waves
            between the limits; the two differ, because a sum over a few long waves is not an integral.
        support : {"square", "disc"}
            Waves of the grid, see `self_affine`.

        Returns
        -------
        SelfAffineSpectrum
            The same law with another `scale`.

        Raises
        ------
        ValueError
            If `rms` is not positive, or the continuous spectrum has no finite rms height.

        Examples
        --------
        >>> import roughcontact as rc
        >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-4, short_cutoff=1e-6).scaled(rms=1e-6)
        >>> f"{spectrum.moments().rms_height:.3g} m"
        '1e-06 m'
        """
        if not (math.isfinite(rms) and rms > 0):
            raise about("rms", f"must be positive and finite [m], not {rms}")
        moderate(rms, "rms [m]")
        m0 = (self.moments() if grid is None else grid_moments(grid, self, support=support)).m0
        if not 0 < m0 < math.inf:
            raise InputError(
                f"the mean square height over the wavenumbers {self.q_min:g} to {self.q_max:g} rad/m is {m0:g}",
                "give long_cutoff or rolloff, and short_cutoff, or a grid",
            )
        return replace(self, scale=self.scale * (rms**2 / m0))

    def _integral(self, n: int) -> float:
        """Return the integral of q^(n + dimension - 1) C(q) over the band."""
        bend = min(max(self.q_rolloff, self.q_min), self.q_max)
        total = _power_integral(n - 2 * self.hurst, bend, self.q_max)
        if bend > self.q_min:
            plateau = math.pow(self.q_rolloff, -2 * self.hurst - self.dimension)
            total += plateau * _power_integral(n + self.dimension, self.q_min, bend)
        return self.scale * total


@dataclass(frozen=True, slots=True)
class StretchedSpectrum:
    """The spectrum of an isotropic surface that was stretched along one direction and shrunk across it.

    ``C2D(qy, qx) = C(|q'|)`` with ``q'^2 = ratio q_along^2 + q_across^2 / ratio``: the rms height is unchanged, and
    the ratio of the correlation lengths along and across is `ratio`.

    Parameters
    ----------
    spectrum : callable
        ``C2D(|q|)`` [m^4]. Its limits become ellipses.
    ratio : float
        Correlation length along over that across, positive.
    angle : float
        Direction along which the structures are long, from the x axis towards the y axis [rad]. Because y runs down
        the rows, positive angles turn clockwise in the picture.

    Raises
    ------
    ValueError
        If `ratio` is not positive or `angle` not finite, or the spectrum is that of a line.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> spectrum = rc.StretchedSpectrum(rc.SelfAffineSpectrum(0.8, long_cutoff=16e-6), ratio=4)
    >>> surface = rc.synthesise(grid, spectrum, np.random.default_rng(1), rms=1e-6)
    >>> along, across = (rc.structure_profile(surface, axis, lags=[1]).value.item() for axis in "xy")
    >>> along < across
    True
    """

    spectrum: Callable[[Array], Array]
    ratio: float
    angle: float = 0.0

    def __post_init__(self) -> None:
        require_numbers(self, angle="rad")
        if not (math.isfinite(self.ratio) and self.ratio > 0):
            raise about("the ratio", f"of an anisotropy must be positive and finite, not {self.ratio}")
        if not math.isfinite(self.angle):
            raise about("the angle", f"of an anisotropy must be finite [rad], not {self.angle}")
        if getattr(self.spectrum, "dimension", 2) != 2:
            raise InputError(
                "a line has no direction", "omit the anisotropy, or make a surface (dimension=2)"
            )

    @numeric(qy="rad/m", qx="rad/m")
    def at(self, qy: Array, qx: Array) -> Array:
        """Return C2D at wave vectors.

        Parameters
        ----------
        qy, qx : array
            Components of the wave vectors [rad/m], of one shape.

        Returns
        -------
        array, the same shape
            C2D [m^4].

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> spectrum = rc.StretchedSpectrum(rc.SelfAffineSpectrum(0.8), ratio=4)  # long along x
        >>> along, across = spectrum.at(np.array([0.0, 1e5]), np.array([1e5, 0.0]))
        >>> f"{across / along:.0f}"  # 4^(2 (1 + H))
        '147'
        """
        cos, sin = math.cos(self.angle), math.sin(self.angle)
        along, across = qx * cos + qy * sin, qy * cos - qx * sin
        stretch = math.sqrt(self.ratio)
        return self.spectrum(np.hypot(stretch * along, across / stretch))


@dataclass(frozen=True, slots=True)
class DirectionalSpectrum:
    """A spectrum given as a function of the wave vector.

    Parameters
    ----------
    function : callable
        ``function(qy, qx)`` returns C2D [m^4] for arrays of components [rad/m] of any shape. The first component is
        that along y.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> ridges = rc.DirectionalSpectrum(lambda qy, qx: np.where(qy == 0, 1 / (1 + (qx / 1e5) ** 4), 0.0))
    >>> surface = rc.synthesise(grid, ridges, np.random.default_rng(1), rms=1e-6)
    >>> f"{surface.rms:.3g} m"
    '1e-06 m'
    """

    function: Callable[[Array, Array], Array]

    @numeric(qy="rad/m", qx="rad/m")
    def at(self, qy: Array, qx: Array) -> Array:
        """Return C2D at wave vectors.

        Parameters
        ----------
        qy, qx : array
            Components of the wave vectors [rad/m], of one shape.

        Returns
        -------
        array, the same shape
            C2D [m^4].

        Raises
        ------
        ValueError
            If the function is not even: heights are real, so q and -q are one wave.

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> ridges = rc.DirectionalSpectrum(lambda qy, qx: np.where(qy == 0, 1e-20, 0.0))
        >>> ridges.at(np.array([0.0, 1e5]), np.array([1e5, 1e5]))
        array([1.e-20, 0.e+00])
        """
        there, back = np.asarray(self.function(qy, qx)), np.asarray(self.function(-qy, -qx))
        if not np.allclose(there, back, rtol=1e-9, atol=0):
            raise InputError(
                "the spectrum must be the same at (qy, qx) and (-qy, -qx)", "use the mean of the two"
            )
        return there


def _power_integral(exponent: float, low: float, high: float) -> float:
    """Return the integral of q^(exponent - 1) from `low` to `high`, infinite where it diverges."""
    if not low < high:
        return 0.0
    if low == 0:
        return math.pow(high, exponent) / exponent if exponent > 0 else math.inf
    if high == math.inf:
        return -math.pow(low, exponent) / exponent if exponent < 0 else math.inf
    # Without the difference of two powers: exact down to exponent = 0, the logarithm (H = 0, 1, 2).
    ratio = math.log(high / low)
    return math.pow(low, exponent) * (math.expm1(exponent * ratio) / exponent if exponent else ratio)
