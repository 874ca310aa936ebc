"""The spectrum of the rough line that is equivalent to a rough surface (thesis, eqs 4.54 and A.73)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from roughcontact.errors import InputError
from roughcontact.surface.analysis.power import PowerSpectrum
from roughcontact.surface.moments import Moments
from roughcontact.validation import Array, positive_scalar, shown

__all__ = ["LineSpectrum", "TabulatedSpectrum", "line_spectrum"]


@dataclass(frozen=True, slots=True)
class LineSpectrum:
    """``C1D(q) = factor q C2D(q)``, two-sided.

    A spectrum with a plateau (`rolloff`) gives a line whose spectrum rises on it.

    Parameters
    ----------
    surface : callable
        C2D(q) [m^4] of an isotropic surface at wavenumbers [rad/m], such as a `SelfAffineSpectrum`.
    factor : float
        lambda, see `line_spectrum`.

    Raises
    ------
    ValueError
        If the factor is not positive, or the spectrum is not a function, or is that of a line or of profiles.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.mdr import equivalent_line
    >>> surface = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> line = equivalent_line.LineSpectrum(surface)
    >>> f"{line.moments().rms_height * 1e6:.6f} um", f"{line(1e5) / surface(1e5) / 1e5:.4f}"  # factor pi
    ('1.000000 um', '3.1416')
    """

    surface: Callable[[Array], Array]
    factor: float = math.pi

    def __post_init__(self) -> None:
        if not callable(self.surface):
            raise InputError(
                "a spectrum C2D(q) is needed, such as a SelfAffineSpectrum or rc.power_spectrum(surface), not "
                f"{shown(self.surface)}",
                place="surface",
            )
        if getattr(self.surface, "dimension", 2) != 2 or getattr(self.surface, "kind", "C2D") != "C2D":
            raise InputError(
                "the spectrum C2D of a surface is needed, not that of a line; convert one of profiles by "
                "roughcontact.surface_spectrum"
            )
        positive_scalar(self.factor, "factor")

    @property
    def dimension(self) -> int:
        """One: the spectrum of a line."""
        return 1

    @property
    def q_min(self) -> float:
        """Smallest wavenumber [rad/m]; 0 if the surface has no long cut-off."""
        return float(getattr(self.surface, "q_min", 0.0))

    @property
    def q_max(self) -> float:
        """Largest wavenumber [rad/m]; infinite if the surface has no short cut-off."""
        return float(getattr(self.surface, "q_max", math.inf))

    def __call__(self, wavenumber: Array) -> Array:
        """Return C1D [m^3] at the wavenumbers [rad/m]."""
        q = np.asarray(wavenumber, dtype=np.float64)
        return np.asarray(self.factor * q * self.surface(q))

    def moments(self) -> Moments:
        """Return the moments of the line, ``mn = 2 int q^n C1D dq``, from those of the surface.

        With factor pi m0 is that of the surface, and m2 twice that of its profiles: the rms slope of the line
        is the rms gradient of the surface.

        Returns
        -------
        Moments

        Raises
        ------
        AttributeError
            If the spectrum of the surface has no moments.
        """
        surface: Any = self.surface
        moments, part = surface.moments(), self.factor / math.pi
        return Moments(part * moments.m0, part * 2 * moments.m2, part * 8 / 3 * moments.m4, dimension=1)


@dataclass(frozen=True, slots=True, eq=False)
class TabulatedSpectrum:
    """A measured spectrum C2D as a function: a power law between its bins, absent outside its band.

    Parameters
    ----------
    spectrum : PowerSpectrum
        Of kind C2D. The band from its `q_min` to its `q_max` is used; if it extends slightly beyond the outermost bins
        with power, their laws are continued.

    Raises
    ------
    ValueError
        If it is the spectrum of profiles, or fewer than two bins with power lie in the band.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> from roughcontact.mdr import equivalent_line
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> spectrum = rc.power_spectrum(rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1)))
    >>> measured = equivalent_line.TabulatedSpectrum(spectrum)
    >>> bool(np.allclose(measured(spectrum.wavenumber[10:12]), spectrum.density[10:12]))
    True
    >>> measured(np.array([1e9])).tolist()  # beyond its band
    [0.0]
    """

    spectrum: PowerSpectrum

    def __post_init__(self) -> None:
        if self.spectrum.kind != "C2D":
            raise InputError(
                "this is the spectrum of profiles", "convert it by roughcontact.surface_spectrum"
            )
        if np.count_nonzero(self.spectrum.within().density) < 2:
            raise InputError("two bins with power are needed between q_min and q_max")

    @property
    def q_min(self) -> float:
        """Smallest wavenumber [rad/m]."""
        return self.spectrum.q_min

    @property
    def q_max(self) -> float:
        """Largest wavenumber [rad/m]."""
        return self.spectrum.q_max

    def __call__(self, wavenumber: Array) -> Array:
        """Return C2D [m^4] at the wavenumbers [rad/m]."""
        q = np.asarray(wavenumber, dtype=np.float64)
        band = self.spectrum.within()
        ln_q, ln_c = (np.log(a[band.density > 0]) for a in (band.wavenumber, band.density))
        inside = (q >= self.q_min * (1 - 1e-9)) & (q <= self.q_max * (1 + 1e-9))
        x = np.log(q, where=inside, out=np.zeros_like(q))
        stretch = np.clip(np.searchsorted(ln_q, x) - 1, 0, ln_q.size - 2)
        slope = np.diff(ln_c) / np.diff(ln_q)
        return np.where(inside, np.exp(ln_c[stretch] + slope[stretch] * (x - ln_q[stretch])), 0.0)


def line_spectrum(
    spectrum: PowerSpectrum | Callable[[Array], Array], factor: float = math.pi
) -> LineSpectrum:
    """Return the spectrum of the line that is equivalent to an isotropic surface, ``C1D = factor q C2D``.

    Parameters
    ----------
    spectrum : callable or PowerSpectrum
        C2D(q) [m^4], or a measured C2D.
    factor : float
        pi: line and surface have the same rms height as integrals over all waves (eqs 4.54, A.73). `lambda_rms`: they
        have the same rms height as sums over the waves of a grid (A.76 as corrected). The factor of eq. 4.75: they
        have the same stiffness at low loads, but different rms heights.

    Returns
    -------
    LineSpectrum

    Raises
    ------
    ValueError
        If the spectrum is not that of a surface, or the factor not positive.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.mdr import equivalent_line
    >>> surface = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> line = equivalent_line.line_spectrum(surface)
    >>> round(line.moments().m0 / surface.moments().m0, 6), round(line.moments().m2 / surface.moments().m2, 6)
    (1.0, 2.0)
    """
    surface = TabulatedSpectrum(spectrum) if isinstance(spectrum, PowerSpectrum) else spectrum
    return LineSpectrum(surface, factor)
