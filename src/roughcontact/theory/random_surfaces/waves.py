"""The waves of an isotropic surface, from the longest to the shortest, for Persson's theory."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Protocol, TypeAlias, cast

import numpy as np
import scipy.fft

from roughcontact.errors import InputError, about
from roughcontact.theory.tools.quadrature import gauss, graded, running
from roughcontact.validation import Array, number, pair, require, shown

__all__ = ["ContinuousSpectrum", "MeasuredSpectrum", "Spectrum", "Waves"]

START = 1e-9  # start of the graded panels, relative to the first wave: the weight of the rest before it
MERGED = 1e-3  # waves of a grid whose wavenumbers differ by less than this part count as one band


class ContinuousSpectrum(Protocol):
    """A continuous isotropic spectrum; `roughcontact.SelfAffineSpectrum` is one.

    Examples
    --------
    >>> import roughcontact as rc
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> f"{spectrum.q_min:.0f} to {spectrum.q_max:.0f} rad/m, C2D {float(spectrum(1e5)):.2e} m^4 at 1e5"
    '6283 to 628319 rad/m, C2D 3.04e-25 m^4 at 1e5'
    """

    @property
    def q_min(self) -> float:
        """Smallest wavenumber [rad/m]."""

    @property
    def q_max(self) -> float:
        """Largest wavenumber [rad/m]."""

    def __call__(self, wavenumber: Array, /) -> Array:
        """Return C2D [m^4] at the wavenumbers [rad/m]."""


class MeasuredSpectrum(Protocol):
    """A spectrum in bins; `roughcontact.PowerSpectrum` is one.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> spectrum = rc.power_spectrum(rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1)))
    >>> spectrum.kind, spectrum.density.shape == spectrum.wavenumber.shape
    ('C2D', True)
    """

    @property
    def wavenumber(self) -> Array:
        """Wavenumbers of the bins [rad/m], increasing."""

    @property
    def density(self) -> Array:
        """C2D of the bins [m^4]."""

    @property
    def kind(self) -> str:
        """``"C2D"`` of a surface or ``"C1D"`` of its profiles."""

    @property
    def q_min(self) -> float:
        """Lower end of the reliable band [rad/m]."""

    @property
    def q_max(self) -> float:
        """Upper end of that band [rad/m]."""


@dataclass(frozen=True, slots=True, eq=False)
class Waves:
    """Nodes of a quadrature over all waves of a surface: ``2 pi int q C2D f(q, g) dq = sum(power * f)``.

    Here g(q) is the rms slope of all waves longer than q. Create one by `of_spectrum`, `of_measured`, `of_heights` or
    `of_bands`, or by `of` from any description of the surface. It is a ``ProfileMoments``.

    Parameters
    ----------
    wavenumber : array, shape (n,)
        q at each node [rad/m], not decreasing.
    power : array, shape (n,)
        Mean square height represented by the node [m^2].
    slope : array, shape (n,)
        The rms slope g of the waves up to the node [-], increasing.

    Raises
    ------
    ValueError
        If the arrays do not fit together or are not positive and in order.

    Notes
    -----
    Integrands of the theory behave like 1/g, which at the longest wave q0 is ``(q - q0)^(-1/2)``; and at small
    pressures they have features at small g. The nodes are Gauss nodes on panels whose widths in g shrink geometrically
    towards g = 0, on which both are smooth.

    A single wave of the surface is the limit of a narrow band: q is constant, and g grows over several nodes from the
    slope of all longer waves to that including the wave.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> from roughcontact.theory import waves
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=6.4e-5, short_cutoff=4e-6).scaled(1e-6)
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.synthesise(grid, spectrum, np.random.default_rng(1), rms=1e-6)
    >>> made = [
    ...     waves.Waves.of_spectrum(spectrum),
    ...     waves.Waves.of_heights(surface.heights, grid.spacing),  # the very waves of a surface
    ...     waves.Waves.of_measured(rc.power_spectrum(surface)),
    ...     waves.Waves.of_bands(np.array([1e5, 1e6]), np.array([1e-12, 1e-14])),
    ... ]
    >>> [f"{each.rms_slope:.2f}" for each in made], waves.Waves.of(spectrum).m0 == made[0].m0
    (['0.28', '0.22', '0.21', '0.14'], True)
    """

    wavenumber: Array
    power: Array
    slope: Array

    def __post_init__(self) -> None:
        for name in ("wavenumber", "power", "slope"):
            value = np.array(getattr(self, name), dtype=np.float64)
            if value.ndim != 1 or value.shape != np.shape(self.wavenumber) or value.size == 0:
                raise InputError(
                    f"{name} must have one value for each node, not shape {value.shape}", place=name
                )
            if not (np.isfinite(value).all() and (value > 0).all()):
                raise InputError(f"{name} must be positive and finite at every node", place=name)
            value.flags.writeable = False
            object.__setattr__(self, name, value)
        if (np.diff(self.wavenumber) < 0).any() or (np.diff(self.slope) < 0).any():
            raise InputError("nodes must go from long waves to short ones", "sort them by wavenumber")

    @property
    def m0(self) -> float:
        """Mean square height [m^2]."""
        return float(self.power.sum())

    @property
    def m2(self) -> float:
        """Mean square slope of a profile [-], half of that of the surface."""
        return float(self.wavenumber**2 @ self.power) / 2

    @property
    def m4(self) -> float:
        """Mean square curvature of a profile [1/m^2]."""
        return 3 / 8 * float(self.wavenumber**4 @ self.power)

    @property
    def rms_slope(self) -> float:
        """Root mean square of ``|grad z|`` over all waves [-]."""
        return math.sqrt(2 * self.m2)

    @classmethod
    def of(cls, spectrum: Spectrum) -> Waves:
        """Return the waves of any description of a surface: waves, a measured spectrum or a continuous one.

        Parameters
        ----------
        spectrum : Waves, measured or continuous spectrum
            Waves, a measured spectrum or a continuous one.

        Returns
        -------
        Waves
        """
        if isinstance(spectrum, Waves):
            return spectrum
        if hasattr(spectrum, "wavenumber") and hasattr(spectrum, "density"):
            return cls.of_measured(cast(MeasuredSpectrum, spectrum))
        if callable(spectrum):
            return cls.of_spectrum(spectrum)
        raise InputError(
            f"Waves, a measured spectrum or an isotropic spectrum C2D(q) is needed, not {shown(spectrum)}; for a "
            "surface use rc.power_spectrum(surface), for one with a lay Waves.of_heights(heights, spacing)",
            place="spectrum",
        )

    @classmethod
    def of_spectrum(
        cls,
        spectrum: ContinuousSpectrum,
        q_min: float | None = None,
        q_max: float | None = None,
        breaks: Iterable[float] = (),
    ) -> Waves:
        """Return the waves of a continuous isotropic spectrum.

        Parameters
        ----------
        spectrum : callable
            C2D(q) [m^4].
        q_min, q_max : float, optional
            The band [rad/m], within that of the spectrum. A smaller `q_max` is a smaller magnification.
        breaks : iterable of float
            Wavenumbers at which the spectrum has a corner [rad/m]; `q_rolloff` of the spectrum is always included.

        Returns
        -------
        Waves

        Raises
        ------
        ValueError
            If the band is not finite, or the spectrum is that of a line, negative or zero.
        """
        if getattr(spectrum, "dimension", 2) != 2:
            raise InputError("Persson's theory needs the spectrum C2D of a surface, not that of a line")
        low = max(getattr(spectrum, "q_min", 0.0), 0.0 if q_min is None else q_min)
        high = min(getattr(spectrum, "q_max", math.inf), math.inf if q_max is None else q_max)
        if not low > 0:
            raise about(
                "the spectrum",
                "has no longest wave, as of an infinite surface",
                "give long_cutoff, or q_min, 2 pi over the side of the surface [rad/m]",
            )
        if not math.isfinite(high):
            raise about(
                "the spectrum",
                "has no shortest wave, and the contact area depends on it",
                "give short_cutoff, or q_max [rad/m]",
            )
        corner = getattr(spectrum, "q_rolloff", 0.0)
        return _of_density(spectrum, low, high, np.array([corner, *breaks], dtype=np.float64))

    @classmethod
    def of_measured(
        cls, spectrum: MeasuredSpectrum, q_min: float | None = None, q_max: float | None = None
    ) -> Waves:
        """Return the waves of a measured spectrum of a surface, a power law between its bins.

        Parameters
        ----------
        spectrum : MeasuredSpectrum
            For example from `roughcontact.power_spectrum`.
        q_min, q_max : float, optional
            The band [rad/m]; by default the reliable band. The area depends on `q_max`: state it.

        Returns
        -------
        Waves

        Raises
        ------
        ValueError
            If the spectrum is that of profiles, or fewer than two bins with power lie in the band.
        """
        if spectrum.kind != "C2D":
            raise InputError(
                f"Persson's theory needs the spectrum C2D of a surface, not {spectrum.kind}",
                "convert the spectrum of profiles by roughcontact.surface_spectrum",
            )
        low = spectrum.q_min if q_min is None else q_min
        high = spectrum.q_max if q_max is None else q_max
        q, density = np.asarray(spectrum.wavenumber), np.asarray(spectrum.density)
        keep = (q >= low * (1 - 1e-9)) & (q <= high * (1 + 1e-9)) & (density > 0)
        require(keep.sum() >= 2, f"two bins with power are needed between {low:g} and {high:g} rad/m")
        ln_q, ln_c = np.log(q[keep]), np.log(density[keep])
        bins = np.asarray(q[keep])
        return _of_density(lambda x: np.exp(np.interp(np.log(x), ln_q, ln_c)), bins[0], bins[-1], bins)

    @classmethod
    def of_heights(cls, heights: Array, spacing: tuple[float, float]) -> Waves:
        """Return the waves of heights, as one period of a surface; directions are averaged.

        Parameters
        ----------
        heights : array, shape (ny, nx)
            [m]. Steps between opposite edges count as roughness.
        spacing : tuple of float
            Size of a cell ``(dy, dx)`` [m].

        Returns
        -------
        Waves

        Raises
        ------
        ValueError
            If the heights are not a map, have missing points or are flat.
        """
        z = np.asarray(number(heights, "heights [m]"))
        require(z.ndim == 2, f"heights must have two axes, not {z.ndim}", place="heights")
        require(
            np.isfinite(z), "heights hold points that were not measured", "fill them first", place="heights"
        )
        (ny, nx), (dy, dx) = z.shape, map(float, pair(spacing, "the spacing (dy, dx) [m]"))
        power = np.abs(scipy.fft.rfft2(z - z.mean()) / z.size) ** 2
        # Every column stands for q and -q, except the first and, for an even number, the last.
        power[:, 1 : (nx + 1) // 2] *= 2
        q = 2 * np.pi * np.hypot(scipy.fft.fftfreq(ny, dy)[:, None], scipy.fft.rfftfreq(nx, dx))
        waves = (q > 0) & (power > 0)
        require(waves.any(), "the heights are flat: contact is full at any load", place="heights")
        q, power = q[waves], power[waves]
        band = np.rint(np.log(q / q.min()) / MERGED).astype(np.int64)
        sums, squares = np.bincount(band, power).astype(float), np.bincount(band, power * q**2).astype(float)
        full = sums > 0
        return cls.of_bands(np.sqrt(squares[full] / sums[full]), sums[full])

    @classmethod
    def of_bands(cls, wavenumber: Array, power: Array) -> Waves:
        """Return the waves of narrow bands: wavenumbers [rad/m], increasing, and the mean square height of each [m^2].

        Parameters
        ----------
        wavenumber : array, shape (n,)
            Wavenumber of each band, increasing [rad/m].
        power : array, shape (n,)
            Mean square height of each band [m^2].

        Returns
        -------
        Waves

        Raises
        ------
        ValueError
            If wavenumbers do not increase from above zero, or a power is not positive.
        """
        q, m = (
            np.asarray(number(x, what))
            for x, what in ((wavenumber, "wavenumber [rad/m]"), (power, "power [m^2]"))
        )
        if not (q.ndim == 1 and q.shape == m.shape and q.size and q[0] > 0 and (np.diff(q) > 0).all()):
            raise InputError("bands need increasing, positive wavenumbers and one power each")
        require(
            np.isfinite(m) & (m > 0), "the power of every band must be positive and finite", place="power"
        )
        ends = np.sqrt(np.cumsum(q**2 * m))
        edges = np.union1d(graded(START * ends[0], ends[-1], 1.2), ends)
        x, weights = gauss(4)
        width = np.diff(edges)[:, None]
        slope = edges[:-1, None] + width * x
        inside = q[np.searchsorted(ends, edges[1:])][:, None]
        # q^2 d(power) = d(g^2) = 2 g dg
        return cls(
            np.broadcast_to(inside, slope.shape).ravel(),
            (2 * slope * width * weights / inside**2).ravel(),
            slope.ravel(),
        )


Spectrum: TypeAlias = Waves | MeasuredSpectrum | ContinuousSpectrum


def _of_density(density: Callable[[Array], Array], low: float, high: float, breaks: Array) -> Waves:
    """Return the waves of C2D(q) on a finite band, smooth between the breaks."""
    require(0 < low < high, f"no wave lies between {low:g} and {high:g} rad/m")
    corners = np.sqrt(breaks[(breaks > low) & (breaks < high)] / low - 1)
    end = math.sqrt(high / low - 1)
    s_edges = np.union1d(np.append(graded(START * min(end, 1.0), end, 1.5), end), corners)
    x, weights = gauss(8)
    width = np.diff(s_edges)[:, None]
    s = s_edges[:-1, None] + width * x
    q = low * (1 + s**2)
    values = np.asarray(density(q.ravel()), dtype=np.float64).reshape(q.shape)
    usable = np.isfinite(values) & (values >= 0)
    require(usable, "the spectrum must be finite and not negative between its limits")
    powers = 2 * math.pi * q * values * (2 * low * s * width)
    squares = q**2 * powers
    before = np.concatenate([[0.0], np.cumsum(squares @ weights)[:-1]])[:, None]
    # Where almost no power is left, rounding must not reverse the order.
    slope = np.maximum.accumulate(np.sqrt(np.maximum(before + squares @ running(x).T, 0)).ravel()).reshape(
        q.shape
    )
    keep = (powers > 0) & (slope > 0)
    require(keep.any(), "the spectrum is zero between its limits: contact is full at any load")
    return Waves(q[keep], (powers * weights)[keep], slope[keep])
