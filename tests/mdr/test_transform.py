"""The transform and its inverse, against closed forms and against brute quadrature of the definition."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import gamma, struve

from roughcontact.mdr.bodies import indenter
from roughcontact.mdr.bodies.chebyshev import Panels, fit, interpolate
from roughcontact.mdr.bodies.transform import abel, height_of, transform_of


def kappa(n):
    return np.sqrt(np.pi) * gamma(n / 2 + 1) / gamma((n + 1) / 2)


@pytest.mark.parametrize("n", [0.5, 0.7, 1, 1.5, 2, 2.5, 3, 4, 5, 6])
class TestPowerLaw:
    # Eight decades of the radius; below, the panels of r^0.5 end.
    x = np.geomspace(2e-8, 2, 300)

    def test_the_transform_of_a_function_is_the_closed_form(self, n):
        f = fit(lambda r: r**n, 2.0, tolerance=1e-14)
        g = transform_of(f)
        np.testing.assert_allclose(g(self.x), kappa(n) * self.x**n, rtol=1e-12)
        # A derivative of a polynomial of degree 19 costs up to its square in rounding, an integral nothing.
        np.testing.assert_allclose(g.derivative()(self.x), n * kappa(n) * self.x ** (n - 1), rtol=2e-11)
        np.testing.assert_allclose(g.primitive()(self.x), kappa(n) * self.x ** (n + 1) / (n + 1), rtol=1e-11)

    def test_there_and_back(self, n):
        f = fit(lambda r: r**n, 2.0, tolerance=1e-14)
        np.testing.assert_allclose(height_of(transform_of(f))(self.x), self.x**n, rtol=1e-11)


def test_the_integral_is_the_definition():
    """Against adaptive quadrature of f'(x sin t) of a body with no closed form."""
    f = fit(lambda r: r**2 * np.exp(-r) + np.expm1(r**1.5), 1.5, tolerance=1e-14)
    x = np.array([1e-3, 0.1, 0.4, 1.0, 1.499])

    def slope(r):
        return (2 * r - r**2) * np.exp(-r) + 1.5 * np.sqrt(r) * np.exp(r**1.5)

    truth = [
        a * quad(lambda t, a=a: slope(a * np.sin(t)), 0, np.pi / 2, epsabs=0, epsrel=1e-13)[0] for a in x
    ]
    np.testing.assert_allclose(transform_of(f)(x), truth, rtol=1e-12)


def test_ripples_of_a_function_have_the_struve_function():
    k, f = 20.0, fit(lambda r: r**2 / 2 + 0.01 * (1 - np.cos(20 * r)), 2.0, tolerance=1e-14)
    x = np.linspace(0.01, 2, 500)
    truth = x**2 + np.pi / 2 * 0.01 * k * x * struve(0, k * x)
    np.testing.assert_allclose(transform_of(f)(x), truth, rtol=1e-11)


def test_kinks_are_found():
    b = 0.3
    f = fit(lambda r: np.maximum(r - b, 0), 2.0, tolerance=1e-14)
    g = transform_of(f)
    x = np.linspace(b * (1 + 1e-6), 2, 500)
    np.testing.assert_allclose(g(x), x * np.arccos(b / x), atol=1e-11)
    assert (g(np.linspace(0, b, 20)[:-1]) == 0).all()
    np.testing.assert_allclose(height_of(g)(x), x - b, atol=1e-11)


def test_at_zero_the_integral_is_half_pi_of_the_value():
    assert abel(fit(lambda r: 3 + r, 1.0, tolerance=1e-14), np.zeros(1))[0] == pytest.approx(1.5 * np.pi)


class TestSamples:
    @staticmethod
    def error(count, body):
        r = np.linspace(0, 1, count + 1)
        sampled = indenter.sampled(r, body.height(r))
        x = np.linspace(1e-3, 1, 997)
        return np.array(
            [
                np.abs(sampled.transform(x) - body.transform(x)).max(),
                np.abs(sampled.transform_slope(x) - body.transform_slope(x)).max(),
            ]
        )

    def test_errors_fall_with_the_stated_orders(self):
        body = indenter.paraboloid(1.0) + indenter.ripples(0.03, 1.2, 1.0)
        coarse, fine = self.error(80, body), self.error(320, body)
        order = np.log2(coarse / fine) / 2
        # D^3.5 and D^2.5; the measured ones scatter by the place of the worst knot.
        assert order[0] > 3.2
        assert order[1] > 2.2
        assert fine[0] < 1e-8

    def test_a_cone_is_met_exactly(self):
        r = np.linspace(0, 1, 21)
        body = indenter.sampled(r, 0.3 * r, sharp=True)
        x = np.linspace(0, 1, 50)
        np.testing.assert_allclose(body.transform(x), np.pi / 2 * 0.3 * x, atol=1e-14)

    def test_uneven_samples(self):
        r = np.concatenate([[0.0], np.geomspace(1e-3, 1, 120)])
        body = indenter.sampled(r, r**2 / 2)
        np.testing.assert_allclose(body.transform(r), r**2, rtol=1e-11, atol=1e-16)

    def test_a_sampled_transform_goes_back_to_the_body(self):
        x = np.linspace(0, 1, 201)
        truth = indenter.sphere(2.0)
        body = indenter.sampled_transform(x, truth.transform(x))
        # Spline error D^4 of a function of size 1: 6e-10 times its fourth derivative / 384.
        np.testing.assert_allclose(body.height(x), truth.height(x), atol=1e-10)

    @pytest.mark.parametrize(
        ("r", "f", "message"),
        [
            ([0, 1, 2], [0, 1, 2], "at least four"),
            ([0, 1, 2, 3], [0, 1, 2], "at least four"),
            ([0.1, 1, 2, 3], [0, 1, 2, 3], "from 0 on"),
            ([0, 1, 1, 3], [0, 1, 2, 3], "increase strictly"),
            ([0, 1, 2, 3], [0, np.nan, 2, 3], "finite"),
        ],
    )
    def test_bad_samples_are_refused(self, r, f, message):
        with pytest.raises(ValueError, match=message):
            indenter.sampled(np.array(r, dtype=float), np.array(f, dtype=float))


class TestPanels:
    def test_they_are_their_own_derivative_and_integral(self):
        edges = np.array([0.0, 0.5, 2.0, 3.0])
        table = interpolate(lambda x: np.sin(3 * x), edges, 24)
        x = np.linspace(0, 3, 50)
        np.testing.assert_allclose(table(x), np.sin(3 * x), atol=1e-13)
        np.testing.assert_allclose(table.derivative()(x), 3 * np.cos(3 * x), atol=1e-10)
        np.testing.assert_allclose(table.primitive()(x), (1 - np.cos(3 * x)) / 3, atol=1e-13)

    def test_two_polynomials_keep_their_own_sides(self):
        table = Panels(np.array([0.0, 1.0, 2.0]), np.array([[1.0, 0.0], [5.0, 1.0]]))
        assert table(np.array([0.5, 1.0, 1.5])).tolist() == [1.0, 4.0, 5.0]

    def test_noise_is_refused(self):
        noise = np.random.default_rng(1)
        with pytest.raises(ValueError, match="give samples"):
            fit(lambda r: r**2 + 1e-3 * noise.standard_normal(r.shape), 1.0, tolerance=1e-14)

    def test_a_pole_is_refused(self):
        with np.errstate(divide="ignore"), pytest.raises(ValueError, match="not finite"):
            fit(lambda r: 1 / (1 - r), 1.0, tolerance=1e-14)

    def test_a_function_of_one_number_is_refused(self):
        with pytest.raises(ValueError, match="function of an array"):
            fit(lambda r: np.array([1.0]), 1.0, tolerance=1e-14)
