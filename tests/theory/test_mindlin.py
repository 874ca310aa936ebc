"""Tangential stiffness and gross slip: limits, pairs of solids, and the normal loading curve behind them."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.theory.joints import mindlin
from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.stiffness_laws import pohrt_popov


class TestRatio:
    @pytest.mark.parametrize(("poisson", "value"), [(0.0, 1.0), (0.3, 1.7 / 1.4), (0.5, 1.5)])
    def test_one_material(self, poisson, value):
        assert mindlin.ratio(poisson) == pytest.approx(value, rel=1e-15)
        solid = rc.Solid(70e9, poisson)
        assert mindlin.pair_ratio(solid) == pytest.approx(value, rel=1e-14)
        assert mindlin.pair_ratio(solid, rc.Solid(210e9, poisson)) == pytest.approx(value, rel=1e-14)

    def test_is_the_ratio_of_the_reduced_moduli(self):
        first, second = rc.Solid(210e9, 0.3), rc.Solid(3e9, 0.45)
        expected = rc.reduced_modulus(first, second) / rc.reduced_shear_modulus(first, second)
        assert mindlin.pair_ratio(first, second) == pytest.approx(expected, rel=1e-13)

    def test_a_rigid_partner_counts_for_nothing(self):
        soft = rc.Solid(1e6, 0.4)
        assert mindlin.pair_ratio(soft, rc.Solid(math.inf, 0.1)) == pytest.approx(
            mindlin.ratio(0.4), rel=1e-14
        )

    def test_bad_input_is_refused(self):
        with pytest.raises(ValueError, match="Poisson"):
            mindlin.ratio(0.6)
        with pytest.raises(ValueError, match="rigid"):
            mindlin.pair_ratio(rc.Solid(math.inf, 0.3))


class TestStiffness:
    def test_disc(self):
        # k_t = 2 G* a
        solid, a = rc.Solid(70e9, 0.33), 1e-4
        k = 2 * rc.reduced_modulus(solid) * a
        value = mindlin.tangential_stiffness(k, mindlin.pair_ratio(solid))
        assert value == pytest.approx(2 * rc.reduced_shear_modulus(solid) * a, rel=1e-13)

    def test_law(self):
        law = mindlin.law(LoadingLaw("power", "test", {"stiffness": lambda f: 3 * f**0.6}, (0.0, 8.0)), 1.25)
        assert law.predict("tangential_stiffness", 4.0) == pytest.approx(3 * 4**0.6 / 1.25, rel=1e-14)
        assert law.domain == (0.0, 8.0)
        with pytest.raises(ValueError, match="has no 'stiffness'"):
            mindlin.law(LoadingLaw("other", "test", {"depth": lambda f: f}), 1.25)
        with pytest.raises(ValueError, match="negative"):
            mindlin.tangential_stiffness(-1.0, 1.2)


class TestGrossSlip:
    def test_of_any_depth(self):
        assert mindlin.gross_slip(2e-6, 0.3, 1.2) == pytest.approx(0.3 * 1.2 * 2e-6, rel=1e-15)

    @pytest.mark.parametrize("hurst", [0.3, 0.7, 1.0, 2.0])
    @pytest.mark.parametrize("prefactor", [None, 1.3])
    def test_fractal_is_mu_ratio_times_the_depth_of_its_power_law(self, hurst, prefactor):
        modulus, force, rms, length = 1e11, 30.0, 2e-6, 3e-3
        zeta = 1.7 / (hurst + 1) if prefactor is None else prefactor
        theta = float(pohrt_popov.theta(hurst, rms, length))

        def compliance(f):  # 1/k, eq. 7.2
            return (f / (modulus * theta)) ** (-1 / (hurst + 1)) / (zeta * modulus)

        # f = F t^n makes the integrand of f^(-1/(H+1)) smooth.
        n = (hurst + 1) / hurst
        depth = quad(lambda t: compliance(force * t**n) * force * n * t ** (n - 1), 0, 1, epsrel=1e-12)[0]
        constant = mindlin.slip_constant(theta, hurst, prefactor)
        value = mindlin.fractal_gross_slip(force, modulus, hurst, constant, friction=0.4, ratio=1.2)
        assert value == pytest.approx(0.4 * 1.2 * depth, rel=1e-9)

    def test_fractal_is_that_of_the_loading_law(self):
        surface = (0.7, 2e-6, 3e-3, 1e11)
        depth = pohrt_popov.law(*surface).predict("depth", 3.0)
        constant = mindlin.slip_constant(float(pohrt_popov.theta(*surface[:3])), 0.7)
        value = mindlin.fractal_gross_slip(3.0, 1e11, 0.7, constant, friction=0.4, ratio=1.2)
        assert value == pytest.approx(float(mindlin.gross_slip(depth, 0.4, 1.2)), rel=1e-12)

    def test_bad_input_is_refused(self):
        with pytest.raises(ValueError, match="above 0 and at most 2"):
            mindlin.slip_constant(1.0, 0.0)
        with pytest.raises(ValueError, match="omit prefactor"):
            mindlin.slip_constant(1.0, 0.5, 1.0, constants="printed")
        with pytest.raises(ValueError, match="constants"):
            mindlin.slip_constant(1.0, 0.5, constants="new")
        with pytest.raises(ValueError, match="friction"):
            mindlin.gross_slip(np.array([1.0]), 0.0, 1.2)
