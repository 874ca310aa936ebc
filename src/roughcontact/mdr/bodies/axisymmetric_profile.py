"""Bodies of revolution as sums of terms: the contact of a sum is that of the sum of the transforms."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.units import in_si
from roughcontact.validation import Array, number, require, scalar, shown

__all__ = ["Profile", "Term", "checked_profile", "checked_radii"]


class Term(Protocol):
    """One part of a body's height and its transform, as functions of arrays of radii >= 0."""

    @property
    def flat(self) -> float:
        """Radius up to which the term vanishes [m]."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Radii at which the term is not smooth, or between which it is monotone [m]."""

    @property
    def rises(self) -> bool:
        """Whether the transform is known never to fall."""

    def height(self, r: Array) -> Array:
        """Return f(r) [m]."""

    def transform(self, x: Array) -> Array:
        """Return g(x) [m]."""

    def slope(self, x: Array) -> Array:
        """Return g'(x) [-]."""

    def primitive(self, x: Array) -> Array:
        """Return the integral of g from 0 to x [m^2]."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Profile:
    """A rigid body of revolution that is pressed, apex first, into an elastic half-space.

    Made by the functions of `roughcontact.mdr.indenter` and by arithmetic: ``first + second`` adds heights and
    transforms; ``2 * body`` stretches a body along its axis.

    Parameters
    ----------
    terms : tuple of (float, Term)
        Parts of the height with their factors. None: a flat face.
    radius : float
        Radius at which the body ends [m].
    edge : bool
        Whether it ends there in a sharp edge, to which a contact can be pinned. If not, the body is unknown beyond,
        and a load whose contact extends to this radius is refused.
    rises : bool
        Whether the transform never decreases: then the contact is one disc at every load.
    """

    terms: tuple[tuple[float, Term], ...]
    radius: float = math.inf
    edge: bool = False
    rises: bool = True

    @property
    def flat(self) -> float:
        """Radius of the flat face [m]: of the contact at first touch."""
        return min((term.flat for c, term in self.terms if c), default=self.radius)

    @property
    def breaks(self) -> tuple[float, ...]:
        """Radii inside the body at which the transform is not smooth [m], increasing."""
        return tuple(sorted({b for _, term in self.terms for b in term.breaks if 0 < b < self.radius}))

    def height(self, r: float | Array) -> Array:
        """Return the height f(r) above the apex [m]; beyond the body infinite, or NaN if it is unknown."""
        r = checked_radii(r)
        inside = np.minimum(r, self.radius)
        beyond = math.inf if self.edge else math.nan
        return np.where(r > self.radius, beyond, self._sum("height", inside))

    def transform(self, x: float | Array) -> Array:
        """Return g(x) [m]: the depth at which the contact has the radius x."""
        return self._sum("transform", checked_radii(x))

    def transform_slope(self, x: float | Array) -> Array:
        """Return g'(x) [-]; infinite at the edge of a flat face and at a cusp."""
        return self._sum("slope", checked_radii(x))

    def transform_integral(self, x: float | Array) -> Array:
        """Return the integral of g from 0 to x [m^2]."""
        return self._sum("primitive", checked_radii(x))

    def _sum(self, function: str, places: Array) -> Array:
        """Return the sum of the functions of one name over the terms."""
        return sum((c * getattr(term, function)(places) for c, term in self.terms), np.zeros_like(places))

    def cut(self, radius: float) -> Profile:
        """Return the body cut off at a `radius` [m], where it ends in a sharp edge.

        Raises
        ------
        ValueError
            If the radius is not positive, or the body is not known up to it.
        """
        end = scalar(radius, "the radius of a cut [m]")
        if not (math.isfinite(end) and 0 < end <= self.radius):
            raise about("the radius", f"of a cut must lie between 0 and {self.radius:g} m, not {radius}")
        return replace(self, radius=end, edge=True)

    def __add__(self, other: Profile) -> Profile:
        """Return the body whose height is the sum of both."""
        if not isinstance(other, Profile):
            return NotImplemented
        radius = min(self.radius, other.radius)
        edge = any(body.edge and body.radius == radius for body in (self, other))
        return Profile(self.terms + other.terms, radius, edge, self.rises and other.rises)

    def __sub__(self, other: Profile) -> Profile:
        """Return the body whose height is the difference of both."""
        return self + (-1.0) * other if isinstance(other, Profile) else NotImplemented

    def __mul__(self, factor: float) -> Profile:
        """Return the body stretched along its axis."""
        factor = in_si(factor, None, "factor")
        if not isinstance(factor, int | float | np.integer | np.floating):
            return NotImplemented
        require(
            math.isfinite(factor),
            f"a body can be stretched by a finite factor, not by {factor}",
            place="factor",
        )
        terms = tuple((float(factor) * c, term) for c, term in self.terms)
        return replace(self, terms=terms, rises=self.rises and factor >= 0)

    __rmul__ = __mul__

    def __repr__(self) -> str:
        """Return the terms of the body and its radius."""
        parts = " + ".join(f"{c:g} * {term!r}" if c != 1 else repr(term) for c, term in self.terms) or "flat"
        end = (
            f", {'edge' if self.edge else 'known'} to {self.radius:g} m" if math.isfinite(self.radius) else ""
        )
        return f"Profile({parts}{end})"


def checked_profile(profile: Profile) -> Profile:
    """Return a body of revolution, or refuse anything else."""
    if not isinstance(profile, Profile):
        raise InputError(
            f"a body of revolution is needed, such as indenter.paraboloid(radius), not {shown(profile)}",
            place="profile",
        )
    return profile


def checked_radii(radii: float | Array) -> Array:
    """Return radii [m] as an array, or refuse negative and missing ones."""
    r = np.asarray(number(radii, "radii [m]"))
    require(r >= 0, "radii must not be negative or missing [m]", value=r, place="radii")
    return r
