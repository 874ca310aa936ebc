"""Bush, Gibson and Thomas: other routes through the same integrals, limits, derivatives, inverses, refusals."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipe, ellipkm1, erfc

import roughcontact as rc
from roughcontact.theory.asperity_models import bush_gibson_thomas as bgt, greenwood_williamson as gw
from roughcontact.theory.random_surfaces import nayak

MODULUS, RMS, M2, AREA = 2e11, 1e-6, 0.01, 1e-6
NODES, WEIGHTS = np.polynomial.legendre.leggauss(80)
# alpha, s0, p and A of spheres, p and A of ellipsoids; pressures in E* sqrt(m2), by an independent quadrature.
TABLE = [
    (2, 0, 0.12512, 0.16737, 0.12805, 0.16444),
    (2, 2, 5.9357e-3, 1.00423e-2, 6.0163e-3, 9.9396e-3),
    (2, 3, 3.6462e-4, 6.3408e-4, 3.6777e-4, 6.3007e-4),
    (10, 0, 0.20241, 0.20786, 0.20763, 0.20400),
    (10, 2, 6.1822e-3, 8.4032e-3, 6.3177e-3, 8.2692e-3),
    (10, 3, 3.4912e-4, 5.1937e-4, 3.5590e-4, 5.1200e-4),
    (100, 0, 0.67887, 0.43381, 0.69775, 0.42530),
    (100, 2, 1.36308e-2, 1.18231e-2, 1.39936e-2, 1.16004e-2),
    (100, 3, 6.2930e-4, 6.1243e-4, 6.4558e-4, 6.0119e-4),
]


def summits(alpha, elliptic=True):
    return bgt.Summits(rc.Moments(RMS**2, M2, alpha * M2**2 / RMS**2), MODULUS, elliptic)


def scaled(summits, plane):
    """Pressure in E* sqrt(m2) and contact fraction at a height of the flat in sqrt(m0)."""
    return summits.pressure(plane * RMS) / (MODULUS * math.sqrt(M2)), summits.contact_fraction(plane * RMS)


def panel(low, high):
    return (low + high) / 2 + (high - low) / 2 * NODES, (high - low) / 2 * WEIGHTS


@pytest.mark.parametrize("row", TABLE)
def test_table(row):
    alpha, plane, *numbers = row
    found = [*scaled(summits(alpha, False), plane), *scaled(summits(alpha), plane)]
    # Half a unit of the last of the five or six digits given.
    assert found == pytest.approx(numbers, rel=5e-5)


@pytest.mark.parametrize("alpha", [1.6, 10.0, 1e3])
@pytest.mark.parametrize("plane", [0.0, 1.0, 3.0])
def test_spheres_by_the_density_of_geometric_curvature(alpha, plane):
    # Greenwood's own two integrals; s = s0 + v^2 takes the power 3/2 away.
    v, weight = panel(0.0, 3.2)
    load = area = number = 0.0
    for shift, w in zip(v**2, weight * 2 * v, strict=True):
        turn = (plane + shift) * math.sqrt(alpha) / (3 * (alpha - 1))
        for low, high in [(0.0, turn), (turn, turn + 9.0)]:
            root, wg = panel(math.sqrt(low), math.sqrt(high))  # g = root^2
            density = w * wg * 2 * root * nayak.geometric_density(plane + shift, root**2, alpha)
            load += (density * 4 / 3 * shift**1.5 / root).sum()
            area += (density * math.pi * shift / root**2).sum()
            number += density.sum()
    found = summits(alpha, elliptic=False)
    pressure, fraction = scaled(found, plane)
    assert pressure == pytest.approx(alpha**0.75 / (2 * math.pi) * load, rel=1e-10)
    assert fraction == pytest.approx(math.sqrt(alpha) / (2 * math.pi) * area, rel=1e-10)
    per_area = found.moments.m4 / (2 * math.pi * M2)
    assert found.spot_density(plane * RMS) == pytest.approx(per_area * number, rel=1e-10)


class TestEllipsoids:
    def factors(self, ratio):
        """f_F and f_A of a summit with r/t = ratio, from complete elliptic integrals of the axes' ratio."""
        low, high = 1e-6, 1.0
        for _ in range(60):
            b = math.sqrt(low * high)
            m, n = self.shape(b)[:2]
            low, high = (b, high) if m / n < (1 - ratio) / (1 + ratio) else (low, b)
        m, n, k = self.shape(b)
        g = 2 * math.sqrt(m * n)
        return 2 * math.pi / 3 / (4 / 3 * k**1.5 / math.sqrt(g)), b * g / k

    def shape(self, b):
        m = 1 - b**2
        k, e = ellipkm1(b**2), ellipe(m)
        return (k - e) / m, e / (m * (1 - m)) - k / m, k

    @pytest.mark.parametrize(
        ("ratio", "force", "area"),
        [(0.2, 1.00342, 0.99773), (0.5, 1.02505, 0.98416), (0.8, 1.09937, 0.94524), (0.95, 1.27443, 0.88265)],
    )
    def test_factors(self, ratio, force, area):
        assert self.factors(ratio) == pytest.approx((force, area), abs=6e-6)

    @pytest.mark.parametrize(("alpha", "plane"), [(2.0, 1.0), (50.0, 2.0)])
    def test_all_three_integrals(self, alpha, plane):
        # Over u = (1 - r/t)^(1/4), in which the root and the logarithm at r = t hardly show; then t, then v with
        # s = s0 + v^2.
        v, wv = panel(0.0, 3.2)
        t, wt = panel(0.0, 9.0)
        u, wu = panel(0.0, 1.0)
        load = area = 0.0
        for x, w in zip(u, wu, strict=True):
            rho = 1 - x**4
            force_factor, area_factor = self.factors(rho)
            g = t * math.sqrt(1 - rho**2)
            density = nayak.summit_density(plane + v[:, None] ** 2, t, rho * t, alpha) * t * 4 * x**3 * w
            density = density * wt * (wv * 2 * v)[:, None]
            load += (density * 4 / 3 * v[:, None] ** 3 / np.sqrt(g)).sum() * force_factor
            area += (density * math.pi * v[:, None] ** 2 / g).sum() * area_factor
        pressure, fraction = scaled(summits(alpha), plane)
        assert pressure == pytest.approx(alpha**0.75 / (2 * math.pi) * load, rel=1e-6)
        assert fraction == pytest.approx(math.sqrt(alpha) / (2 * math.pi) * area, rel=1e-6)

    def test_are_stiffer_and_touch_less(self):
        plane = np.linspace(0, 4, 9) * RMS
        for alpha in (1.6, 10.0, 1e3):
            more, less = summits(alpha), summits(alpha, elliptic=False)
            assert (more.pressure(plane) > less.pressure(plane)).all()
            assert (more.pressure(plane) < 1.04 * less.pressure(plane)).all()
            assert (more.contact_fraction(plane) < less.contact_fraction(plane)).all()


class TestLimits:
    def test_high_separation(self):
        found, plane = summits(2.0), np.array([10.0, 20.0])
        pressure, fraction = scaled(found, plane)
        # Corrections fall with the square of the height: a hundredth and less here.
        tail = erfc(plane / math.sqrt(2)) / 4
        assert pressure == pytest.approx(tail / math.sqrt(math.pi), rel=0.005)
        assert fraction == pytest.approx(tail, rel=0.005)
        short = np.abs(pressure / tail * math.sqrt(math.pi) - 1)
        assert short[1] == pytest.approx(short[0] / 4, rel=0.1)
        moments = found.moments
        assert bgt.asymptotic_pressure(plane * RMS, moments, MODULUS) == pytest.approx(
            MODULUS * math.sqrt(M2 / math.pi) * tail
        )
        load = found.pressure(plane * RMS)
        assert bgt.asymptotic_fraction(load, moments, MODULUS) == pytest.approx(fraction, rel=0.005)

    def test_below_the_mean_plane_there_is_no_limit(self):
        with pytest.raises(ValueError, match="separation must not be negative"):
            bgt.asymptotic_pressure(-1.0, summits(2.0).moments, MODULUS)
        assert bgt.asymptotic_pressure(np.inf, summits(2.0).moments, MODULUS) == 0

    @pytest.mark.parametrize("plane", [0.0, 1.0])
    def test_one_wavelength(self, plane):
        # At alpha = 3/2 the height of a summit is sqrt(3/2) times its mean curvature t.
        def share(t):
            r, weight = panel(0.0, t)
            g = np.sqrt(t**2 - r**2)
            density = (g**2 * 3 * r * np.exp(-1.5 * r**2) / np.sqrt(g)) @ weight
            return (
                density
                * math.exp(-0.75 * t**2)
                / math.sqrt(4 * math.pi / 3)
                * (math.sqrt(1.5) * t - plane) ** 1.5
            )

        load, _ = quad(share, plane / math.sqrt(1.5), 9, epsabs=0, epsrel=1e-9)
        expected = 1.5**0.75 / (2 * math.pi) * 4 / 3 * load
        # The density is spread by sqrt(1 - 1.5/alpha), which counts in the square: 1e-7 over 1.5.
        pressure, _ = scaled(summits(1.5 + 1e-7, elliptic=False), plane)
        assert pressure == pytest.approx(expected, rel=1e-6)

    def test_many_wavelengths_are_greenwood_and_williamson_s_heights(self):
        # At large alpha curvature says nothing of height: s0 enters as in a Gaussian population.
        found, plane = summits(1e8, elliptic=False), np.array([0.5, 2.0, 3.5]) * RMS
        sphere = gw.Population(gw.Asperity.hertz(1.0, 1.0), 1.0, RMS)
        ratio = found.pressure(plane) / sphere.pressure(plane)
        # What is left of it is of the order 1/sqrt(alpha).
        assert ratio == pytest.approx(ratio.mean(), rel=1e-3)


class TestDerivatives:
    @pytest.mark.parametrize("alpha", [1.501, 3.0, 1e4])
    def test_energy_pressure_stiffness(self, alpha):
        # Central differences err by the square of the step, 1e-8, times s0^2/6 or so.
        found, s, step = summits(alpha), np.array([0.5, 2.0, 4.0]) * RMS, 1e-4 * RMS
        for above, below in [("energy", "pressure"), ("pressure", "stiffness")]:
            function = getattr(found, above)
            slope = (function(s - step) - function(s + step)) / (2 * step)
            assert slope == pytest.approx(getattr(found, below)(s), rel=6e-8)


class TestInverse:
    @pytest.mark.parametrize("alpha", [1.5001, 2.0, 1e4])
    @pytest.mark.parametrize("count", [3, 200])
    def test_over_two_hundred_decades(self, alpha, count):
        found = summits(alpha)
        p = np.geomspace(1e-190, float(found.pressure(0.0)), count)
        separation = found.separation(p)
        assert (np.diff(separation) < 0).all()
        # Rounding of exponents of size s0^2/2 = 500 or so.
        assert found.pressure(separation) == pytest.approx(p, rel=1e-12)

    def test_many_equal_pressures(self):
        separation = summits(2.0).separation(np.full(50, 1e6))
        assert separation == pytest.approx(np.full(50, summits(2.0).separation(1e6)), rel=1e-13)

    def test_no_load_and_too_much(self):
        found = summits(2.0)
        assert found.separation(np.array([0.0, 1e6]))[0] == math.inf
        assert found.pressure(math.inf) == 0
        with pytest.raises(ValueError, match="reaches the mean plane"):
            found.separation(1.01 * found.pressure(0.0))
        with pytest.raises(ValueError, match="pass the mean plane"):
            found.pressure(-1e-9)


class TestLaw:
    @pytest.mark.parametrize("elliptic", [True, False])
    def test_quantities(self, elliptic):
        found = summits(10.0, elliptic)
        law = bgt.law(found.moments, MODULUS, AREA, elliptic=elliptic)
        separation = np.array([0.0, 1.0, 3.0]) * RMS
        force = AREA * found.pressure(separation)
        assert law.predict("mean_gap", force) == pytest.approx(separation, abs=1e-12 * RMS)
        assert law.predict("contact_area", force) == pytest.approx(
            AREA * found.contact_fraction(separation), rel=1e-11
        )
        assert np.isnan(law.predict("spots", 1.01 * law.domain[1]))
        assert "stiffness" not in law.quantities


class TestRefusals:
    def test_one_wavelength(self):
        with pytest.raises(ValueError, match="one length"):
            summits(1.5)

    def test_no_isotropic_surface(self):
        with pytest.raises(ValueError, match="at least 3/2"):
            summits(1.4)

    def test_no_modulus(self):
        with pytest.raises(ValueError, match="modulus"):
            bgt.Summits(rc.Moments(1.0, 1.0, 2.0), 0.0)
