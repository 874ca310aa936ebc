"""Laws of an interface by formula, as if they were computed at many loads."""

import math

import numpy as np

import roughcontact as rc
from roughcontact.theory.joints.mindlin import pair_ratio

ALIKE = (rc.Solid(2.0, 0.0), rc.Solid(2.0, 0.0))  # E* = 1


def law_of(gap, stiffness, touch, *, friction=0.3, bodies=ALIKE, pressure=None):
    """Return the law whose mean gap and stiffness are functions of the pressure, without cells."""
    p = np.geomspace(1e-3, 1.0, 1501) if pressure is None else pressure
    fractions = {"contact_fraction": p / 10}
    normal = rc.NormalLaw(
        p, gap(p), stiffness(p), touch, np.full(len(p), math.inf), 1.0, 1.0, math.inf, fractions
    )
    return rc.ShearLaw(normal, friction, pair_ratio(*bodies), bodies)


def exponential(**named):
    """Return the law ``p = exp(-gap)``."""
    return law_of(lambda p: -np.log(p), lambda p: p, math.nan, **named)


def power(exponent, **named):
    """Return the law of the stiffness ``K = p^exponent``, with the mean gap 0 at first touch."""
    return law_of(lambda p: -(p ** (1 - exponent)) / (1 - exponent), lambda p: p**exponent, 0.0, **named)


def hertz(**named):
    """Return the law of a sphere with R = E* = 1 on a map of the area 1: depth ``(3 F/4)^(2/3)``."""
    return law_of(lambda p: -((0.75 * p) ** (2 / 3)), lambda p: 2 * (0.75 * p) ** (1 / 3), 0.0, **named)
