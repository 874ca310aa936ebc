"""Persson's area and pressures: limits, sums, the diffusion they come from, and the waves of a surface."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.theory.persson_theory import persson
from roughcontact.theory.random_surfaces.waves import Waves

MODULUS = 2e11
SURFACE = rc.Moments(1e-12, 5e-3, 1e9)
SLOPE = 0.1  # sqrt(2 m2)
SPREAD = MODULUS * SLOPE / 2
SPECTRUM = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-6).scaled(1e-6)


class TestArea:
    def test_small_pressures(self):
        # erf(x) = 2x/sqrt(pi) (1 - x^2/3): the square of 1e-6 is beyond rounding.
        p = 1e-6 * MODULUS * SLOPE
        assert persson.contact_fraction(p, MODULUS, SURFACE) == pytest.approx(
            math.sqrt(8 / math.pi) * 1e-6, rel=1e-11
        )
        assert pytest.approx(1.5957691, rel=1e-7) == persson.AREA_SLOPE

    def test_large_pressures_close_the_contact(self):
        assert persson.contact_fraction(10 * SPREAD, MODULUS, SURFACE) == 1
        assert persson.contact_fraction(0.0, MODULUS, SURFACE) == 0

    def test_only_pressure_over_modulus_and_slope_counts(self):
        p = np.geomspace(1e6, 1e11, 9)
        steep = rc.Moments(3e-12, 4 * SURFACE.m2, 0.0)
        a = persson.contact_fraction(p, MODULUS, SURFACE)
        assert persson.contact_fraction(6 * p, 3 * MODULUS, steep) == pytest.approx(a, rel=1e-14)

    def test_inverse(self):
        part = np.array([0.0, 1e-6, 0.3, 0.99])
        p = persson.pressure_for(part, MODULUS, SURFACE)
        assert persson.contact_fraction(p, MODULUS, SURFACE) == pytest.approx(part, rel=1e-12)
        with pytest.raises(ValueError, match="from 0 to below 1"):
            persson.pressure_for(1.0, MODULUS, SURFACE)

    def test_every_description_of_a_surface_will_do(self):
        grid = rc.Grid((64, 64), 1e-6, periodic=True)
        heights = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(0))
        waves = Waves.of_heights(heights.heights, grid.spacing)
        p = 1e-3 * MODULUS
        assert persson.contact_fraction(p, MODULUS, waves) == pytest.approx(
            float(persson.contact_fraction(p, MODULUS, rc.surface_moments(heights))), rel=1e-12
        )
        assert persson.contact_fraction(p, MODULUS, SPECTRUM) == pytest.approx(
            float(persson.contact_fraction(p, MODULUS, SPECTRUM.moments())), rel=1e-11
        )

    def test_magnification(self):
        p = 1e-3 * MODULUS
        q, part = persson.magnified_fraction(p, MODULUS, SPECTRUM)
        assert (np.diff(part) <= 0).all()
        assert part[0] == 1
        for node in (300, 400):
            seen = Waves.of_spectrum(SPECTRUM, q_max=q[node])
            assert part[node] == pytest.approx(float(persson.contact_fraction(p, MODULUS, seen)), rel=1e-8)

    @pytest.mark.parametrize(
        ("pressure", "modulus", "surface", "reason"),
        [
            (-1.0, MODULUS, SURFACE, "pressure"),
            (1.0, 0.0, SURFACE, "modulus"),
            (1.0, MODULUS, rc.Moments(0.0, 0.0, 0.0), "contact is full"),
            (1.0, MODULUS, rc.Moments(1e-12, math.inf, math.inf), "shortest wave"),
        ],
    )
    def test_bad_input_is_refused(self, pressure, modulus, surface, reason):
        with pytest.raises(ValueError, match=reason):
            persson.contact_fraction(pressure, modulus, surface)


class TestPressures:
    @pytest.mark.parametrize("p", [0.01 * SPREAD, 0.5 * SPREAD, 3 * SPREAD])
    def test_sums(self, p):
        def density(s):
            return float(persson.pressure_density(s * SPREAD, p, MODULUS, SURFACE)) * SPREAD

        top = p / SPREAD + 9  # what lies beyond is erfc(9/sqrt2) = 2e-19
        area, _ = quad(density, 0, top, epsabs=1e-13, limit=200)
        load, _ = quad(lambda s: s * density(s), 0, top, epsabs=1e-13, limit=200)
        assert area == pytest.approx(float(persson.contact_fraction(p, MODULUS, SURFACE)), rel=1e-9)
        assert load * SPREAD == pytest.approx(p, rel=1e-9)

    def test_fraction_above(self):
        p = 0.7 * SPREAD
        assert persson.fraction_above(0.0, p, MODULUS, SURFACE) == pytest.approx(
            float(persson.contact_fraction(p, MODULUS, SURFACE)), rel=1e-13
        )
        above, _ = quad(
            lambda s: float(persson.pressure_density(s, p, MODULUS, SURFACE)), SPREAD, 12 * SPREAD
        )
        assert persson.fraction_above(SPREAD, p, MODULUS, SURFACE) == pytest.approx(above, rel=1e-8)

    def test_density_diffuses_and_is_absorbed(self):
        # dP/dV = (1/2) d2P/ds2 with P(0) = 0, V the variance in full contact: what Persson's theory says.
        p = 1.3 * SPREAD
        assert persson.pressure_density(0.0, p, MODULUS, SURFACE) == 0

        def density(s, variance):
            moments = rc.Moments(0.0, SURFACE.m2 * variance, 0.0)
            return float(persson.pressure_density(s * SPREAD, p, MODULUS, moments)) * SPREAD

        h = 1e-3
        for s in (0.2, 1.0, 2.5):
            time = (density(s, 1 + h) - density(s, 1 - h)) / (2 * h)
            space = (density(s + h, 1) - 2 * density(s, 1) + density(s - h, 1)) / h**2
            # Both differences err by h^2 times derivatives of order 1; the second by 1e-16/h^2 besides.
            assert time == pytest.approx(space / 2, abs=1e-6)

    def test_spread_is_that_of_the_pressure_in_full_contact(self):
        grid = rc.Grid((48, 64), 1e-6, periodic=True)
        surface = rc.self_affine(grid, hurst=0.7, rms=1e-8, rng=np.random.default_rng(3))
        qy, qx = (2 * np.pi * np.fft.fftfreq(n, 1e-6) for n in grid.shape)
        # u = z in full contact, and u(q) = 2 p(q)/(E* q).
        pressed = np.fft.ifft2(np.fft.fft2(surface.heights) * MODULUS * np.hypot(qy[:, None], qx) / 2).real
        waves = Waves.of_heights(surface.heights, grid.spacing)
        assert persson.pressure_spread(MODULUS, waves) == pytest.approx(np.std(pressed), rel=1e-12)


class TestLaw:
    def test_is_the_theory_over_the_nominal_area(self):
        area, force = 2e-6, np.geomspace(1e-2, 1e4, 7)
        law = persson.law(SPECTRUM, MODULUS, area)
        assert set(law.quantities) == {"contact_area", "mean_gap", "interfacial_stiffness", "elastic_energy"}
        part = persson.contact_fraction(force / area, MODULUS, SPECTRUM)
        assert law.predict("contact_area", force) == pytest.approx(area * part, rel=1e-14)

    def test_energy_gap_and_stiffness_belong_together(self):
        law = persson.law(SPECTRUM, MODULUS, 2e-6)
        force, h = np.geomspace(1e-2, 1e3, 6), 1e-4
        gap, energy = (
            law.predict(name, force * math.exp(h)) - law.predict(name, force * math.exp(-h))
            for name in ("mean_gap", "elastic_energy")
        )
        # Central differences err by h^2, and by rounding over h.
        assert -force * gap == pytest.approx(energy, rel=1e-7)
        assert -2 * np.sinh(h) * force / gap == pytest.approx(
            law.predict("interfacial_stiffness", force), rel=1e-7
        )

    def test_bad_numbers_show_themselves_at_once(self):
        for area, modulus, gamma in ((0.0, MODULUS, 0.45), (1.0, -1.0, 0.45), (1.0, MODULUS, 2.0)):
            with pytest.raises(ValueError, match=r"area|modulus|gamma"):
                persson.law(SPECTRUM, modulus, area, gamma=gamma)
