"""Partial moments of height distributions: closed forms, quadrature, recurrences, far tails."""

import math

import mpmath
import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import log_ndtr

from roughcontact.theory.random_surfaces.partial_moments import LOW, log_exponential, log_gaussian

ORDERS = [-0.5, 0.5, 1.5, 2.5, 11 / 3]


def by_quadrature(order, plane, density):
    """F_n(t) by adaptive quadrature; x - t = v^4 takes the singularity of a negative order away."""
    value, _ = quad(
        lambda v: 4 * v ** (4 * order + 3) * density(plane + v**4), 0, 3, epsabs=0, epsrel=1e-12, limit=200
    )
    return value


def normal(x):
    return math.exp(-(x**2) / 2) / math.sqrt(2 * math.pi)


class TestGaussian:
    @pytest.mark.parametrize("order", ORDERS)
    @pytest.mark.parametrize("plane", [-9.0, -1.3, 0.0, 0.4, LOW, 2.2, 7.0])
    def test_quadrature(self, order, plane):
        expected = by_quadrature(order, plane, normal)
        assert np.exp(log_gaussian(order, plane)) == pytest.approx(expected, rel=1e-11)

    def test_numbers_greenwood_and_williamson_tabulate(self):
        assert np.exp(log_gaussian(0.5, 0.0)) == pytest.approx(0.4110895, abs=5e-8)
        assert np.exp(log_gaussian(1.5, np.array([0.0, 1.5]))) == pytest.approx(
            [0.43002, 0.0246395], abs=5e-8
        )

    def test_elementary_orders(self):
        t = np.linspace(-8, 30, 96)
        assert log_gaussian(0, t) == pytest.approx(log_ndtr(-t), rel=1e-13)
        t = t[t < 3]  # beyond, the elementary form cancels
        q, phi = np.exp(log_ndtr(-t)), np.exp(-(t**2) / 2) / math.sqrt(2 * math.pi)
        # It loses phi/F_1, at t = 3 a factor of 12, of 16 digits.
        assert np.exp(log_gaussian(1, t)) == pytest.approx(phi - t * q, rel=1e-13)

    @pytest.mark.parametrize("order", ORDERS)
    @pytest.mark.parametrize("plane", [20.0, 37.5, 300.0])
    def test_far_where_the_moment_itself_is_no_float(self, order, plane):
        with mpmath.workdps(30):
            n, t = mpmath.mpf(order), mpmath.mpf(plane)
            expected = (
                mpmath.log(mpmath.gamma(n + 1) * mpmath.pcfd(-n - 1, t) / mpmath.sqrt(2 * mpmath.pi))
                - t**2 / 4
            )
        # The last digits of a logarithm of size t^2/2.
        assert log_gaussian(order, plane) == pytest.approx(float(expected), rel=1e-15)

    @pytest.mark.parametrize("order", [0.5, 1.5, 4.2])
    def test_recurrence_joins_three_orders(self, order):
        # Integration by parts: F_{n+1} = n F_{n-1} - t F_n; with t < 0 all terms are positive.
        t = np.linspace(-12, 0, 25)
        up, same, down = (np.exp(log_gaussian(n, t)) for n in (order + 1, order, order - 1))
        assert up == pytest.approx(order * down - t * same, rel=1e-13)

    def test_the_highest_order(self):
        assert np.exp(log_gaussian(20.0, LOW)) == pytest.approx(by_quadrature(20.0, LOW, normal), rel=1e-9)
        # The two formulas meet at LOW: what the function does over a step of 1e-9 there is its slope.
        below, above = log_gaussian(20.0, np.array([LOW - 5e-10, LOW + 5e-10]))
        slope = -20 * math.exp(log_gaussian(19.0, LOW) - log_gaussian(20.0, LOW))
        assert above - below == pytest.approx(slope * 1e-9, abs=1e-9)


class TestExponential:
    @pytest.mark.parametrize("order", ORDERS)
    def test_quadrature(self, order):
        def density(x):
            return math.exp(-x)

        # The range ends at v = 3, x = 81, where exp(-81) is left out.
        assert np.exp(log_exponential(order, 0.7)) == pytest.approx(
            by_quadrature(order, 0.7, density), rel=1e-11
        )

    def test_a_plane_below_all_heights_is_refused(self):
        with pytest.raises(ValueError, match="touches every asperity"):
            log_exponential(1.5, np.array([0.3, -0.1]))


@pytest.mark.parametrize("function", [log_gaussian, log_exponential])
@pytest.mark.parametrize("order", [-1.0, -2.0, 20.5, math.nan])
def test_orders_without_an_integral_or_digits_are_refused(function, order):
    with pytest.raises(ValueError, match=r"must lie above -1|order must be a number, not nan"):
        function(order, 0.0)
