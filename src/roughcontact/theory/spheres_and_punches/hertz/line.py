"""Hertz' line contact, per unit length, from any three of its quantities."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import lambertw

from roughcontact.errors import InputError, about
from roughcontact.theory.tools.products import Product, checked, solve
from roughcontact.validation import Array, numeric, positive, require

__all__ = ["LineContact", "line"]

# Powers of E*, R and a.
QUANTITIES = {
    "modulus": Product((1, 0, 0), unit="Pa"),
    "radius": Product((0, 1, 0), unit="m"),
    "half_width": Product((0, 0, 1), unit="m"),
    "force": Product((1, -1, 2), np.pi / 4, unit="N/m"),
    "max_pressure": Product((1, -1, 1), 1 / 2, unit="Pa"),
}
# The scale of the depth, F'/(pi E*).
WITH_SCALE = {**QUANTITIES, "scale": Product((0, -1, 2), 1 / 4, unit="m")}


@dataclass(frozen=True, slots=True, eq=False)
class LineContact:
    """A parabolic cylinder on an elastic half-space; numbers or arrays of one shape.

    Attributes
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    radius : float or array
        Radius of curvature R at the apex [m].
    half_width : float or array
        Half the width of the contact, a [m].
    force : float or array
        Normal force per length, F' [N/m].
    max_pressure : float or array
        Pressure p0 in the middle [Pa]; the mean is pi/4 of it.
    reference_length : float or None
        Distance L from a line load at which its displacement is zero [m]; None leaves depths undefined.

    Examples
    --------
    >>> from roughcontact.theory import hertz
    >>> contact = hertz.line(1e11, radius=1e-2, force=1e4, reference_length=1e-2)
    >>> a = contact.half_width
    >>> f"{a * 1e6:.1f} um", f"{contact.pressure(0.6 * a) / contact.max_pressure:.6f}"  # (1 - 0.6^2)^(1/2)
    ('35.7 um', '0.800000')
    >>> f"{contact.displacement(0.0) / contact.depth:.6f}"
    '1.000000'
    """

    modulus: Array
    radius: Array
    half_width: Array
    force: Array
    max_pressure: Array
    reference_length: float | None = None

    @property
    def depth(self) -> Array:
        """Indentation depth against the reference length, F'/(pi E*) (2 ln(2L/a) + 1) [m]."""
        return self.half_width**2 / (4 * self.radius) * (2 * self._logarithm() + 1)

    @property
    def stiffness(self) -> Array:
        """dF'/dd per length, pi E*/(2 ln(2L/a)): that of a flat strip of the same width [N/m^2]."""
        return np.pi * self.modulus / (2 * self._logarithm())

    @numeric
    def pressure(self, position: ArrayLike) -> Array:
        """Return the pressure [Pa] at a `position` from the middle [m]; 0 outside the contact.

        Parameters
        ----------
        position : float or array
            Distance x from the middle, of either sign [m].

        Returns
        -------
        float or array
            p [Pa].
        """
        x = np.asarray(position, dtype=np.float64)
        half_chord = np.sqrt(np.maximum(self.half_width**2 - x**2, 0.0))
        return self.modulus / (2 * self.radius) * half_chord

    @numeric
    def displacement(self, position: ArrayLike) -> Array:
        """Return the displacement of the surface [m] at a `position` from the middle [m], inside and outside.

        Parameters
        ----------
        position : float or array
            Distance x from the middle, of either sign [m].

        Returns
        -------
        float or array
            u [m].
        """
        x = np.abs(np.asarray(position, dtype=np.float64))
        theta = np.arccosh(np.maximum(x / self.half_width, 1.0))
        sagitta = self.half_width**2 / (4 * self.radius)
        outside = sagitta * (2 * self._logarithm() - 2 * theta - np.exp(-2 * theta))
        return np.where(x <= self.half_width, self.depth - x**2 / (2 * self.radius), outside)[()]

    def _logarithm(self) -> Array:
        """Return ln(2L/a)."""
        if self.reference_length is None:
            raise InputError(
                "the depth of a line contact grows with the size of the body",
                "give a reference_length [m], the distance at which the displacement is zero",
            )
        return np.log(2 * self.reference_length / self.half_width)


def line(
    modulus: ArrayLike | None = None,
    *,
    radius: ArrayLike | None = None,
    half_width: ArrayLike | None = None,
    force: ArrayLike | None = None,
    max_pressure: ArrayLike | None = None,
    depth: ArrayLike | None = None,
    reference_length: float | None = None,
) -> LineContact:
    """Return the contact of a parabolic cylinder from any three independent quantities (beside thesis, eq. A.37).

    F' = pi E* a^2/(4R), p0 = E* a/(2R), d = F'/(pi E*) (2 ln(2L/a) + 1).

    Parameters
    ----------
    modulus, radius, half_width, force, max_pressure : float or array, optional
        See `LineContact`; arrays are broadcast.
    depth : float or array, optional
        Indentation depth against `reference_length` [m].
    reference_length : float, optional
        Needed for depths, stiffness and displacements [m]. At least the size of the body; another length L2 instead of
        L1 shifts the depth by 2 F' ln(L2/L1)/(pi E*). With 2 sqrt(R1 R2)/e the depth is the approach of the axes of
        two cylinders of one material, see `roughcontact.line`.

    Returns
    -------
    LineContact

    Raises
    ------
    ValueError
        If not three are given, if they depend on each other, if one is not positive, or if the reference length
        is below a quarter of the width: then a larger force would give a smaller depth.

    Examples
    --------
    >>> from roughcontact.theory import hertz
    >>> roller = hertz.line(1e11, radius=1e-2, force=1e5)
    >>> round(float(roller.half_width) * 1e6, 2), round(float(roller.max_pressure) / 1e9, 4)  # [um], [GPa]
    (112.84, 0.5642)
    """
    known = checked(QUANTITIES, (modulus, radius, half_width, force, max_pressure))
    if reference_length is not None:
        reference_length = float(positive(reference_length, "reference_length [m]"))
    if depth is not None:
        known |= _replaced(known, positive(depth, "depth [m]"), reference_length)
    quantities = solve(WITH_SCALE if "scale" in known else QUANTITIES, known)
    contact = LineContact(
        **{name: quantities[name] for name in QUANTITIES}, reference_length=reference_length
    )
    if reference_length is not None:
        require(
            2 * reference_length > contact.half_width,
            f"reference_length must exceed a quarter of the contact's width, not {reference_length} m: "
            "below, a larger force would give a smaller depth",
            place="reference_length",
        )
    return contact


def _replaced(known: dict[str, Array], depth: Array, reference_length: float | None) -> dict[str, Array]:
    """Return the quantity that replaces the depth: its scale F'/(pi E*), or the half width."""
    if reference_length is None:
        raise about("the depth", "of a line contact is undefined without a reference_length [m]")
    if known.keys() == {"force", "max_pressure"}:
        half_width = 2 * known["force"] / (np.pi * known["max_pressure"])
    elif "half_width" in known:
        half_width = known["half_width"]
    else:
        return {"half_width": _half_width(known, depth, reference_length)}
    return {"scale": depth / (2 * np.log(2 * reference_length / half_width) + 1)}


def _half_width(known: dict[str, Array], depth: Array, reference_length: float) -> Array:
    """Solve depth = scale (1 - 2 ln x) for the half width a = 2 L x; the scale goes as x^n with n = 0, 1 or 2."""
    wide = 2 * reference_length
    once, twice = (solve(WITH_SCALE, {**known, "half_width": np.array(x * wide)})["scale"] for x in (1, 2))
    n = float(np.round(np.log2(twice / once)).flat[0])
    if n == 0:
        return wide * np.exp((1 - depth / once) / 2)
    # With w = ln(x^n) - n/2 it becomes w e^w = -(n/2) (depth/scale) e^(-n/2); the branch -1 has the smaller x.
    argument = -n / 2 * depth / once * math.exp(-n / 2)
    require(
        argument >= -1 / math.e,
        f"no contact has this depth: reference_length {reference_length} m is too short",
    )
    w: Array = lambertw(argument, -1).real
    return wide * np.exp(w / n + 1 / 2)
