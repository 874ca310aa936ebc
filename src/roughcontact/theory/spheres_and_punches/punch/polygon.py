"""Flat punches without a closed form: the square and the equilateral triangle, with the errors of their numbers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughcontact.validation import Array, numeric, positive

__all__ = ["SQUARE", "TRIANGLE", "Computed", "shape_factor", "square", "triangle"]


@dataclass(frozen=True, slots=True)
class Computed:
    """A computed number, without a closed form.

    Attributes
    ----------
    value : float
        The number.
    uncertainty : float
        A bound on its error, estimated by refinement.
    how : str
        How it was computed.

    Examples
    --------
    >>> from roughcontact.theory import punch
    >>> punch.SQUARE.value, punch.SQUARE.uncertainty  # k/(E* L)
    (1.152298, 1e-06)
    """

    value: float
    uncertainty: float
    how: str


# Cells of uniform pressure, N a side, approach from below: k_N = k (1 - c1/N) + c2/N^e + c3/N^2. The exponent
# e = 1 + 2 nu comes from the singularity r^(nu - 1) of the pressure in a corner.
SQUARE = Computed(
    1.152298,
    1e-6,
    "16 to 160 square cells a side, extrapolated with e = 1.593",
)
TRIANGLE = Computed(
    0.78811, 1e-5, "12 to 128 triangular cells a side, extrapolated with e between 1.45 and 1.55"
)


@numeric
def square(modulus: ArrayLike, side: ArrayLike) -> Array:
    """Return the stiffness of a square, k = 1.152298(1) E* L [N/m] (thesis, eqs 4.7 and 4.14, which have 1.1419).

    Parameters
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    side : float or array
        Side L [m].

    Returns
    -------
    float or array
        k [N/m].

    Examples
    --------
    >>> from roughcontact.theory import punch
    >>> round(float(punch.square(1e11, 1e-3)))
    115229800
    """
    return SQUARE.value * positive(modulus, "modulus [Pa]") * positive(side, "side [m]")


@numeric
def triangle(modulus: ArrayLike, side: ArrayLike) -> Array:
    """Return the stiffness of an equilateral triangle, k = 0.78811(1) E* L [N/m] (beside thesis, fig. 12).

    Parameters
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    side : float or array
        Side L [m].

    Returns
    -------
    float or array
        k [N/m].

    Examples
    --------
    >>> from roughcontact.theory import punch
    >>> round(float(punch.triangle(1e11, 1e-3)))
    78811000
    """
    return TRIANGLE.value * positive(modulus, "modulus [Pa]") * positive(side, "side [m]")


@numeric
def shape_factor(stiffness: ArrayLike, modulus: ArrayLike, area: ArrayLike) -> Array:
    """Return the stiffness over that of a disc of the same area, k/(2 E* sqrt(A/pi)) [-]; never below 1.

    Parameters
    ----------
    stiffness : float or array
        Contact stiffness k [N/m].
    modulus : float or array
        Reduced modulus E* [Pa].
    area : float or array
        Contact area A [m^2].

    Returns
    -------
    float or array
        Shape factor [-].

    Examples
    --------
    >>> from roughcontact.theory import punch
    >>> round(float(punch.shape_factor(punch.square(1e11, 1e-3), 1e11, 1e-6)), 4)
    1.0212
    """
    k, a = positive(stiffness, "stiffness [N/m]"), positive(area, "area [m^2]")
    return k / (2 * positive(modulus, "modulus [Pa]") * np.sqrt(a / np.pi))
