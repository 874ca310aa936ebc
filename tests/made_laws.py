"""Laws of an interface with closed forms."""

import math

import numpy as np

import roughcontact as rc

PER_DECADE = 100
RIGID_POISSON = (rc.Solid(2e9, 0.0), rc.Solid(2e9, 0.0))


def law(pressure, gap, touch=math.nan, stiffness=None, cells=1e8, map_area=1.0, modulus=1e9, **columns):
    full = np.full(len(pressure), cells)
    slope = -1 / np.gradient(gap, pressure) if stiffness is None else stiffness
    return rc.NormalLaw(pressure, gap, slope, touch, full, map_area, modulus, math.inf, columns)


def power_law(exponent=0.9, scale=1.0, low=1e-4, high=4.0, **more):
    """Return the law K = scale p^exponent: the closure is p^(1 - a)/(scale (1 - a)) from first touch at the gap 0."""
    p = np.geomspace(low, high, 1 + round(PER_DECADE * math.log10(high / low)))
    return law(p, -(p ** (1 - exponent)) / (scale * (1 - exponent)), 0.0, scale * p**exponent, **more)


def exponential_law(length=0.1, low=1e-6, high=4.0, **more):
    """Return the law p ~ exp(-gap/length), K = p/length, without first touch: 1000 loads."""
    p = np.geomspace(low, high, 1000)
    return law(p, -length * np.log(p), stiffness=p / length, **more)


def under_shear(normal, friction=0.3):
    """Return a law under shear that is exact: E*/G* = 1."""
    return rc.ShearLaw(normal, friction, 1.0, RIGID_POISSON)
