r"""Adhesive contact of a body of revolution in the limit of Johnson, Kendall and Roberts (1971), by Hess' rule.

The outermost springs of the foundation separate at the elongation l(a) = sqrt(2 pi a w/E*) (Hess, Über die exakte
Abbildung ausgewählter dreidimensionaler Kontakte, 2011; Popov & Hess, Method of Dimensionality Reduction, 2015),
which gives one equilibrium for every radius a:

    d(a) = g(a) - l(a)          F(a) = 2 E* (a d(a) - \int_0^a g dx)

For the paraboloid this is exactly the theory of Johnson, Kendall and Roberts. The contact is assumed to be one disc,
possibly with tension inside: for a body whose transform decreases somewhere, the body must have been pressed into full
contact before (Guduru, J. Mech. Phys. Solids 55, 445 (2007)).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.materials import Modulus, as_modulus
from roughcontact.mdr.bodies.axisymmetric_profile import Profile, checked_profile
from roughcontact.mdr.bodies.disc import sample_radii
from roughcontact.mdr.bodies.indentation import Indentation
from roughcontact.mdr.bodies.recovery import spring_energy
from roughcontact.theory.tools.roots import bisect
from roughcontact.validation import Array, numeric, scalar

__all__ = ["Control", "JKRContact", "PullOff", "jkr"]

SPAN = (1e-15, 1e6)  # contact radii searched for a body without end [m]
PER_DECADE = 200


@dataclass(frozen=True, slots=True)
class PullOff:
    """The equilibrium from which a contact snaps off.

    Attributes
    ----------
    force : float
        [N], tension negative.
    depth, contact_radius : float
        [m].

    Examples
    --------
    >>> from roughcontact.mdr import adhesion, indenter
    >>> ball = adhesion.jkr(indenter.paraboloid(1e-2), 1e9, work=0.05)
    >>> soft, stiff = ball.pull_off(), ball.pull_off(machine_stiffness=float("inf"))
    >>> f"{-soft.force * 1e3:.2f} mN under a force, {-stiff.force * 1e3:.2f} mN under a depth"  # 5/9 of it
    '2.36 mN under a force, 1.31 mN under a depth'
    """

    force: float
    depth: float
    contact_radius: float


@dataclass(frozen=True, slots=True, eq=False)
class JKRContact:
    """The equilibria of an adhesive body of revolution, one for each contact radius; made by `jkr`.

    Parameters
    ----------
    profile : Profile
    modulus : float
        Reduced modulus E* [Pa].
    work : float
        Work of adhesion w [J/m^2].

    Examples
    --------
    >>> import math
    >>> from roughcontact.mdr import adhesion, indenter
    >>> ball = adhesion.jkr(indenter.paraboloid(1e-2), 1e9, work=0.05)
    >>> last = ball.pull_off()
    >>> round(last.force / (math.pi * 0.05 * 1e-2), 6)  # -(3/2) pi w R of Johnson, Kendall and Roberts
    -1.5
    >>> a = last.contact_radius
    >>> round(float(ball.force(a) / last.force), 9), round(float(ball.depth(a) / last.depth), 9)
    (1.0, 1.0)
    >>> bool(abs(ball.force_slope(a)) < 1e-9 * ball.modulus * a), bool(ball.depth_slope(a) > 0)
    (True, True)
    >>> round(ball.at(a).force / last.force, 9), f"springs longer by {float(ball.elongation(a)) * 1e9:.0f} nm"
    (1.0, 'springs longer by 90 nm')
    >>> f"{ball.energy(a, last.depth) * 1e9:.3f} nJ"
    '-0.043 nJ'
    """

    profile: Profile
    modulus: float
    work: float

    @numeric
    def elongation(self, radius: float | Array) -> Array:
        """Return l(a) = sqrt(2 pi a w/E*), the elongation of the outermost springs [m], at contact radii [m].

        Parameters
        ----------
        radius : float or array
            Contact radius a [m].

        Returns
        -------
        float or array
            l [m].
        """
        return np.asarray(np.sqrt(2 * np.pi * self.work / self.modulus * np.asarray(radius)))

    @numeric
    def depth(self, radius: float | Array) -> Array:
        """Return the depth of the equilibria [m] at contact radii [m].

        Parameters
        ----------
        radius : float or array
            Contact radius a [m].

        Returns
        -------
        float or array
            d [m].
        """
        return self.profile.transform(radius) - self.elongation(radius)

    @numeric
    def force(self, radius: float | Array) -> Array:
        """Return the force of the equilibria [N], tension negative, at contact radii [m].

        Parameters
        ----------
        radius : float or array
            Contact radius a [m].

        Returns
        -------
        float or array
            F [N].
        """
        integral = self.profile.transform_integral(radius)
        return np.asarray(2 * self.modulus * (np.asarray(radius) * self.depth(radius) - integral))

    @numeric
    def depth_slope(self, radius: float | Array) -> Array:
        """Return dd/da along the equilibria [-]; positive where they are stable under a given depth.

        Parameters
        ----------
        radius : float or array
            Contact radius a [m].

        Returns
        -------
        float or array
            dd/da [-].
        """
        return np.asarray(
            self.profile.transform_slope(radius) - self.elongation(radius) / (2 * np.asarray(radius))
        )

    @numeric
    def force_slope(self, radius: float | Array) -> Array:
        """Return dF/da along the equilibria [N/m]; positive where they are stable under a given force.

        Parameters
        ----------
        radius : float or array
            Contact radius a [m].

        Returns
        -------
        float or array
            dF/da [N/m].
        """
        a = np.asarray(radius, dtype=np.float64)
        return 2 * self.modulus * (a * self.profile.transform_slope(a) - 1.5 * self.elongation(a))

    @numeric
    def energy(self, radius: float, depth: float) -> float:
        """Return the elastic energy less the energy of adhesion [J] of a contact held at a radius and a depth [m].

        Parameters
        ----------
        radius : float
            Contact radius a [m].
        depth : float
            Depth d at which the contact is held [m].

        Returns
        -------
        float
            Energy [J].
        """
        elastic = self.modulus * spring_energy(self.profile, radius, depth)
        return elastic - math.pi * self.work * radius**2

    @numeric
    def at(self, radius: float) -> Indentation:
        """Return the equilibrium of a contact radius [m], which has pressure, displacement and gap.

        Parameters
        ----------
        radius : float
            Contact radius a, above 0 and at most that of the body [m].

        Returns
        -------
        Indentation
        """
        if not 0 < scalar(radius, "contact radius") <= self.profile.radius:
            raise InputError(
                f"the contact radius must lie between 0 and {self.profile.radius:g} m, not {radius}",
                place="radius",
            )
        return Indentation(self.profile, self.modulus, float(self.depth(radius)), float(radius))

    @numeric
    def pull_off(self, machine_stiffness: float = 0.0) -> PullOff:
        """Return the state from which the contact finally snaps off when it is unloaded.

        Parameters
        ----------
        machine_stiffness : float
            Stiffness of the machine that holds the body [N/m]: 0 under a given force, infinite under a given depth.

        Returns
        -------
        PullOff

        Raises
        ------
        ValueError
            If the contact would spread without limit, or snaps off beyond the known part of the body.
        """
        control = Control(self, machine_stiffness)
        a, level = control.extrema()
        lowest = int(level.argmin())
        if lowest == len(a) - 1 and not self.profile.edge:
            raise InputError(
                "the contact spreads to the end of the body by itself: its transform must rise faster than the square "
                f"root of the radius somewhere below {a[-1]:g} m",
                "define the body to a larger radius, or use cut(radius)",
            )
        radius = float(a[lowest])
        return PullOff(float(self.force(radius)), float(self.depth(radius)), radius)


@dataclass(frozen=True, slots=True, eq=False)
class Control:
    """The control: the position c of the far end of a spring that holds the body, or the force.

    Parameters
    ----------
    adhesion : JKRContact
    machine_stiffness : float
        c = d + F/stiffness [m] for a positive stiffness, c = d for an infinite one; c = F [N] for 0.

    Examples
    --------
    >>> from roughcontact.mdr import adhesion, indenter
    >>> ball = adhesion.jkr(indenter.paraboloid(1e-2), 1e9, work=0.05)
    >>> control = adhesion.Control(ball, machine_stiffness=0.0)  # the force is given
    >>> radii, forces = control.extrema()
    >>> round(float(forces.min() / ball.pull_off().force), 9)
    1.0
    >>> bool(control.slope(2 * radii[1]) > 0), bool(control.level(2 * radii[1]) > forces[1])
    (True, True)
    """

    adhesion: JKRContact
    machine_stiffness: float

    def __post_init__(self) -> None:
        if not scalar(self.machine_stiffness, "stiffness of the machine") >= 0:
            raise InputError(
                f"the stiffness of the machine must be 0 or above [N/m], not {self.machine_stiffness}",
                place="machine_stiffness",
            )

    @property
    def compliance(self) -> float:
        """Factor of the force in c [m/N]; not used under a given force."""
        return 1 / self.machine_stiffness if self.machine_stiffness else math.inf

    def level(self, radius: float | Array) -> Array:
        """Return c of the equilibria at contact radii [m].

        Parameters
        ----------
        radius : float or array
            Contact radius a [m].

        Returns
        -------
        float or array
            c [m], or [N] under a given force.
        """
        return self._combined(self.adhesion.force, self.adhesion.depth, radius)

    def slope(self, radius: Array) -> Array:
        """Return dc/da; an equilibrium is stable where it is positive.

        Parameters
        ----------
        radius : float or array
            Contact radii a [m].

        Returns
        -------
        array
            dc/da.
        """
        return self._combined(self.adhesion.force_slope, self.adhesion.depth_slope, radius)

    def _combined(
        self, force: Callable[[Array], Array], depth: Callable[[Array], Array], radius: float | Array
    ) -> Array:
        """Return c from the force and the depth at contact radii."""
        radius = np.asarray(radius, dtype=np.float64)
        if self.machine_stiffness == 0:
            return force(radius)
        return depth(radius) + (self.compliance * force(radius) if self.compliance else 0.0)

    def extrema(self) -> tuple[Array, Array]:
        """Return the radii at which c has an extremum [m], from 0 to the end of the body, and c there.

        Returns
        -------
        array, array
            Radii [m] and c there, each of shape (n,).
        """
        profile = self.adhesion.profile
        end = min(profile.radius, SPAN[1])
        count = math.ceil(PER_DECADE * math.log10(end / SPAN[0]))
        x = np.geomspace(SPAN[0], end, count)
        x[-1] = end
        if math.isfinite(profile.radius) or profile.breaks:
            reach = end if math.isfinite(profile.radius) else 2 * profile.breaks[-1]
            x = np.union1d(x, sample_radii(profile, reach)[1:])
        stable = self.slope(x) > 0
        turn = np.nonzero(stable[:-1] != stable[1:])[0]
        rising = stable[turn]
        places = bisect(lambda a: (self.slope(a) > 0) != rising, x[turn], x[turn + 1])
        a = np.concatenate([[0.0], places, x[-1:]])
        return a, np.concatenate([[0.0], self.level(a[1:])])


def jkr(profile: Profile, modulus: Modulus, work: float) -> JKRContact:
    """Return the adhesive contact of a body of revolution with short-ranged attraction.

    Parameters
    ----------
    profile : Profile
        The body.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies.
    work : float
        Work of adhesion w [J/m^2].

    Returns
    -------
    JKRContact

    Raises
    ------
    ValueError
        If the profile is not a body of revolution, or the work is not positive.

    Notes
    -----
    The theory holds for small strains, which is not checked: it fails for a soft body whose contact radius approaches
    its radius of curvature.

    Examples
    --------
    >>> import math
    >>> from roughcontact.mdr import adhesion, indenter
    >>> ball = adhesion.jkr(indenter.paraboloid(1e-2), 1e9, work=0.05)
    >>> round(ball.pull_off().force / (math.pi * 0.05 * 1e-2), 6)  # -(3/2) pi w R of Johnson, Kendall and Roberts
    -1.5
    """
    w = scalar(work, "work of adhesion")
    if not (math.isfinite(w) and w > 0):
        raise about("the work", f"of adhesion must be positive [J/m^2], not {w}; without adhesion use indent")
    return JKRContact(checked_profile(profile), as_modulus(modulus), w)
