"""Hardness of one number, of one for each cell, or by the size of the contact spots."""

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

    Their law is of the depth h of a cone or pyramid, ``H0 sqrt(1 + h0/h)``; with ``h = a tan(theta)``, theta the
    angle between its face and the surface, ``a0 = h0/tan(theta)``.

    Parameters
    ----------
    hardness : float
        Hardness of large spots, H0 [Pa].
    radius : float
        Radius of the spot that is harder by the square root of two, a0 [m].

    Raises
    ------
    ValueError
        If one of them is not positive and finite.

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
            Radii of the spots [m]: of discs of their areas.

        Returns
        -------
        array, of the same shape
            [Pa]
        """
        return np.asarray(self.hardness * np.sqrt(1 + self.radius / np.asarray(in_si(radius, "m", "radius"))))


def as_hardness(hardness: Any, field: Array) -> tuple[float | Array, SizeLaw | None]:
    """Return the hardness [Pa], a number or beside a field, and the law that gives it instead."""
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
            "of every cell must be positive and finite [Pa]: one that never flows takes a large number",
        )
    return values, None
