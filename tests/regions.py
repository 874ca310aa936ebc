"""Planes and regions of them, for the tests of what is done to fields."""

import numpy as np

import roughcontact as rc


def plane(shape=(21, 34), periodic=False):
    return rc.half_space(rc.Grid(shape, (0.3, 0.2), periodic), 2.0)


def region(shape, seed=0, share=0.4):
    return np.random.default_rng(seed).random(shape) < share


def close(found, wanted, size, precision, rounding=20):
    """Equal up to some roundings of numbers of a size."""
    np.testing.assert_allclose(found, wanted, rtol=0, atol=rounding * np.finfo(precision).eps * size)
