"""Laws of an interface with closed forms, over many decades of pressure."""

import math

import numpy as np

import roughcontact as rc
from interfaces import ALIKE

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


def under_shear(normal, friction=0.3):
    """Return a law under shear that is exact: E*/G* = 1."""
    return rc.ShearLaw(normal, friction, 1.0, ALIKE)
