"""The power spectrum: density over wavenumber, and its uncertainty."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError, about
from roughcontact.validation import Array, number, numeric, require, require_numbers, shown

__all__ = ["PowerSpectrum", "require_measured"]

_ARRAYS = ("wavenumber", "density", "count", "freedom")


@dataclass(frozen=True, slots=True, eq=False)
class PowerSpectrum:
    """A spectrum of heights in bins of increasing wavenumber, in the thesis' normalisation.

    Parameters
    ----------
    wavenumber : array, shape (n,)
        Geometric mean of the wavenumbers in each bin [rad/m].
    density : array, shape (n,)
        Mean power spectral density of the bin: C2D [m^4] or two-sided C1D [m^3].
    kind : {"C2D", "C1D"}
        Of the surface, ``<h^2> = 2 pi int q C2D dq``, or of its profiles, ``<h^2> = 2 int C1D dq``.
    count : array, shape (n,)
        Number of waves in each bin, both signs of the wave vector, over all profiles.
    freedom : array, shape (n,)
        Effective number of independent waves in the mean: its relative variance is ``1/freedom``.
        Opposite wave vectors, waves under one window and neighbouring profiles are not independent.
    q_min, q_max : float
        The band in which the spectrum is reliable [rad/m].
    smear : float
        Second moment of the window's kernel along an axis [rad^2/m^2]; 0 without a window.

    Raises
    ------
    ValueError
        If the arrays do not fit together, or the wavenumbers do not increase from above zero.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> q = np.geomspace(1e4, 1e6, 21)
    >>> waves = np.full(q.size, 100.0)
    >>> spectrum = rc.PowerSpectrum(q, 1e-4 * q**-3.6, "C2D", count=2 * waves, freedom=waves, q_min=1e4, q_max=1e6)
    >>> f"{spectrum.wavelength[0] * 1e6:.0f} um, to {spectrum.standard_error[0] / spectrum.density[0]:.0%}"
    '628 um, to 10%'
    """

    wavenumber: Array
    density: Array
    kind: Literal["C2D", "C1D"]
    count: Array
    freedom: Array
    q_min: float
    q_max: float
    smear: float = 0.0

    def __post_init__(self) -> None:
        require(self.kind in ("C2D", "C1D"), f"kind must be 'C2D' or 'C1D', not {self.kind!r}", place="kind")
        require_numbers(
            self,
            wavenumber="rad/m",
            density="m^4" if self.kind == "C2D" else "m^3",
            q_min="rad/m",
            q_max="rad/m",
            smear="rad^2/m^2",
        )
        for name in _ARRAYS:
            value = np.array(number(getattr(self, name), name))
            if value.ndim != 1 or value.shape != np.shape(self.wavenumber):
                raise InputError(
                    f"{name} must have one value for each wavenumber, not shape {value.shape}", place=name
                )
            value.flags.writeable = False
            object.__setattr__(self, name, value)
        if not (self.wavenumber.size and self.wavenumber[0] > 0 and (np.diff(self.wavenumber) > 0).all()):
            raise InputError("wavenumbers must be positive and increase, and there must be at least one")
        if not (np.isfinite(self.density).all() and (self.density >= 0).all()):
            raise InputError("densities must be finite and not negative")
        require((self.freedom > 0).all(), "the freedom of every bin must be positive", place="freedom")

    @property
    def wavelength(self) -> Array:
        """Wavelength of each bin, 2 pi/q [m]."""
        return 2 * np.pi / self.wavenumber

    @property
    def standard_error(self) -> Array:
        """Standard error of each density, for a Gaussian surface."""
        return self.density / np.sqrt(self.freedom)

    @numeric(q_min="rad/m", q_max="rad/m")
    def within(self, q_min: float | None = None, q_max: float | None = None) -> PowerSpectrum:
        """Return the spectrum in a narrower band.

        Parameters
        ----------
        q_min, q_max : float, optional
            The band [rad/m]; by default the reliable band.

        Returns
        -------
        PowerSpectrum
            The bins from `q_min` to `q_max`, which become its band.

        Raises
        ------
        ValueError
            If no bin lies in the band.

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
        >>> spectrum = rc.power_spectrum(rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1)))
        >>> band = spectrum.within(q_max=1e6)
        >>> bool(band.wavenumber.max() <= 1e6), f"{band.q_max:.0e} rad/m"
        (True, '1e+06 rad/m')
        """
        low = self.q_min if q_min is None else q_min
        high = self.q_max if q_max is None else q_max
        keep = (self.wavenumber >= low * (1 - 1e-9)) & (self.wavenumber <= high * (1 + 1e-9))
        if not keep.any():
            least, most = self.wavenumber[0], self.wavenumber[-1]
            raise InputError(
                f"no wave lies between {low:g} and {high:g} rad/m: the spectrum has {least:g} to {most:g} rad/m, waves "
                f"from {2 * np.pi / least:.3g} m down to {2 * np.pi / most:.3g} m"
            )
        return replace(self.selected(keep), q_min=low, q_max=high)

    def selected(self, keep: npt.NDArray[np.bool_]) -> PowerSpectrum:
        """Return some of the bins, with the same band.

        Parameters
        ----------
        keep : bool array, shape (n,)
            The bins to keep; at least one.

        Returns
        -------
        PowerSpectrum

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
        >>> spectrum = rc.power_spectrum(rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1)))
        >>> f"{spectrum.selected(spectrum.wavelength < 1e-5).wavelength.max() * 1e6:.1f} um"
        '9.1 um'
        """
        arrays = {name: getattr(self, name)[keep] for name in _ARRAYS}
        return replace(self, **arrays)

    @numeric
    def rebinned(self, per_decade: float) -> PowerSpectrum:
        """Return the spectrum in coarser bins.

        The densities and the logarithms of the wavenumbers are averaged with the freedom of each bin as weight.

        Parameters
        ----------
        per_decade : float
            Bins to a factor of ten in wavenumber.

        Returns
        -------
        PowerSpectrum
            Bins without a wave are left out.

        Raises
        ------
        ValueError
            If `per_decade` is not positive.

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
        >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
        >>> fine = rc.power_spectrum(surface)
        >>> fine.wavenumber.size, fine.rebinned(5).wavenumber.size
        (32, 8)
        """
        require(per_decade > 0, f"per_decade must be positive, not {per_decade}", place="per_decade")
        logs = np.log(self.wavenumber)
        index = np.floor(logs / math.log(10) * per_decade + 1e-9).astype(np.int64)
        _, group = np.unique(index, return_inverse=True)
        freedom = np.asarray(np.bincount(group, self.freedom), dtype=np.float64)
        return replace(
            self,
            wavenumber=np.exp(np.bincount(group, self.freedom * logs) / freedom),
            density=np.bincount(group, self.freedom * self.density) / freedom,
            count=np.asarray(np.bincount(group, self.count), dtype=np.float64),
            freedom=freedom,
        )


def require_measured(spectrum: PowerSpectrum) -> None:
    """Refuse anything that is not a measured spectrum, such as a formula.

    Raises
    ------
    ValueError
        The message names the function to call instead.
    """
    if not isinstance(spectrum, PowerSpectrum):
        raise about(
            "spectrum",
            f"must be a PowerSpectrum, as rc.power_spectrum returns it, not {shown(spectrum)}",
            "for a spectrum by formula use its moments(), or rc.grid_moments(grid, spectrum)",
        )
