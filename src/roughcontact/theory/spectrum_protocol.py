"""What theories of random surfaces ask of a surface beyond its moments: its spectrum."""

from __future__ import annotations

from typing import Protocol

from roughcontact.validation import Array

__all__ = ["MeasuredSpectrum", "RadialSpectrum"]


class RadialSpectrum(Protocol):
    """A continuous isotropic spectrum; `roughcontact.SelfAffineSpectrum` is one."""

    @property
    def q_min(self) -> float:
        """Smallest wavenumber [rad/m]."""
        ...

    @property
    def q_max(self) -> float:
        """Largest wavenumber [rad/m]."""
        ...

    def __call__(self, wavenumber: Array, /) -> Array:
        """Return C2D [m^4] at the wavenumbers [rad/m]."""
        ...


class MeasuredSpectrum(Protocol):
    """A spectrum in bins; `roughcontact.PowerSpectrum` is one."""

    @property
    def wavenumber(self) -> Array:
        """Wavenumbers of the bins [rad/m], increasing."""
        ...

    @property
    def density(self) -> Array:
        """C2D of the bins [m^4]."""
        ...

    @property
    def kind(self) -> str:
        """``"C2D"`` of a surface or ``"C1D"`` of its profiles."""
        ...

    @property
    def q_min(self) -> float:
        """Lower end of the band that is to be relied upon [rad/m]."""
        ...

    @property
    def q_max(self) -> float:
        """Upper end of that band [rad/m]."""
        ...
