"""Hardness as one number, as one number for each cell, or as a function of the size of the contact spots."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from roughcontact.arrays import as_like, is_array, is_numpy, namespace
from roughcontact.errors import about
from roughcontact.materials import Material, hardness_of
from roughcontact.units import in_si
from roughcontact.validation import Array, number, positive_scalar, require_numbers, scalar

__all__ = ["Hardness", "NixGao", "SizeLaw", "as_hardness"]

SizeLaw: TypeAlias = Callable[[Array], Array]
"""Hardness [Pa] from the radii of contact spots [m]."""

Hardness: TypeAlias = float | Array | SizeLaw | Material | str


@dataclass(frozen=True, slots=True)
class NixGao:
    """The hardness of small spots: ``H(a) = H0 sqrt(1 + a0/a)`` (Nix and Gao, J. Mech. Phys. Solids 46, 411, 1998).

    Their law depends on the depth h of a cone or pyramid, ``H0 sqrt(1 + h0/h)``. With ``h = a tan(theta)``, where theta
    is the angle between its face and the surface, ``a0 = h0/tan(theta)``.

    Parameters
    ----------
    hardness : float
        Hardness of large spots, H0 [Pa].
    radius : float
        Radius a0 [m] of the spot whose hardness is larger by the square root of two.

    Raises
    ------
    ValueError
        If a parameter is not positive and finite.

    Examples
    --------
    >>> import roughcontact as rc
    >>> law = rc.NixGao(hardness=1e9, radius=1e-6)
    >>> f"{law(1e-6) / 1e9:.3f}, {law(1e-3) / 1e9:.3f}"
    '1.414, 1.000'
    """

    hardness: float
    radius: float

    def __post_init__(self) -> None:
        require_numbers(self, hardness="Pa", radius="m")
        positive_scalar(self.hardness, "the hardness of large spots [Pa]")
        positive_scalar(self.radius, "the radius [m]")

    def __call__(self, radius: float | Array) -> Array:
        """Return the hardness of spots.

        Parameters
        ----------
        radius : array
            Radii of the spots [m]: of discs of the same area.

        Returns
        -------
        array, of the same shape
            [Pa]
        """
        return np.asarray(self.hardness * np.sqrt(1 + self.radius / np.asarray(in_si(radius, "m", "radius"))))


def as_hardness(hardness: Any, field: Array) -> tuple[float | Array, SizeLaw | None]:
    """Return the hardness [Pa], a number or an array like `field`, and the size law if `hardness` is one."""
    hardness = hardness_of(hardness)
    if hardness is None:
        return math.inf, None
    if callable(hardness):
        return math.inf, hardness
    if np.ndim(hardness) == 0:
        return scalar(hardness, "hardness"), None
    elsewhere = is_array(hardness) and not is_numpy(hardness)
    values = hardness if elsewhere else as_like(number(hardness, "hardness"), field)
    xp = namespace(values)
    if not bool(xp.all((values > 0) & (values < math.inf))):
        raise about(
            "the hardness",
            "of every cell must be positive and finite [Pa]: use a large number for a cell that never flows",
        )
    return values, None
