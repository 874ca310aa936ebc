"""Totals that a loop leaves: the largest of what its body finds, and sums, in double precision."""

import math
from functools import cache

import numpy as np
import pytest

pytest.importorskip("llvmlite")

from roughcontact.kernels import loader
from roughcontact.kernels.code import Code
from roughcontact.kernels.constants import WIDTH
from roughcontact.kernels.groups import Cells
from roughcontact.kernels.signature import Doubles, Vector, kernel
from roughcontact.kernels.totals import Totals

pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")

SIZES = (0, 1, 3, 4, 7, 8, 9, 35)


@cache
def made(precision, most):
    """Return what finds a number, its negative, its square, and itself."""

    def tiny(code: Code, cells: Cells, a: Vector, totals: Doubles):
        found = Totals(code, totals, 4 - most, most, compensated=True)
        for i in cells.each(code, found):
            x = a[i]
            found.add(x, -x, x * x, x)

    kernels = {"tiny": kernel(tiny)}
    return loader._loaded(loader._translated(kernels, precision), kernels, precision)["tiny"]


def totals_of(field, most=2, parts=1, workers=1):
    """Return what is left of a field, of which the first are the largest; nothing lies behind."""
    part = -(-max(field.size, 1) // parts)
    totals = np.full(4 * parts + 2, 77.0)
    made(field.dtype.name, most)(field.size, part, field, totals, workers=workers)
    assert totals[4 * parts :].tolist() == [77, 77]
    return totals[:4]


@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.parametrize("size", SIZES)
def test_largest_and_sums(precision, size):
    """Of nothing the largest is less than any number, and the sum is nothing."""
    field = (np.random.default_rng(0).standard_normal(size) - 3).astype(
        precision
    )  # all of them negative, or nearly
    highest, lowered, squares, total = totals_of(field)
    assert highest == field.max(initial=-math.inf)
    assert lowered == -field.min(initial=math.inf)
    wide = field.astype(np.float64)
    # A square may be rounded in its precision; sums are rounded in double precision.
    rounding = np.finfo(precision).eps + size * np.finfo(np.float64).eps
    assert squares == pytest.approx(math.fsum(wide**2), rel=float(rounding), abs=0)
    size_of_terms = math.fsum(np.abs(wide))
    assert total == pytest.approx(math.fsum(wide), rel=0, abs=size * np.finfo(np.float64).eps * size_of_terms)


@pytest.mark.parametrize("most", [0, 4])
def test_sums_alone_and_largest_alone(most):
    field = np.arange(1.0, 12.0)
    wanted = [11, -1, 121, 11] if most else [66, -66, 506, 66]
    assert totals_of(field, most).tolist() == wanted


@pytest.mark.parametrize("workers", [1, 3])
def test_those_of_all_parts_are_combined(workers):
    """Of whole numbers nothing is rounded, and whoever does a part, the bits of sums are the same."""
    field = np.random.default_rng(1).permutation(2**14).astype(np.float64)
    wanted = [field.max(), -field.min(), (field**2).sum(), field.sum()]
    assert totals_of(field, parts=64, workers=workers).tolist() == wanted
    field /= 3
    one, *others = (totals_of(field, parts=64, workers=workers).tolist() for _ in range(50))
    assert all(other == one for other in others)
    assert totals_of(field, parts=64).tolist() == one


@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.parametrize("wrong", [math.nan, math.inf, -math.inf])
def test_what_is_no_number_is_in_the_sum(precision, wrong):
    """Wherever it is; an infinite one as such, and what is none is never among those that are larger."""
    lanes = WIDTH // np.dtype(precision).itemsize
    for at in range(2 * lanes + 3):
        field = np.ones(2 * lanes + 3, precision)
        field[at] = wrong
        highest, lowered, squares, total = totals_of(field)
        np.testing.assert_array_equal([squares, total], [wrong * wrong, wrong])
        if not math.isnan(wrong):
            assert (highest, lowered) == (max(wrong, 1.0), max(-wrong, -1.0))


@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_what_is_no_number_hides_no_larger_one(precision):
    lanes = WIDTH // np.dtype(precision).itemsize
    for at in range(3 * lanes + 3):
        field = np.arange(3 * lanes + 3, 0, -1).astype(precision)
        field[at] = np.nan
        assert totals_of(field)[:2].tolist() == [np.nanmax(field), -np.nanmin(field)]
