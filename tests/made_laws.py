"""Laws of an interface with closed forms, over many decades of pressure."""

import math

import numpy as np

import roughcontact as rc
from roughcontact.theory.joints.mindlin import pair_ratio

ALIKE = (rc.Solid(2.0, 0.0), rc.Solid(2.0, 0.0))  # E* = 1
PER_DECADE = 100


def law(pressure, gap, stiffness, touch=math.nan, *, cells=1e8, map_area=1.0, modulus=1e9, **columns):
    full = np.full(len(pressure), cells)
    return rc.NormalLaw(pressure, gap, stiffness, touch, full, map_area, modulus, math.inf, columns)


def _loads(low, high):
    return np.geomspace(low, high, 1 + round(PER_DECADE * math.log10(high / low)))


def power_law(exponent=0.9, scale=1.0, low=1e-4, high=4.0, **more):
    """Return the law K = scale p^exponent: the closure is p^(1 - a)/(scale (1 - a)) from first touch at the gap 0."""
    p = _loads(low, high)
    return law(p, -(p ** (1 - exponent)) / (scale * (1 - exponent)), scale * p**exponent, 0.0, **more)


def exponential_law(length=0.1, low=1e-6, high=4.0, **more):
    """Return the law p ~ exp(-gap/length), K = p/length, without first touch."""
    p = _loads(low, high)
    return law(p, -length * np.log(p), p / length, **more)


def under_shear(normal, friction=0.3, bodies=ALIKE):
    """Return the law under shear of two bodies, by default of E*/G* = 1, for which it is exact."""
    return rc.ShearLaw(normal, friction, pair_ratio(*bodies), bodies)


def sheared(gap, stiffness, touch, *, friction=0.3, bodies=ALIKE, pressure=None):
    """Return the law under shear whose mean gap and stiffness are functions of the pressure, without cells."""
    p = np.geomspace(1e-3, 1.0, 1501) if pressure is None else pressure
    normal = law(p, gap(p), stiffness(p), touch, cells=math.inf, modulus=1.0, contact_fraction=p / 10)
    return under_shear(normal, friction, bodies)


def exponential(**named):
    """Return the law under shear of ``p = exp(-gap)``."""
    return sheared(lambda p: -np.log(p), lambda p: p, math.nan, **named)


def power(exponent, **named):
    """Return the law under shear of ``K = p^exponent``, with the mean gap 0 at first touch."""
    return sheared(lambda p: -(p ** (1 - exponent)) / (1 - exponent), lambda p: p**exponent, 0.0, **named)


def hertz(**named):
    """Return the law under shear of a sphere, R = E* = 1, on a map of the area 1: depth ``(3 F/4)^(2/3)``."""
    return sheared(lambda p: -((0.75 * p) ** (2 / 3)), lambda p: 2 * (0.75 * p) ** (1 / 3), 0.0, **named)
