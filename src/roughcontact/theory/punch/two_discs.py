"""Two equal discs that act in parallel, far enough apart."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from roughcontact.theory.tools.domain import Array, positive, require
from roughcontact.theory.tools.numeric import numeric

__all__ = ["two_discs"]


@numeric
def two_discs(modulus: npt.ArrayLike, radius: npt.ArrayLike, spacing: npt.ArrayLike) -> Array:
    """Return the stiffness of two equal discs under one rigid body that does not tilt [N/m] (thesis, fig. 12 b).

    Parameters
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    radius : float or array
        Radius a of each disc [m].
    spacing : float or array
        Distance s of their centres [m], at least 3 a.

    Raises
    ------
    ValueError
        If the discs are nearer than three radii: the series is not to be trusted there.

    Notes
    -----
    The depth is d = F/(4 E* a) (1 + (2/pi) v) with, for e = a/s,

        v = e + e^3/3 - 4/(3 pi) e^4 + (2/5) e^5 - 134/(45 pi) e^6 + (5/7 + 32/(9 pi^2)) e^7.

    The odd powers are what two discs with the pressure of a single one do to each other; the fourth and sixth, and
    a part of the seventh, come from the pressures that move away from the other disc. The relative error is
    below 2e-4 at s = 3 a and 2e-8 at s = 10 a.
    """
    a, s = positive(radius, "radius [m]"), positive(spacing, "spacing [m]")
    require(
        s >= 3 * a,
        "spacing must be at least three radii: the series in radius/spacing fails when they are nearer",
    )
    e = a / s
    powers = (1, 0, 1 / 3, -4 / (3 * np.pi), 2 / 5, -134 / (45 * np.pi), 5 / 7 + 32 / (9 * np.pi**2))
    v = e * np.polynomial.polynomial.polyval(e, powers)
    value: Array = 4 * positive(modulus, "modulus [Pa]") * a / (1 + 2 / np.pi * v)
    return value
