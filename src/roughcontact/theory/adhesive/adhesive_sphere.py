r"""An adhesive sphere, in the two limits of the range of its attraction.

Johnson, Kendall and Roberts (Proc. R. Soc. A 324, 301 (1971)): no range, large Tabor number. With a the contact radius,

    F = 4 E* a^3/(3 R) - sqrt(8 pi E* w a^3)          d = a^2/R - sqrt(2 pi w a/E*)

Derjaguin, Muller and Toporov (J. Colloid Interface Sci. 53, 314 (1975); here in the form of Maugis): the attraction
2 pi w R acts outside Hertz's contact and causes no deformation, small Tabor number,

    F = 4 E* a^3/(3 R) - 2 pi w R                     d = a^2/R

`maugis` covers the transition between them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.validation import Array, number, numeric, positive, positive_scalar, require

__all__ = ["DMTSphere", "JKRSphere"]

STEPS = 60  # of Newton's method, which halves its error at a double root, and is quadratic elsewhere


@dataclass(frozen=True, slots=True)
class JKRSphere:
    """A sphere with an attraction of no range (Johnson, Kendall and Roberts).

    Parameters
    ----------
    radius : float
        Radius R [m]; of two spheres 1/R = 1/R1 + 1/R2.
    modulus : float
        Reduced modulus E* [Pa].
    work : float
        Work of adhesion w [J/m^2].

    Raises
    ------
    ValueError
        If a number is not positive and finite.

    Examples
    --------
    >>> import math
    >>> from roughcontact.theory import adhesive_sphere
    >>> sphere = adhesive_sphere.JKRSphere(radius=1e-5, modulus=1e8, work=10e-3)
    >>> f"{sphere.pull_off_force / (math.pi * 10e-3 * 1e-5):.1f} pi w R", f"{sphere.unloaded_radius * 1e9:.0f} nm"
    ('1.5 pi w R', '521 nm')
    >>> a = sphere.contact_radius(0.0)
    >>> f"{float(sphere.force(a)) * 1e9:.0f} nN on {float(a) * 1e9:.0f} nm", bool(abs(sphere.depth(a)) < 1e-20)
    ('-419 nN on 398 nm', True)
    """

    radius: float
    modulus: float
    work: float

    def __post_init__(self) -> None:
        for name in ("radius", "modulus", "work"):
            positive_scalar(getattr(self, name), f"the {name}")

    @property
    def pull_off_force(self) -> float:
        """Largest tension of an equilibrium [N], positive: ``3/2 pi w R``."""
        return 1.5 * math.pi * self.work * self.radius

    @property
    def least_depth(self) -> float:
        """Smallest depth of an equilibrium [m], negative: a sphere under a given depth detaches there."""
        return -3 * 6 ** (-2 / 3) * self._unit**2 / self.radius

    @property
    def unloaded_radius(self) -> float:
        """Contact radius without load [m]."""
        return math.cbrt(6) * self._unit

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
        a = np.asarray(_radius(contact_radius))
        hertz = 4 * self.modulus * a**3 / (3 * self.radius)
        return np.asarray(hertz - np.sqrt(8 * math.pi * self.modulus * self.work * a**3))

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
        a = np.asarray(_radius(contact_radius))
        return np.asarray(a**2 / self.radius - np.sqrt(2 * math.pi * self.work * a / self.modulus))

    @numeric
    def contact_radius(self, depth: npt.ArrayLike) -> Array:
        """Return the contact radius at a depth, for the equilibrium that is stable under a given depth.

        Parameters
        ----------
        depth : float or array
            d [m], at least `least_depth`.

        Returns
        -------
        float or array
            a [m].

        Raises
        ------
        ValueError
            If a depth is smaller than that: there is no equilibrium in contact.
        """
        d = np.asarray(number(depth, "depth [m]"))
        least = self.least_depth
        require(d >= least * (1 + 1e-12), f"the depth must be at least {least:.6g} m", value=d, place="depth")
        x = np.maximum(d, least) * self.radius / self._unit**2
        # With b the root of a: b^4 - 2/3 sqrt(6) b = x, convex, from the right of its larger root.
        b = np.maximum(np.abs(x), 1.0) ** 0.25 + 1.0
        for _ in range(STEPS):
            slope = 4 * b**3 - 2 / 3 * math.sqrt(6)
            step = np.divide(
                b**4 - 2 / 3 * math.sqrt(6) * b - x, slope, out=np.zeros_like(b), where=slope > 0
            )
            b = b - np.maximum(step, 0.0)
        return np.asarray(self._unit * b**2)

    @property
    def _unit(self) -> float:
        """Unit of length of the contact radii, ``(3 pi w R^2/(4 E*))^(1/3)`` [m]."""
        return math.cbrt(0.75 * math.pi * self.work * self.radius**2 / self.modulus)


@dataclass(frozen=True, slots=True)
class DMTSphere:
    """A sphere with an attraction that causes no deformation (Derjaguin, Muller and Toporov).

    Parameters
    ----------
    radius : float
        Radius R [m]; of two spheres 1/R = 1/R1 + 1/R2.
    modulus : float
        Reduced modulus E* [Pa].
    work : float
        Work of adhesion w [J/m^2].

    Raises
    ------
    ValueError
        If a number is not positive and finite.

    Examples
    --------
    >>> from roughcontact.theory import adhesive_sphere
    >>> sphere = adhesive_sphere.DMTSphere(radius=1e-5, modulus=1e11, work=10e-3)
    >>> f"pull-off {sphere.pull_off_force * 1e9:.0f} nN"
    'pull-off 628 nN'
    >>> f"{float(sphere.force(1e-8)) * 1e9:.0f} nN at {float(sphere.depth(1e-8)) * 1e12:.0f} pm"
    '-615 nN at 10 pm'
    """

    radius: float
    modulus: float
    work: float

    def __post_init__(self) -> None:
        for name in ("radius", "modulus", "work"):
            positive_scalar(getattr(self, name), f"the {name}")

    @property
    def pull_off_force(self) -> float:
        """Largest tension of an equilibrium [N], positive: ``2 pi w R``."""
        return 2 * math.pi * self.work * self.radius

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
        a = np.asarray(_radius(contact_radius))
        return np.asarray(4 * self.modulus * a**3 / (3 * self.radius) - self.pull_off_force)

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
        return np.asarray(np.asarray(_radius(contact_radius)) ** 2 / self.radius)


def _radius(value: npt.ArrayLike) -> Array:
    return positive(number(value, "contact radius [m]"), "contact radius [m]", zero=True)
