"""What theories of random surfaces ask of a surface: its profile moments."""

from __future__ import annotations

from typing import Protocol

__all__ = ["ProfileMoments"]


class ProfileMoments(Protocol):
    """Moments of a straight cut through an isotropic surface (Nayak 1971); `roughcontact.Moments` is one."""

    @property
    def m0(self) -> float:
        """Mean square height [m^2]."""
        ...

    @property
    def m2(self) -> float:
        """Mean square slope of a profile [-]; that of the surface is ``2 m2``."""
        ...

    @property
    def m4(self) -> float:
        """Mean square curvature of a profile [1/m^2]."""
        ...
