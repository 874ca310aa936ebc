"""The contact of a body whose transform decreases somewhere: one disc, or no contact that the method can compute.

If a transform never decreases, the contact is a disc at every load. If it decreases, the contact is not a disc at some
loads, but may be one at larger loads. The solution at a load is unique: a disc without tension inside and without
overlap outside is the solution. If there is no such disc, the load is refused.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from roughcontact.errors import InputError
from roughcontact.mdr.bodies.axisymmetric_profile import Profile
from roughcontact.mdr.bodies.recovery import pressure, surface_displacement
from roughcontact.theory.tools.roots import bisect
from roughcontact.validation import Array

__all__ = ["disc_radius", "sample_radii"]

SAMPLES = 2000  # radii at which a transform that may decrease is sampled
PROBES = 128  # radii at which a disc is checked, inside and outside
TOLERANCE = 1e-9  # tension relative to the largest pressure, and overlap relative to the depth


def sample_radii(profile: Profile, end: float) -> Array:
    """Return radii that resolve every extremum of a transform up to `end` [m]."""
    breaks = np.array([b for b in profile.breaks if b < end])
    around = np.concatenate([breaks * (1 - 1e-9), breaks, breaks * (1 + 1e-9)])
    return np.unique(
        np.concatenate([np.linspace(0.0, end, SAMPLES), np.geomspace(1e-9, 1, 200) * end, around])
    )


def disc_radius(
    profile: Profile, value: Callable[[Array], Array], target: float, depth: Callable[[float], float]
) -> float:
    """Return the radius of the disc that is a contact and at which `value` equals `target`.

    Parameters
    ----------
    profile : Profile
    value : callable
        Depth or force as a function of the contact radius.
    target : float
    depth : callable
        Depth [m] of a contact radius [m] at this load.

    Raises
    ------
    ValueError
        If the body has no end, or the contact is not one disc; the message states where.
    """
    if not math.isfinite(profile.radius):
        raise InputError(
            "the transform of this body may decrease", "set the radius of the body by cut(radius)"
        )
    x = sample_radii(profile, profile.radius)
    transform = profile.transform(x)
    below = value(x) <= target
    low = np.nonzero(below[:-1] & ~below[1:])[0]
    found = bisect(lambda a: value(a) > target, x[low], x[low + 1]).tolist()
    if below[-1]:
        found.append(profile.radius)
    objections = []
    for a in found:
        d = depth(a)
        if (np.diff(transform[x < a]) >= 0).all() and (transform[x > a] >= d).all():
            return float(a)
        objection = _objection(profile, a, d)
        if objection is None:
            return float(a)
        objections.append(f"with radius {a:g} m {objection}")
    raise InputError("at this load the contact is not one disc: " + "; ".join(objections))


def _objection(profile: Profile, a: float, d: float) -> str | None:
    """Return the radius at which a disc of radius `a` and depth `d` has tension or overlap, in words."""
    if a > 0:
        r = a * (np.arange(PROBES) + 0.5) / PROBES
        p = pressure(profile, 1.0, a, d, r)
        if p.min() < -TOLERANCE * p.max():
            return f"there would be tension at r = {r[p.argmin()]:g} m"
    r = a + (profile.radius - a) * np.arange(1, PROBES + 1) / PROBES
    if a < profile.radius:
        gap = surface_displacement(profile, a, d, r) + profile.height(r) - d
        if gap.min() < -TOLERANCE * abs(d):
            return f"the body would also touch at r = {r[gap.argmin()]:g} m"
    return None
