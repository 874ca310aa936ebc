r"""Independent adhesive asperities of Gaussian heights under a flat at the separation s of the mean planes.

    p(s) = n int F(z - s) phi(z) dz

over the heights z of the asperities in contact, with their density n. For Fuller and Tabor (Proc. R. Soc. A 345, 327
(1975)) F is the force of Johnson, Kendall and Roberts, and the flat is retracted: an asperity stays in contact down to
the smallest depth of an equilibrium. For Maugis (J. Adhesion Sci. Technol. 10, 161 (1996)) it is Hertz's force less 2
pi w R, on the asperities above the flat.

Asperities do not interact: the theory is for small contact areas and nominally flat surfaces.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize_scalar

from roughcontact.errors import about
from roughcontact.theory.adhesive.adhesive_sphere import DMTSphere, JKRSphere
from roughcontact.theory.tools.quadrature import gauss
from roughcontact.validation import Array, number, numeric, positive_scalar, shown

__all__ = ["AdhesiveAsperities", "Limit"]

Limit = Literal["jkr", "dmt"]
HIGHEST = 9.0  # standard deviations: 1e-19 of the asperities are higher
NODES = 400
SAMPLES = 200  # separations at which the search for the largest tension starts


@dataclass(frozen=True, slots=True)
class AdhesiveAsperities:
    """Adhesive spherical asperities of one radius and Gaussian heights.

    Parameters
    ----------
    density : float
        Asperities per area n [1/m^2].
    std : float
        Standard deviation of their heights [m].
    radius : float
        Radius R [m].
    modulus : float
        Reduced modulus E* [Pa].
    work : float
        Work of adhesion w [J/m^2].
    limit : {"jkr", "dmt"}
        Asperities of Fuller and Tabor, or of Maugis.

    Raises
    ------
    ValueError
        If a number is not positive and finite, or `limit` is unknown.

    Examples
    --------
    >>> from roughcontact.theory import adhesive_asperities
    >>> for std in (1e-8, 1e-7, 1e-6):
    ...     rubber = adhesive_asperities.AdhesiveAsperities(1e9, std, radius=1e-5, modulus=1e6, work=10e-3)
    ...     print(f"{rubber.roughness_number:.2f}: pull-off {rubber.pull_off_pressure:.3g} Pa")
    0.06: pull-off 470 Pa
    0.62: pull-off 346 Pa
    6.22: pull-off 0.0105 Pa
    >>> f"{float(rubber.pressure(0.0)):.3g} Pa on {float(rubber.contact_fraction(0.0)):.3f} of the area"
    '1.61e+03 Pa on 0.020 of the area'
    """

    density: float
    std: float
    radius: float
    modulus: float
    work: float
    limit: Limit = "jkr"

    def __post_init__(self) -> None:
        for name in ("density", "std", "radius", "modulus", "work"):
            positive_scalar(getattr(self, name), f"the {name}")
        if self.limit not in get_args(Limit):
            raise about("the limit", f"must be one of 'jkr', 'dmt', not {shown(self.limit)}")

    @property
    def roughness_number(self) -> float:
        """Standard deviation of the heights over the length by which an asperity stretches before it detaches."""
        return self.std / -self._stuck.least_depth

    @numeric
    def pressure(self, separation: npt.ArrayLike) -> Array:
        """Return the mean pressure at a separation, tension negative.

        Parameters
        ----------
        separation : float or array
            Of the flat from the mean plane of the asperities [m].

        Returns
        -------
        float or array
            p [Pa].
        """
        return self._summed(separation, self._sphere.force)

    @numeric
    def contact_fraction(self, separation: npt.ArrayLike) -> Array:
        """Return the contact area over the nominal area at a separation.

        Parameters
        ----------
        separation : float or array
            Of the flat from the mean plane of the asperities [m].

        Returns
        -------
        float or array
            A/A0.
        """
        return self._summed(separation, lambda a: np.asarray(math.pi * a**2))

    @property
    def pull_off_pressure(self) -> float:
        """Largest mean tension [Pa], positive: zero if there is none."""
        reach = HIGHEST * self.std
        separations = np.linspace(-reach, reach - self._least, SAMPLES)
        pressures = self.pressure(separations)
        k = int(np.argmin(pressures))
        ends = separations[max(k - 1, 0)], separations[min(k + 1, SAMPLES - 1)]
        found = minimize_scalar(
            lambda s: float(self.pressure(s)), bounds=ends, method="bounded", options={"xatol": 1e-8 * reach}
        )
        return max(0.0, -float(found.fun), -float(pressures[k]))

    @property
    def _stuck(self) -> JKRSphere:
        return JKRSphere(self.radius, self.modulus, self.work)

    @property
    def _sphere(self) -> JKRSphere | DMTSphere:
        return self._stuck if self.limit == "jkr" else DMTSphere(self.radius, self.modulus, self.work)

    @property
    def _least(self) -> float:
        """Smallest depth of an asperity in contact [m]."""
        return self._stuck.least_depth if self.limit == "jkr" else 0.0

    def _summed(self, separation: npt.ArrayLike, of_radius: Callable[[Array], Array]) -> Array:
        """Return the sum over the asperities in contact, per area."""
        s = np.asarray(number(separation, "separation [m]"))
        nodes, weights = gauss(NODES)
        # At the smallest depth the force begins like a square root or a 3/2 power: as a function of t squared it is
        # smooth.
        low = np.maximum(s + self._least, -HIGHEST * self.std)
        span = np.sqrt(np.maximum(HIGHEST * self.std - low, 0.0))
        t = span[..., None] * nodes
        heights = low[..., None] + t**2
        depths = heights - s[..., None]
        density = np.exp(-0.5 * (heights / self.std) ** 2) / (math.sqrt(2 * math.pi) * self.std)
        if self.limit == "jkr":
            radii = self._stuck.contact_radius(np.maximum(depths, self._least))
        else:
            radii = np.sqrt(np.maximum(depths, 0.0) * self.radius)
        return np.asarray(self.density * ((of_radius(radii) * density * 2 * t) @ weights * span))
