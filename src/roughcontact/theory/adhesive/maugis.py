r"""An adhesive sphere, by the model of Dugdale (Maugis, J. Colloid Interface Sci. 150, 243 (1992)).

Around the contact of radius a, up to the radius c, the surfaces attract each other by the constant traction s, which
ends at the gap w/s. With t = arccos(a/c) and b = sqrt(c^2 - a^2):

    w = s/(pi R) (a b + (c^2 - 2 a^2) t) + 4 s^2/(pi E*) (b t - c + a)
    F = 4 E* a^3/(3 R) - 2 s (a b + c^2 t)
    d = a^2/R - 2 s b/E*

It covers the range from Derjaguin, Muller and Toporov (small lambda) to Johnson, Kendall and Roberts (large lambda).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize_scalar

from roughcontact.theory.tools.roots import last_below
from roughcontact.validation import Array, number, numeric, positive, positive_scalar

__all__ = ["DugdaleSphere"]

SAMPLES = 400  # contact radii at which the search for the smallest force starts


@dataclass(frozen=True, slots=True)
class DugdaleSphere:
    """A sphere with an attraction that is constant up to a gap.

    Parameters
    ----------
    radius : float
        Radius R [m]; of two spheres 1/R = 1/R1 + 1/R2.
    modulus : float
        Reduced modulus E* [Pa].
    work : float
        Work of adhesion w [J/m^2].
    strength : float
        Attraction s [Pa], up to the gap w/s.

    Raises
    ------
    ValueError
        If a number is not positive and finite.

    Examples
    --------
    >>> import math
    >>> from roughcontact.theory import maugis
    >>> sphere = maugis.DugdaleSphere(radius=1e-5, modulus=1e8, work=10e-3, strength=2.5e6)
    >>> f"lambda {sphere.number:.2f}, pull-off {sphere.pull_off_force / (math.pi * 10e-3 * 1e-5):.3f} pi w R"
    'lambda 1.31, pull-off 1.569 pi w R'
    >>> a = 2e-7
    >>> f"{float(sphere.force(a)) * 1e9:.0f} nN at {float(sphere.depth(a)) * 1e9:.1f} nm"
    '-445 nN at -6.5 nm'
    >>> f"attracted up to {float(sphere.zone_radius(a)) * 1e9:.0f} nm"
    'attracted up to 290 nm'
    >>> round(maugis.DugdaleSphere.of_number(2.0).number, 9)
    2.0
    """

    radius: float
    modulus: float
    work: float
    strength: float

    def __post_init__(self) -> None:
        for name in ("radius", "modulus", "work", "strength"):
            positive_scalar(getattr(self, name), f"the {name}")

    @classmethod
    def of_number(cls, number: float) -> DugdaleSphere:
        """Return the sphere with Maugis' number lambda whose radius, modulus and work are 1.

        Parameters
        ----------
        number : float
            lambda.

        Returns
        -------
        DugdaleSphere
            The sphere.
        """
        return cls(1.0, 1.0, 1.0, positive_scalar(number, "lambda") * math.cbrt(2 * math.pi / 9))

    @property
    def number(self) -> float:
        """Maugis' number lambda, ``s (9 R/(2 pi w E*^2))^(1/3)``."""
        return self.strength * math.cbrt(9 * self.radius / (2 * math.pi * self.work * self.modulus**2))

    @numeric
    def zone_radius(self, contact_radius: npt.ArrayLike) -> Array:
        """Return the radius c up to which the surfaces attract each other.

        Parameters
        ----------
        contact_radius : float or array
            Radius a of the contact, at least 0 [m].

        Returns
        -------
        float or array
            c [m].
        """
        a = np.atleast_1d(
            positive(number(contact_radius, "contact radius [m]"), "contact radius [m]", zero=True)
        )

        def opening_work(width: Array) -> Array:
            b, t = _edge(a, a + width)
            bent = self.strength / (math.pi * self.radius) * (a * b + ((a + width) ** 2 - 2 * a**2) * t)
            pulled = 4 * self.strength**2 / (math.pi * self.modulus) * (b * t - width)
            return np.asarray(bent + pulled)

        width = last_below(opening_work, np.full(a.shape, self.work), 0.0, math.inf)
        return np.asarray((a + width).reshape(np.shape(contact_radius))[()])

    @numeric
    def force(self, contact_radius: npt.ArrayLike) -> Array:
        """Return the force of the equilibrium with a contact radius, tension negative.

        Parameters
        ----------
        contact_radius : float or array
            Radius a of the contact, at least 0 [m].

        Returns
        -------
        float or array
            F [N].
        """
        a = np.asarray(number(contact_radius, "contact radius [m]"))
        c = self.zone_radius(a)
        b, t = _edge(a, c)
        hertz = 4 * self.modulus * a**3 / (3 * self.radius)
        return np.asarray(hertz - 2 * self.strength * (a * b + c**2 * t))

    @numeric
    def depth(self, contact_radius: npt.ArrayLike) -> Array:
        """Return the indentation depth of the equilibrium with a contact radius.

        Parameters
        ----------
        contact_radius : float or array
            Radius a of the contact, at least 0 [m].

        Returns
        -------
        float or array
            d [m].
        """
        a = np.asarray(number(contact_radius, "contact radius [m]"))
        b, _ = _edge(a, self.zone_radius(a))
        return np.asarray(a**2 / self.radius - 2 * self.strength * b / self.modulus)

    @property
    def pull_off_force(self) -> float:
        """Largest tension of an equilibrium in contact [N], positive."""
        # Beyond the radius without load in the limit of Johnson, Kendall and Roberts, the largest, forces are
        # compressive.
        most = math.cbrt(9 * math.pi * self.work * self.radius**2 / (2 * self.modulus))
        radii = np.linspace(0.0, most, SAMPLES)
        forces = self.force(radii)
        k = int(np.argmin(forces))
        if k == 0:
            return -float(forces[0])
        ends = radii[k - 1], radii[min(k + 1, SAMPLES - 1)]
        found = minimize_scalar(
            lambda a: float(self.force(a)), bounds=ends, method="bounded", options={"xatol": 1e-8 * most}
        )
        return -float(found.fun)


def _edge(a: Array, c: Array) -> tuple[Array, Array]:
    """Return ``sqrt(c^2 - a^2)`` and ``arccos(a/c)``, accurate also for c close to a."""
    b = np.sqrt((c - a) * (c + a))
    return np.asarray(b), np.asarray(np.arctan2(b, a))
