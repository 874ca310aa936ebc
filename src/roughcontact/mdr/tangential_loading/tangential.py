"""Partial slip of a pressed body under a tangential force that grows from zero.

The rule of Ciavarella (1998) and Jaeger (1998): the traction is the coefficient of friction times the difference of the
pressures at the normal forces F and F - Q/mu, and the sticking region is the contact at the latter. For the paraboloid
this is the theory of Cattaneo (1938) and Mindlin (1949). Springs that stick until their tangential force is mu times
the normal force give the same result (`slip_history`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from roughcontact.errors import InputError
from roughcontact.mdr.bodies.indentation import Indentation, indent
from roughcontact.validation import Array, exactly_one, positive_scalar, scalar, shown

__all__ = ["PartialSlip", "partial_slip"]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class PartialSlip:
    """A round contact under a normal and a tangential force, made by `partial_slip`.

    Parameters
    ----------
    indentation : Indentation
        The contact under the normal force.
    sticking : Indentation
        The contact at the force F - Q/mu: its disc is the sticking region.
    shear_modulus : float
        Reduced shear modulus G* [Pa]: 2 G* a is the tangential stiffness of a disc that sticks (thesis, eq. 4.5).
    friction : float
        Coefficient of friction mu.

    Examples
    --------
    >>> from roughcontact.mdr import indentation, indenter, tangential
    >>> pressed = indentation.indent(indenter.paraboloid(1e-2), 1e11, force=1.0)
    >>> slip = tangential.partial_slip(pressed, 8e10, 0.3, force=0.15)
    >>> slip
    PartialSlip(tangential force 0.15 N, displacement 2.468e-08 m, stick radius 3.347e-05 of 4.217e-05 m)
    >>> edge = 0.99 * pressed.contact_radius  # there it slips: the traction is mu p
    >>> round(float(slip.traction(edge) / pressed.pressure(edge)), 6)
    0.3
    """

    indentation: Indentation
    sticking: Indentation
    shear_modulus: float
    friction: float

    @property
    def force(self) -> float:
        """Tangential force Q [N]."""
        return self.friction * (self.indentation.force - self.sticking.force)

    @property
    def displacement(self) -> float:
        """Tangential displacement of the bodies [m]; its least value if the whole contact slips (thesis, eq. 7.6)."""
        return self._scale * (self.indentation.depth - self.sticking.depth)

    @property
    def stick_radius(self) -> float:
        """Radius of the disc that sticks [m]; 0 if the whole contact slips."""
        return self.sticking.contact_radius if self.sticking.force > 0 else 0.0

    @property
    def stiffness(self) -> float:
        """Tangential stiffness dQ/ds = 2 G* times the stick radius [N/m]."""
        return 2 * self.shear_modulus * self.stick_radius

    @property
    def loss_per_cycle(self) -> float:
        """Energy lost in a cycle of the tangential force between Q and -Q at this normal force [J]."""
        mu, pressed, left = self.friction, self.indentation, self.sticking
        Q = self.force
        # The integral of d over the normal force is F d - U.
        spent = (pressed.force * pressed.depth - pressed.elastic_energy) - (
            left.force * left.depth - left.elastic_energy
        )
        area = self._scale * (pressed.depth * Q - mu * spent)
        return 4 * Q * self.displacement - 8 * area

    def traction(self, r: float | Array) -> Array:
        """Return the tangential traction [Pa] at the radii `r` [m], everywhere along the force.

        Parameters
        ----------
        r : float or array
            Distance from the axis [m].

        Returns
        -------
        float or array
            q [Pa].
        """
        return self.friction * (self.indentation.pressure(r) - self.sticking.pressure(r))

    @property
    def _scale(self) -> float:
        return self.friction * self.indentation.modulus / self.shear_modulus

    def __repr__(self) -> str:
        """Return force, displacement and stick radius."""
        return (
            f"PartialSlip(tangential force {self.force:.4g} N, displacement {self.displacement:.4g} m, "
            f"stick radius {self.stick_radius:.4g} of {self.indentation.contact_radius:.4g} m)"
        )


def partial_slip(
    indentation: Indentation,
    shear_modulus: float,
    friction: float,
    *,
    force: float | None = None,
    displacement: float | None = None,
) -> PartialSlip:
    """Load a pressed body tangentially, from rest.

    Parameters
    ----------
    indentation : Indentation
        The contact under its normal force, from `indent`.
    shear_modulus : float
        Reduced shear modulus G* [Pa], from `reduced_shear_modulus`.
    friction : float
        Coefficient of friction.
    force, displacement : float, optional
        Give exactly one: tangential force [N], at most mu times the normal force, or displacement of the bodies [m].

    Returns
    -------
    PartialSlip

    Raises
    ------
    ValueError
        If the input is invalid, or the force is more than friction can hold.

    Notes
    -----
    Exact if all slip has the direction of the force, for nu = 0. Otherwise the small slip across it is neglected, and
    so is the coupling of normal and tangential displacements (Johnson, Contact Mechanics, 1985, section 7.2).

    Examples
    --------
    >>> from roughcontact.mdr import indentation, indenter, tangential
    >>> pressed = indentation.indent(indenter.paraboloid(1e-2), 1e11, force=1.0)
    >>> slip = tangential.partial_slip(pressed, 8e10, 0.3, force=0.15)
    >>> round(slip.stick_radius / pressed.contact_radius, 4)  # Cattaneo and Mindlin: (1 - Q/(mu F))^(1/3)
    0.7937
    """
    if not isinstance(indentation, Indentation):
        raise InputError(
            f"a pressed body is needed, such as indent(profile, modulus, force=F), not {shown(indentation)}",
            place="indentation",
        )
    for name, value in (("shear_modulus", shear_modulus), ("friction", friction)):
        positive_scalar(value, name)
    _, load = exactly_one(force=force, displacement=displacement)
    given = scalar(load, "tangential load")
    if not (math.isfinite(given) and given >= 0):
        raise InputError(
            f"a tangential load must be finite and not negative, not {given}: only its size matters"
        )
    profile, modulus = indentation.profile, indentation.modulus
    if force is not None:
        rest = indentation.force - force / friction
        if rest < -1e-12 * indentation.force:
            raise InputError(
                f"friction holds at most {friction * indentation.force:g} N, and under {force:g} N the body slides away"
            )
        sticking = indent(profile, modulus, force=max(rest, 0.0))
    else:
        left = indentation.depth - given * shear_modulus / (friction * modulus)
        sticking = indent(profile, modulus, depth=max(left, 0.0))
    return PartialSlip(indentation, sticking, float(shear_modulus), float(friction))
