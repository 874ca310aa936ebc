"""The quadrature under the waves: exact for polynomials, panels that grow as they should."""

import pytest

from roughcontact.theory.tools.quadrature import gauss, graded, running


def test_gauss_integrates_polynomials():
    x, weights = gauss(5)
    for power in range(10):
        assert weights @ x**power == pytest.approx(1 / (power + 1), rel=1e-14)


def test_running_integrals_are_those_of_polynomials():
    x, _ = gauss(6)
    for power in range(6):
        assert running(x) @ x**power == pytest.approx(x ** (power + 1) / (power + 1), rel=1e-12)


def test_panels_grow_by_the_ratio_at_most():
    edges = graded(1e-6, 3.0, 1.5)
    assert edges[0] == 0
    assert edges[1] == 1e-6
    assert edges[-1] == 3.0
    assert (edges[2:] / edges[1:-1]).max() <= 1.5 + 1e-12
