"""Summits of Gaussian surfaces: sums over the joint densities, one density from the other, counted summits."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.theory.random_surfaces import nayak

NODES, WEIGHTS = np.polynomial.legendre.leggauss(160)
ALPHAS = [1.6, 2.0, 10.0, 100.0, 1e4]


def moments(alpha, m0=4e-12, m2=0.01):
    return rc.Moments(m0, m2, alpha * m2**2 / m0)


def panel(low, high):
    return (low + high) / 2 + (high - low) / 2 * NODES, (high - low) / 2 * WEIGHTS


def over_curvature(function, height, alpha):
    """Integrate D(s, g) times a function of g, split where its error function turns."""
    turn = max(height, 0.0) * math.sqrt(alpha) / (3 * (alpha - 1))
    total = 0.0
    for low, high in [(0.0, turn), (turn, turn + 12.0)]:
        g, weight = panel(low, high)
        total += weight @ (nayak.geometric_density(height, g, alpha) * function(g))
    return total


class TestGeometricDensity:
    @pytest.mark.parametrize("alpha", ALPHAS)
    def test_number_and_heights_of_summits(self, alpha):
        # Heights within 9 of their mean: exp(-40) is left out.
        s, weight = panel(-8.0, 10.0)
        density = np.array([over_curvature(lambda g: 1.0, height, alpha) for height in s])
        number, mean = weight @ density, weight @ (density * s)
        square = weight @ (density * s**2)
        assert number == pytest.approx(1 / (3 * math.sqrt(3)), rel=1e-12)
        statistics = nayak.summits(moments(alpha))
        assert mean / number == pytest.approx(statistics.mean_height / 2e-6, rel=1e-11)
        # Of order 1, from the difference of two squares up to seven times that.
        assert square / number - (mean / number) ** 2 == pytest.approx(
            (statistics.std / 2e-6) ** 2, rel=1e-11
        )

    @pytest.mark.parametrize("alpha", [1.6, 10.0])
    def test_mean_curvature(self, alpha):
        s, weight = panel(-8.0, 10.0)
        first = weight @ np.array([over_curvature(lambda g: g, height, alpha) for height in s])
        assert first * 3 * math.sqrt(3) == pytest.approx(1.35621, abs=5e-6)

    @pytest.mark.parametrize("alpha", [1.55, 3.0, 1e4])
    @pytest.mark.parametrize(("height", "curvature"), [(0.3, 0.5), (2.0, 1.2), (-0.4, 2.5)])
    def test_is_the_joint_density_at_fixed_product_of_curvatures(self, alpha, height, curvature):
        # t^2 = g^2 + r^2, and dt = (g/t) dg.
        def strip(r):
            t = math.hypot(curvature, r)
            return float(nayak.summit_density(height, t, r, alpha)) * curvature / t

        expected, _ = quad(strip, 0, 7, epsabs=0, epsrel=1e-11, limit=200)
        assert nayak.geometric_density(height, curvature, alpha) == pytest.approx(expected, rel=1e-9)

    @pytest.mark.parametrize("alpha", [1.5 + 1e-6, 1e4])
    def test_extremes_stay_numbers(self, alpha):
        s, g = np.meshgrid(np.linspace(-40, 40, 81), np.geomspace(1e-8, 1e3, 81))
        density = nayak.geometric_density(s, g, alpha)
        assert np.isfinite(density).all()
        assert (density >= 0).all()

    def test_no_summit_without_two_positive_curvatures(self):
        assert nayak.geometric_density(1.0, 0.0, 2.0) == 0
        assert (nayak.summit_density(1.0, np.array([0.5, 1.0]), np.array([0.6, 1.0]), 2.0) == 0).all()


class TestStatistics:
    def test_constants(self):
        found = nayak.summits(moments(4.0))
        m4 = 4.0 * 1e-4 / 4e-12
        assert found.density == pytest.approx(m4 / (6 * math.sqrt(3) * math.pi * 0.01))
        assert found.radius == pytest.approx(0.375 * math.sqrt(math.pi / m4))
        # Nayak's 0.8968.
        assert found.std == pytest.approx(2e-6 * math.sqrt(1 - 0.8968 / 4), rel=2e-6)

    def test_scales(self):
        base = moments(3.0)
        one, other = (
            nayak.summits(base),
            nayak.summits(rc.Moments(9 * base.m0, 9 / 4 * base.m2, 9 / 16 * base.m4)),
        )
        # Heights times 3, lengths times 2.
        assert other.density == pytest.approx(one.density / 4)
        assert other.radius == pytest.approx(one.radius * 4 / 3)
        assert (other.std, other.mean_height) == pytest.approx((3 * one.std, 3 * one.mean_height))

    def test_summits_counted_on_a_gaussian_surface(self):
        grid = rc.Grid((1024, 1024), 1.0, periodic=True)
        surface = rc.self_affine(
            grid,
            hurst=0.8,
            rms=1.0,
            rng=np.random.default_rng(5),
            long_cutoff=64.0,
            short_cutoff=16.0,
        )
        counted, expected = rc.find_summits(surface), nayak.summits(rc.surface_moments(surface))
        assert counted.count > 1000
        # Three standard errors of as many independent summits; neighbours keep their distance, which makes it less.
        scatter = 3 / math.sqrt(counted.count)
        assert counted.density == pytest.approx(expected.density, rel=scatter)
        assert counted.height.mean() == pytest.approx(expected.mean_height, abs=scatter * expected.std)
        assert counted.height.std() == pytest.approx(expected.std, rel=scatter)
        # Differences over a cell take (q D)^2/12 of a curvature, 1.3 % for waves of 16 cells.
        assert counted.mean_curvature.mean() == pytest.approx(1 / expected.radius, rel=scatter + 0.013)


class TestDomain:
    def test_moments_of_no_isotropic_surface_are_refused(self):
        with pytest.raises(ValueError, match=r"at least 3/2, not 1\.2"):
            nayak.summits(moments(1.2))

    @pytest.mark.parametrize("bad", [rc.Moments(1.0, 1.0, math.inf), rc.Moments(1.0, 0.0, 1.0)])
    def test_infinite_and_zero_moments_are_refused(self, bad):
        with pytest.raises(ValueError, match="positive and finite"):
            nayak.bandwidth(bad)

    def test_waves_of_one_length_have_parameters_but_no_joint_density(self):
        assert nayak.summits(moments(1.5)).density > 0
        with pytest.raises(ValueError, match="one length"):
            nayak.geometric_density(1.0, 1.0, 1.5)
