"""Planes and regions of them, and the fields of solves on them, for the tests of what is done to fields."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.kernels import loader
from roughcontact.solver.compiled_vectors import CompiledVectors
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.vectors import ArrayVectors, vectors_on

PRECISIONS = ("float32", "float64")


def plane(shape=(21, 34), periodic=False):
    return rc.half_space(rc.Grid(shape, (0.3, 0.2), periodic), 2.0)


def region(shape, seed=0, share=0.4):
    return np.random.default_rng(seed).random(shape) < share


def close(found, wanted, size, precision, rounding=20):
    """Equal up to some roundings of numbers of a size."""
    np.testing.assert_allclose(found, wanted, rtol=0, atol=rounding * np.finfo(precision).eps * size)


@dataclass(frozen=True)
class Bare:
    """A driver whose preconditioner is the same for both kinds of fields."""

    operator: Operator
    diagonal_correction: ClassVar[float] = 0.0
    local_inverse: ClassVar[None] = None
    combine: ClassVar[None] = None

    @property
    def weights(self):
        return self.operator.weights

    def apply(self, pressure):
        return self.operator.apply(pressure)

    def approximate_inverse(self, displacement):
        return self.operator.approximate_inverse(displacement)


class Seeing:
    """A driver whose preconditioner sees all cells from each: so it would what is left of an error outside.

    Of eighths it makes numbers that need no rounding.
    """

    weights = 0.25
    diagonal_correction = 0.0
    local_inverse = None
    combine = None
    part = 1 / 256

    @classmethod
    def approximate_inverse(cls, displacement):
        return np.full_like(displacement, cls.part * displacement.sum(dtype=np.float64))


def on(driver, kept, lacking, base=None, *hardness):
    """Return the fields of a solve that begins with no change; what is lacking is not overwritten."""
    base = np.zeros_like(lacking) if base is None else base
    return vectors_on(driver, Measure(driver.weights), kept, lacking.copy(order="K"), base, *hardness)


def generic(*given):
    """Return what there is without machine code."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(loader, "is_available", lambda: False)
        return on(*given)


def both_of(*given):
    one, two = on(*given), generic(*given)
    assert isinstance(one, CompiledVectors)
    assert isinstance(two, ArrayVectors)
    assert one.upper is None
    assert two.upper is None
    return one, two


def eighths(rng, shape, precision, most=4.0):
    """Return numbers of which sums and products with other such numbers need no rounding."""
    most = int(8 * most)
    return (rng.integers(-most, most + 1, shape) / 8).astype(precision)
