"""A body of revolution pressed into an elastic half-space: one load, or a curve of loads (thesis, appendix A.2)."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.materials import Modulus, as_modulus
from roughcontact.mdr.bodies.axisymmetric_profile import Profile, checked_profile, checked_radii
from roughcontact.mdr.bodies.disc import disc_radius
from roughcontact.mdr.bodies.recovery import pressure, spring_energy, surface_displacement
from roughcontact.theory.tools.roots import last_below
from roughcontact.validation import Array, exactly_one, number, require

__all__ = ["Indentation", "IndentationCurve", "indent", "indentation_curve", "indented"]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Indentation:
    """A body of revolution in contact at one load.

    Parameters
    ----------
    profile : Profile
    modulus : float
        Reduced modulus E* [Pa].
    depth : float
        Approach since first touch d [m].
    contact_radius : float
        a [m].

    Examples
    --------
    >>> from roughcontact.mdr import indentation, indenter
    >>> pressed = indentation.indent(indenter.paraboloid(1e-2), 1e11, force=1.0)
    >>> a = pressed.contact_radius
    >>> f"{float(pressed.pressure(0.0)) / 1e6:.0f} MPa, a gap of {float(pressed.gap(2 * a)) * 1e9:.0f} nm at 2 a"
    '268 MPa, a gap of 217 nm at 2 a'
    >>> round(float(pressed.displacement(0.0) / pressed.depth), 6)
    1.0
    """

    profile: Profile
    modulus: float
    depth: float
    contact_radius: float

    @property
    def force(self) -> float:
        """Normal force F = 2 E* (a d - integral of g over the contact) [N]."""
        return float(_force(self.profile, self.modulus, self.depth, self.contact_radius))

    @property
    def stiffness(self) -> float:
        """Contact stiffness dF/dd = 2 E* a [N/m] (thesis, eq. 4.6)."""
        return 2 * self.modulus * self.contact_radius

    @property
    def contact_area(self) -> float:
        """Area of the contact [m^2]."""
        return math.pi * self.contact_radius**2

    @property
    def elastic_energy(self) -> float:
        """Energy of the springs, E* times the integral of (d - g)^2 [J]."""
        return self.modulus * spring_energy(self.profile, self.contact_radius, self.depth)

    def pressure(self, r: float | Array) -> Array:
        """Return the pressure [Pa] at the radii `r` [m]; infinite at a sharp tip and at a loaded edge.

        Parameters
        ----------
        r : float or array
            Distance from the axis [m].

        Returns
        -------
        float or array
            p [Pa].
        """
        return pressure(self.profile, self.modulus, self.contact_radius, self.depth, checked_radii(r))

    def displacement(self, r: float | Array) -> Array:
        """Return the displacement of the half-space's surface [m], into the body, at the radii `r` [m].

        Parameters
        ----------
        r : float or array
            Distance from the axis [m].

        Returns
        -------
        float or array
            u [m].
        """
        return surface_displacement(self.profile, self.contact_radius, self.depth, checked_radii(r))

    def gap(self, r: float | Array) -> Array:
        """Return the gap [m] at the radii `r` [m]: 0 in the contact, infinite beyond the body's edge.

        Parameters
        ----------
        r : float or array
            Distance from the axis [m].

        Returns
        -------
        float or array
            Gap [m].
        """
        r = checked_radii(r)
        outside = self.displacement(r) + self.profile.height(r) - self.depth
        return np.where(r <= self.contact_radius, 0.0, outside)

    def __repr__(self) -> str:
        """Return force, depth and contact radius."""
        return (
            f"Indentation(force {self.force:.4g} N, depth {self.depth:.4g} m, "
            f"contact radius {self.contact_radius:.4g} m)"
        )


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class IndentationCurve:
    """A body of revolution in contact at many loads, with the names of the attributes of `Curve`.

    Parameters
    ----------
    profile : Profile
    modulus : float
        Reduced modulus E* [Pa].
    depth, contact_radius : array, shape (n,)
        [m], in the order of the loads.

    Examples
    --------
    >>> from roughcontact.mdr import indentation, indenter
    >>> curve = indentation.indentation_curve(indenter.paraboloid(1e-2), 1e11, forces=[1.0, 8.0])
    >>> curve
    IndentationCurve(2 points, force 1 to 8 N)
    >>> (curve.depth[1] / curve.depth[0]).round(6).item(), curve[1]  # as F^(2/3)
    (4.0, Indentation(force 8 N, depth 7.114e-07 m, contact radius 8.434e-05 m))
    """

    profile: Profile
    modulus: float
    depth: Array
    contact_radius: Array

    def __len__(self) -> int:
        return len(self.depth)

    def __getitem__(self, index: int) -> Indentation:
        """Return one point with its fields."""
        return Indentation(
            self.profile, self.modulus, float(self.depth[index]), float(self.contact_radius[index])
        )

    @property
    def force(self) -> Array:
        """Normal force [N], shape (n,)."""
        return _force(self.profile, self.modulus, self.depth, self.contact_radius)

    @property
    def stiffness(self) -> Array:
        """Contact stiffness dF/dd = 2 E* a [N/m], shape (n,) (thesis, eq. 4.6)."""
        return 2 * self.modulus * self.contact_radius

    @property
    def contact_area(self) -> Array:
        """Area of the contact [m^2], shape (n,)."""
        return np.pi * self.contact_radius**2

    @property
    def elastic_energy(self) -> Array:
        """Energy of the springs [J], shape (n,)."""
        return np.array([self[index].elastic_energy for index in range(len(self))])

    def __repr__(self) -> str:
        """Return the range of the curve."""
        return f"IndentationCurve({len(self)} points, force {self.force[0]:.4g} to {self.force[-1]:.4g} N)"


def indent(
    profile: Profile,
    modulus: Modulus,
    *,
    force: float | None = None,
    depth: float | None = None,
    contact_radius: float | None = None,
) -> Indentation:
    """Press a body of revolution into an elastic half-space.

    Parameters
    ----------
    profile : Profile
        The body.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or what it follows from.
    force, depth, contact_radius : float
        Give exactly one: normal force [N], approach since first touch [m], or radius of the contact [m].

    Returns
    -------
    Indentation

    Raises
    ------
    ValueError
        If the input is invalid, the contact is not one disc, or it leaves the known part of the body.

    Notes
    -----
    Exact for small strains, which is not checked: the contact radius must be well below the radius of curvature. For a
    soft body under a high force the result has no meaning.

    Examples
    --------
    >>> from roughcontact.mdr import indentation, indenter
    >>> ball = indentation.indent(indenter.paraboloid(1e-2), 1e11, depth=1e-6)
    >>> round(ball.contact_radius**2 / (1e-2 * 1e-6), 6)  # Hertz: a^2 = R d
    1.0
    >>> round(ball.force / (4 / 3 * 1e11 * 1e-4 * 1e-6), 6)
    1.0
    """
    name, load = exactly_one(force=force, depth=depth, contact_radius=contact_radius)
    d, a = _solve(profile, as_modulus(modulus), name, np.atleast_1d(number(load, name)))
    require(len(d) == 1, f"one load is needed, not {len(d)}", "for several loads use indentation_curve")
    return Indentation(profile, as_modulus(modulus), float(d[0]), float(a[0]))


def indentation_curve(
    profile: Profile,
    modulus: Modulus,
    *,
    forces: Sequence[float] | Array | None = None,
    depths: Sequence[float] | Array | None = None,
    contact_radii: Sequence[float] | Array | None = None,
) -> IndentationCurve:
    """Press a body of revolution at many loads.

    The arguments are those of `indent`, as strictly increasing arrays of shape (n,).

    Parameters
    ----------
    profile : Profile
        The body, see `roughcontact.mdr.indenter`.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or what it follows from.
    forces : array, shape (n,), optional
        Normal forces [N], strictly increasing; exactly one of the three is given.
    depths : array, shape (n,), optional
        Approaches since first touch [m].
    contact_radii : array, shape (n,), optional
        Radii of the contact [m].

    Returns
    -------
    IndentationCurve

    Examples
    --------
    >>> from roughcontact.mdr import indentation, indenter
    >>> curve = indentation.indentation_curve(indenter.cone(0.1), 1e11, forces=[1.0, 4.0])
    >>> round(float(curve.stiffness[1] / curve.stiffness[0]), 6)  # of a cone as F^(1/2)
    2.0
    """
    name, values = exactly_one(force=forces, depth=depths, contact_radius=contact_radii)
    loads = number(values, name)
    if loads.ndim != 1 or not len(loads):
        raise InputError(f"a curve needs a list of loads, not an array of shape {loads.shape}")
    if len(falls := np.nonzero(np.diff(loads) <= 0)[0]):
        raise InputError(
            f"loads must increase strictly: {name} goes from {loads[falls[0]]:g} to {loads[falls[0] + 1]:g}"
        )
    return indented(profile, as_modulus(modulus), name, loads)


def indented(profile: Profile, modulus: float, name: str, loads: Array) -> IndentationCurve:
    """Return the states at loads in any order, for histories.

    Parameters
    ----------
    profile : Profile
        The body, see `roughcontact.mdr.indenter`.
    modulus : float
        Reduced modulus E* [Pa].
    name : {"force", "depth", "contact_radius"}
        Kind of the loads.
    loads : array, shape (n,)
        Forces [N], depths [m] or contact radii [m].

    Returns
    -------
    IndentationCurve

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.mdr import indentation, indenter
    >>> curve = indentation.indented(indenter.sphere(1e-2), 1e11, "force", np.array([1.0, 2.0, 1.0]))
    >>> round(float(curve.depth[2] / curve.depth[0]), 9)  # elastic: back on the same way
    1.0
    """
    return IndentationCurve(profile, modulus, *_solve(profile, modulus, name, loads))


def _solve(profile: Profile, modulus: float, name: str, loads: Array) -> tuple[Array, Array]:
    """Return depths and contact radii."""
    checked_profile(profile)
    if not (np.isfinite(loads).all() and (loads >= 0).all()):
        raise about("loads", f"must be finite and not negative; {name} is {loads}")
    if name == "contact_radius":
        return _atchecked_radii(profile, loads)
    if name == "force":
        value, target = _reduced_force(profile), loads / (2 * modulus)
    else:
        value, target = profile.transform, loads
    radius = np.full(len(loads), profile.flat)
    pressed = target > 0
    if profile.rises:
        radius[pressed] = last_below(value, target[pressed], profile.flat, profile.radius)
    else:
        for index in np.nonzero(pressed)[0]:
            goal = float(target[index])
            radius[index] = disc_radius(profile, value, goal, _depth_at(profile, name, goal))
    beyond = radius >= profile.radius
    if beyond.any() and not profile.edge:
        raise InputError(
            f"under a {name} of {loads[beyond].min():g} the contact reaches {profile.radius:g} m, where the known "
            "part of the body ends",
            "define the body to a larger radius, or give it an edge there by cut(radius)",
        )
    if name == "depth":
        return loads, radius
    integral = profile.transform_integral(radius)
    depth = np.divide(target + integral, radius, out=np.zeros_like(radius), where=radius > 0)
    return depth, radius


def _atchecked_radii(profile: Profile, radii: Array) -> tuple[Array, Array]:
    if len(wrong := radii[(radii < profile.flat) | (radii > profile.radius)]):
        raise InputError(
            f"the contact radius of this body lies between {profile.flat:g} m and {profile.radius:g} m, "
            f"not {wrong[0]:g}"
        )
    depths = profile.transform(radii)
    if not profile.rises:
        for a, d in zip(radii.tolist(), depths.tolist(), strict=True):
            found = disc_radius(profile, profile.transform, d, _depth_at(profile, "depth", d))
            if not math.isclose(found, a, rel_tol=1e-6):
                raise InputError(f"no load gives a contact radius of {a:g} m: at its depth it is {found:g} m")
    return depths, radii


def _depth_at(profile: Profile, name: str, target: float) -> Callable[[float], float]:
    if name == "depth":
        return lambda a: target
    return lambda a: (target + float(profile.transform_integral(a))) / a


def _reduced_force(profile: Profile) -> Callable[[Array], Array]:
    """Return F/(2 E*) of a smooth rim as a function of the contact radius."""
    return lambda a: a * profile.transform(a) - profile.transform_integral(a)


def _force(profile: Profile, modulus: float, depth: float | Array, radius: float | Array) -> Array:
    return np.asarray(2 * modulus * (depth * np.asarray(radius) - profile.transform_integral(radius)))
