"""The power spectrum of a self-affine surface, up to its scale."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

__all__ = ["SelfAffineSpectrum"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SelfAffineSpectrum:
    """The shape of C2D(q), a power law q^(-2(H+1)) between its limits (thesis, eqs 2.13 and fig. 34).

    Only the shape: the scale of a surface is its rms height, set after synthesis.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, from -1 (white) to 3.
    rolloff_wavelength : float, optional
        Longer waves than this [m] have the amplitude of this one (a plateau).
    cutoff_wavelength : float, optional
        Longer waves than this [m] are absent.
    short_wavelength : float, optional
        Shorter waves than this [m] are absent.

    Raises
    ------
    ValueError
        If H is out of range, or a wavelength is not positive, or the limits leave no wave.
    """

    hurst: float
    rolloff_wavelength: float | None = None
    cutoff_wavelength: float | None = None
    short_wavelength: float | None = None

    def __post_init__(self) -> None:
        if not -1 <= self.hurst <= 3:
            raise ValueError(f"hurst must lie between -1 and 3, not {self.hurst}")
        for name in ("rolloff_wavelength", "cutoff_wavelength", "short_wavelength"):
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and value > 0):
                raise ValueError(f"{name} must be positive and finite [m], not {value}")
        longest = min(v for v in (self.cutoff_wavelength, math.inf) if v is not None)
        if self.short_wavelength is not None and not self.short_wavelength <= longest:
            raise ValueError(
                f"short_wavelength {self.short_wavelength} m exceeds cutoff_wavelength {longest} m: no wave is left"
            )

    def __call__(self, wavenumber: Array) -> Array:
        """Return C2D(q)/C2D(1) at the `wavenumber` q [rad/m]; zero at q = 0."""
        q = np.asarray(wavenumber, dtype=np.float64)
        plateau = 0.0 if self.rolloff_wavelength is None else 2 * math.pi / self.rolloff_wavelength
        bent = np.maximum(q, plateau)
        with np.errstate(divide="ignore"):
            shape = np.where(q > 0, bent ** (-2 * (self.hurst + 1)), 0.0)
        # A wave that sits on a limit belongs to the spectrum, whatever the last digit of its wavelength.
        if self.cutoff_wavelength is not None:
            shape[q < 2 * math.pi / self.cutoff_wavelength * (1 - 1e-9)] = 0
        if self.short_wavelength is not None:
            shape[q > 2 * math.pi / self.short_wavelength * (1 + 1e-9)] = 0
        return shape
