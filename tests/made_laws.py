"""Laws of an interface with closed forms."""

import math

import numpy as np

import roughcontact as rc

PER_DECADE = 100
RIGID_POISSON = (rc.Solid(2e9, 0.0), rc.Solid(2e9, 0.0))


def law(pressure, gap, touch=math.nan, cells=1e8, map_area=1.0, modulus=1e9, **columns):
    full = np.full(len(pressure), cells)
    return rc.NormalLaw(pressure, gap, touch, full, map_area, modulus, math.inf, columns)


def power_law(exponent=0.9, scale=1.0, low=1e-4, high=4.0, **more):
    """Return the law K = scale p^exponent: the closure is p^(1 - a)/(scale (1 - a)) from first touch at the gap 0."""
    p = np.geomspace(low, high, 1 + round(PER_DECADE * math.log10(high / low)))
    return law(p, -(p ** (1 - exponent)) / (scale * (1 - exponent)), 0.0, **more)


def exponential_law(length=0.1, low=1e-6, high=4.0, **more):
    """Return the law p ~ exp(-gap/length), K = p/length, without first touch: the gap is linear in ln p."""
    p = np.geomspace(low, high, 50)
    return law(p, -length * np.log(p), **more)


def under_shear(normal, friction=0.3):
    """Return a law under shear that is exact: E*/G* = 1."""
    return rc.ShearLaw(normal, friction, 1.0, RIGID_POISSON)
