"""The input of theories of random surfaces: profile moments."""

from __future__ import annotations

from typing import Literal, Protocol

from roughcontact.errors import about
from roughcontact.validation import positive, shown

__all__ = ["ProfileMoments", "moment"]


class ProfileMoments(Protocol):
    """Moments of a straight cut through an isotropic surface (Nayak 1971); `roughcontact.Moments` is one."""

    @property
    def m0(self) -> float:
        """Mean square height [m^2]."""

    @property
    def m2(self) -> float:
        """Mean square slope of a profile [-]; that of the surface is ``2 m2``."""

    @property
    def m4(self) -> float:
        """Mean square curvature of a profile [1/m^2]."""


def moment(moments: ProfileMoments, name: Literal["m0", "m2", "m4"], note: str = "") -> float:
    """Return one of the moments; a `note` on it goes into the message.

    Raises
    ------
    ValueError
        If `moments` has no moments, or this one is not positive and finite.
    """
    if not hasattr(moments, name):
        raise about(
            "the moments",
            f"m0, m2 and m4 of a surface are needed, for example from rc.surface_moments(surface) or "
            f"spectrum.moments(), not {shown(moments)}",
        )
    return float(positive(getattr(moments, name), f"the moment {name}{note}"))
