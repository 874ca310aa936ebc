"""Partial slip of a sphere under constant normal and rising or oscillating tangential force.

Cattaneo (1938) and Mindlin (1949); Johnson, Contact Mechanics (1985), section 7.2. Slip is assumed to be along the
force, which is exact for Poisson's ratio 0; otherwise slip across the force, a part of order nu/(2 - nu), is
neglected.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact.validation import Array, numeric, positive, positive_scalar, require

__all__ = ["SlippingSphere"]


@dataclass(frozen=True, slots=True)
class SlippingSphere:
    """A sphere under a constant normal force and a tangential force Q, at most mu P.

    Parameters
    ----------
    force : float
        Normal force P [N].
    radius : float
        Radius R [m]; of two spheres 1/R = 1/R1 + 1/R2.
    modulus : float
        Reduced modulus E* [Pa].
    friction : float
        Coefficient of friction mu [-].
    ratio : float
        E*/G* [-], see `mindlin.ratio`: 1 to 1.5, or at least 0.75 for negative Poisson's ratios.

    Raises
    ------
    ValueError
        If a number is not positive and finite, or no solids have the ratio.

    Examples
    --------
    >>> from roughcontact.theory import cattaneo
    >>> sphere = cattaneo.SlippingSphere(force=1.0, radius=1e-2, modulus=1e11, friction=0.3, ratio=1.2)
    >>> round(float(sphere.stick_radius(0.15) / sphere.contact_radius), 4)  # (1/2)^(1/3) at half of mu P
    0.7937
    >>> edge = 0.9 * sphere.contact_radius  # there it slips: the traction is mu p
    >>> round(float(sphere.traction(edge, 0.15) / sphere.peak_pressure), 4)  # 0.3 (1 - 0.9^2)^(1/2)
    0.1308
    >>> pulled, back = sphere.displacement(0.15), sphere.reversed_displacement(0.0, 0.15)
    >>> f"{float(pulled) * 1e9:.2f} nm, and {float(back) * 1e9:.2f} nm when the force is taken away"
    '23.69 nm, and 1.34 nm when the force is taken away'
    >>> round(float(sphere.stiffness(0.15) / sphere.stiffness(0.0)), 4)
    0.7937
    >>> f"{float(sphere.cycle_loss(0.15)) * 1e9:.3f} nJ a cycle"
    '0.541 nJ a cycle'
    """

    force: float
    radius: float
    modulus: float
    friction: float
    ratio: float

    def __post_init__(self) -> None:
        for name in ("force", "radius", "modulus", "friction", "ratio"):
            positive_scalar(getattr(self, name), f"the {name}")
        # Poisson's ratio goes from -1 to 1/2; the margin allows for rounding in `pair_ratio`.
        require(
            0.75 * (1 - 1e-12) <= self.ratio <= 1.5 * (1 + 1e-12),
            "the ratio E*/G* of a round contact lies from 1 to 1.5, or from 0.75 with negative Poisson's ratios: "
            f"mindlin.ratio(poisson_ratio) returns it; not {self.ratio}",
            place="ratio",
        )

    @property
    def contact_radius(self) -> float:
        """Radius a of the contact [m], which Q does not change."""
        return math.cbrt(3 * self.force * self.radius / (4 * self.modulus))

    @property
    def depth(self) -> float:
        """Indentation depth a^2/R [m]."""
        return self.contact_radius**2 / self.radius

    @property
    def peak_pressure(self) -> float:
        """Pressure at the centre [Pa]."""
        return 2 * self.contact_radius * self.modulus / (math.pi * self.radius)

    @property
    def gross_slip(self) -> float:
        """Displacement at Q = mu P [m], at which the sphere begins to slide."""
        return self.friction * self.ratio * self.depth

    @numeric
    def stick_radius(self, tangential: float | Array) -> Array:
        """Return the radius c = a (1 - Q/(mu P))^(1/3) of the disc that sticks [m] under Q [N].

        Parameters
        ----------
        tangential : float or array
            Tangential force Q, at most mu P [N].

        Returns
        -------
        float or array
            c [m]; 0 if the whole contact slips.
        """
        return np.asarray(self.contact_radius * (1 - self._part(tangential)) ** (1 / 3))

    @numeric
    def traction(self, distance: float | Array, tangential: float) -> Array:
        """Return the traction q [Pa] at a distance from the centre [m].

        Parameters
        ----------
        distance : float or array
            Distance r from the centre [m].
        tangential : float
            Tangential force Q, at most mu P [N].

        Returns
        -------
        float or array
            q [Pa], along the force; 0 outside the contact.
        """
        r, a = positive(distance, "the distance [m]", zero=True), self.contact_radius
        c = float(self.stick_radius(tangential))
        # c sqrt(1 - r^2/c^2), without a division by a vanishing c
        full, held = (np.sqrt(np.maximum(edge**2 - r**2, 0)) / a for edge in (a, c))
        return np.asarray(self.friction * self.peak_pressure * (full - held))

    @numeric
    def displacement(self, tangential: float | Array) -> Array:
        """Return the tangential displacement [m] as Q [N] rises from zero.

        Parameters
        ----------
        tangential : float or array
            Tangential force Q, at most mu P [N].

        Returns
        -------
        float or array
            Displacement of the bodies [m].
        """
        f = self._part(tangential)
        y = (1 - f) ** (1 / 3)
        # 1 - y^2, exact for small f = 1 - y^3
        return np.asarray(self.gross_slip * f * (1 + y) / (1 + y + y**2))

    @numeric
    def reversed_displacement(self, tangential: float | Array, turned: float) -> Array:
        """Return the displacement [m] as Q [N] falls after it had risen to `turned` [N], down to -`turned`.

        Parameters
        ----------
        tangential : float or array
            Tangential force Q [N], from -`turned` to `turned`.
        turned : float
            Force at which Q was reversed [N], at most mu P.

        Returns
        -------
        float or array
            Displacement of the bodies [m].
        """
        fall = (turned - np.asarray(tangential, dtype=np.float64)) / 2
        return np.asarray(self.displacement(turned) - 2 * self.displacement(fall))

    @numeric
    def stiffness(self, tangential: float | Array) -> Array:
        """Return dQ/d displacement = 2 G* c [N/m] as Q [N] rises from zero.

        Parameters
        ----------
        tangential : float or array
            Tangential force Q, at most mu P [N].

        Returns
        -------
        float or array
            k_t [N/m].
        """
        return np.asarray(2 * self.modulus / self.ratio * self.stick_radius(tangential))

    @numeric
    def cycle_loss(self, amplitude: float | Array) -> Array:
        """Return the work [J] that friction dissipates in a cycle between +Q and -Q [N].

        Parameters
        ----------
        amplitude : float or array
            Largest tangential force Q of the cycle, at most mu P [N].

        Returns
        -------
        float or array
            Work [J].
        """
        f = self._part(amplitude)
        y = (1 - f) ** (1 / 3)
        # 1 - y^5 - (5/6) (1 - y^3) (1 + y^2), without its cancellation at small f = 1 - y^3
        part = (f / (1 + y + y**2)) ** 3 * (1 + 3 * y + y**2) / 6
        scale = (self.friction * self.force) ** 2 * self.ratio / (self.contact_radius * self.modulus)
        return np.asarray(18 / 5 * scale * part)

    def _part(self, tangential: float | Array) -> Array:
        part = positive(tangential, "the tangential force [N]", zero=True) / (self.friction * self.force)
        top = self.friction * self.force
        require(
            part <= 1,
            f"the tangential force exceeds mu P = {top:g} N, at which the sphere slides",
            place="tangential",
        )
        return part
