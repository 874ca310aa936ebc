"""Bisection; Newton's method on concave functions: far starts, both directions, functions without a root."""

import numpy as np
import pytest

from roughcontact.theory.tools.roots import bisect, concave_root


@pytest.mark.parametrize("start", [-300.0, 0.0, 500.0])
def test_decreasing(start):
    def function(x):
        return -np.exp(x / 10) - x, -np.exp(x / 10) / 10 - 1

    root = np.array([-3.0, 0.2, 40.0])
    found = concave_root(function, function(root)[0], np.full(3, start))
    # Rounding of values up to 100, over slopes of at least 1.
    assert found == pytest.approx(root, abs=1e-13)


def test_increasing():
    root = np.geomspace(1e-3, 1e3, 7)
    found = concave_root(lambda x: (np.sqrt(x), 0.5 / np.sqrt(x)), np.sqrt(root), np.full(7, 1e-4))
    assert found == pytest.approx(root, rel=1e-14)


def test_no_root():
    with pytest.raises(RuntimeError, match="found no root"):
        concave_root(lambda x: (-(x**2) - 1, -2 * x), np.array([0.0]), np.array([0.3]))


def test_bisection():
    wanted = np.array([0.0, 1e-9, 0.5, 1.0])
    # A bracket of the size of the root, so the error is relative.
    root = bisect(lambda x: x**3 > wanted, np.cbrt(wanted) / 2, 2 * np.cbrt(wanted))
    np.testing.assert_allclose(root, np.cbrt(wanted), rtol=4e-16)
    assert np.ndim(bisect(lambda x: np.exp(x) > 2.0, 0.0, 1.0)) == 0
