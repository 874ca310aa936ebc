"""Flat punches against reference numbers, limits, and the pressures' own integrals."""

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.theory.spheres_and_punches import punch


class TestClosedForms:
    def test_disc(self):
        assert punch.disc(3.0, np.array([0.5, 2.0])).tolist() == [3.0, 12.0]

    def test_disc_pressure_carries_the_force(self):
        # With r = a sin t the edge's root goes.
        total = quad(
            lambda t: 2 * np.pi * np.sin(t) * np.cos(t) * 4 * punch.disc_pressure(7.0, 2.0, 2 * np.sin(t)),
            0,
            np.pi / 2,
        )[0]
        assert total == pytest.approx(7.0, rel=1e-9)
        assert punch.disc_pressure(7.0, 2.0, np.array([2.0, 2.1])).tolist() == [np.inf, 0.0]
        assert punch.disc_pressure(0.0, 2.0, 2.0) == 0

    def test_disc_displacement(self):
        u = punch.disc_displacement(0.1, 2.0, np.array([0.0, 2.0, 4.0, 2e6]))
        # Far away a point load: F/(pi E* r) with F = 2 E* a d.
        np.testing.assert_allclose(u, [0.1, 0.1, 0.1 / 3, 0.2 / np.pi * 1e-6], rtol=1e-12)

    @pytest.mark.parametrize(
        ("ratio", "k"), [(0.5, 1.456791031047), (0.25, 1.121514290144), (0.1, 0.850081418986)]
    )
    def test_ellipse(self, ratio, k):
        assert punch.ellipse(1.0, (1.0, ratio)) == pytest.approx(k, rel=1e-12)
        assert punch.ellipse(1.0, (ratio, 1.0)) == pytest.approx(k, rel=1e-12)

    def test_ellipse_limits(self):
        assert punch.ellipse(5.0, (2.0, 2.0)) == pytest.approx(punch.disc(5.0, 2.0), rel=1e-15)
        # K(e) = ln(4a/b) + O((b/a)^2 ln).
        assert punch.ellipse(1.0, (1.0, 1e-9)) == pytest.approx(np.pi / np.log(4e9), rel=1e-14)

    def test_ellipse_pressure(self):
        p = punch.ellipse_pressure(
            7.0, (2.0, 3.0), np.array([0.0, 1.2, 2.0, 2.1]), np.array([0.0, 0.0, 0.0, 0.0])
        )
        np.testing.assert_allclose(p, [7 / (12 * np.pi), 7 / (12 * np.pi * 0.8), np.inf, 0.0], rtol=1e-14)
        assert punch.ellipse_pressure(7.0, (2.0, 2.0), 0.6, 1.0) == pytest.approx(
            punch.disc_pressure(7.0, 2.0, np.hypot(0.6, 1.0)), rel=1e-14
        )

    def test_strip(self):
        # Thesis, eq. A.37 with p = F'/(pi sqrt(a^2 - x^2)): u = (2F'/pi E*) ln(2L/a) at the middle.
        u = quad(
            lambda t: -2 / np.pi * 0.1 * punch.strip_pressure(1.0, 0.1, 0.1 * np.sin(t)) * np.cos(t)
            * np.log(abs(0.1 * np.sin(t)) / 3.0),
            *(-np.pi / 2, np.pi / 2),
            points=[0.0],
        )[0]  # fmt: skip
        assert 1 / punch.strip(1.0, 0.1, 3.0) == pytest.approx(u, rel=1e-8)
        assert punch.strip_pressure(1.0, 0.1, np.array([0.1, 0.2])).tolist() == [np.inf, 0.0]
        with pytest.raises(ValueError, match="a quarter of the strip's width"):
            punch.strip(1.0, 1.0, 0.5)


class TestPolygons:
    def test_square_by_cells(self):
        """Uniform cells approach from below; two Richardson levels (c/n, then c/n^2) leave 1e-4 (corners)."""
        k = [rc.contact_stiffness(np.ones((n, n), bool), rc.Grid((n, n), 1 / n), 1.0) for n in (16, 32, 64)]
        first = [2 * k[1] - k[0], 2 * k[2] - k[1]]
        assert punch.square(1.0, 1.0) == pytest.approx((4 * first[1] - first[0]) / 3, rel=1e-4)
        assert k[-1] < punch.square(1.0, 1.0)

    def test_known_square_cells_fit_the_number(self):
        """N = 16, 64, 256 of known six digits, errors 1/N, 1/N^1.593 and the number itself: solved for it."""
        n = np.array([16.0, 64.0, 256.0])
        known = np.array([1.128631, 1.146173, 1.150744])
        value = np.linalg.solve(np.stack([np.ones(3), 1 / n, n**-1.593], axis=1), known)[0]
        # Half a unit of the sixth digit, amplified by the weights 0.03, 0.5 and 1.5, and 1/N^2 of them.
        assert value == pytest.approx(punch.SQUARE.value, abs=2e-6)

    def test_shape_factors(self):
        square = punch.shape_factor(punch.square(2.0, 3.0), 2.0, 9.0)
        assert square == pytest.approx(1.021198, abs=1e-6)
        triangle = punch.shape_factor(punch.triangle(2.0, 3.0), 2.0, np.sqrt(3) / 4 * 9)
        assert triangle == pytest.approx(1.0614, abs=1e-4)
        assert punch.shape_factor(punch.disc(2.0, 3.0), 2.0, np.pi * 9) == pytest.approx(1, rel=1e-15)
        # Of all shapes of one area the disc is the softest, and the triangle is farther from it than the square.
        assert 1 < square < triangle
        assert punch.shape_factor(punch.ellipse(1.0, (1.0, 0.3)), 1.0, np.pi * 0.3) > 1

    def test_numbers_say_how_sure_they_are(self):
        assert punch.SQUARE.uncertainty == 1e-6
        assert punch.TRIANGLE.uncertainty == 1e-5


class TestAnnulus:
    def test_reference(self):
        known = {0.25: 0.997832892286, 0.5: 0.981017896923, 0.75: 0.921269836905}
        for hole, ratio in known.items():
            assert punch.annulus(1.0, 0.5, 0.5 * hole) == pytest.approx(ratio, abs=1e-12)

    def test_known_from_boundary_elements(self):
        ratio = punch.annulus(0.5, 1.0, np.array([0.25, 0.5, 0.7, 0.8, 0.9]))
        np.testing.assert_allclose(ratio, [0.998, 0.981, 0.939, 0.897, 0.82], atol=1.5e-3)

    def test_small_holes(self):
        """1 - 4e^3/3pi^2 - 8e^5/15pi^2 - 16e^6/27pi^4 - 92e^7/315pi^2, the next term of order e^8."""
        e = np.array([1e-6, 0.019, 0.021, 0.05])
        series = 1 - (4 / 3 * e**3 + 8 / 15 * e**5 + 16 / (27 * np.pi**2) * e**6 + 92 / 315 * e**7) / np.pi**2
        assert np.abs(punch.annulus(0.5, 1.0, e) - series).max() < e[-1] ** 8
        assert punch.annulus(1.0, 3.0, 0.0) == 6.0

    @pytest.mark.parametrize("width", [1e-2, 1e-3, 1e-6, 1e-12])
    def test_narrow_rings(self, width):
        """pi^2 (1 + e)/(4 ln(16 (1 + e)/(1 - e))), with an error of order (1 - e)^2."""
        e = 1 - width
        width = 1 - e
        ring = np.pi**2 * (1 + e) / (4 * np.log(16 * (1 + e) / width))
        assert punch.annulus(0.5, 1.0, e) == pytest.approx(ring, rel=width**2 + 1e-14)

    def test_falls_with_the_hole(self):
        k = punch.annulus(1.0, 1.0, np.linspace(0, 0.999, 60))
        assert (np.diff(k) < 0).all()
        # Smythe (1951), within 0.35 % up to 0.9.
        e = np.linspace(0.05, 0.9, 18)
        bracket = np.arccos(e) + np.sqrt(1 - e**2) * np.arctanh(e)
        smythe = 2 / np.pi * bracket * (1 + 0.0143 / e * np.tan(1.28 * e) ** 3)
        np.testing.assert_allclose(punch.annulus(0.5, 1.0, e), smythe, rtol=3.5e-3)

    def test_refusal(self):
        with pytest.raises(ValueError, match="inner_radius must be below outer_radius"):
            punch.annulus(1.0, 1.0, 1.0)


class TestTwoDiscs:
    def test_reference(self):
        # To the digits of the references; the second is by Bessel functions in place of quadrature, in 30 digits.
        assert punch.two_discs(1.0, 1.0, 3.0) / 4 == pytest.approx(0.8216172090, rel=1e-10)
        assert punch.two_discs(1.0, 0.8, 3.2) == pytest.approx(2.75495819026, rel=1e-11)
        assert punch.two_discs(1.0, 1.0, 10.0) / 4 == pytest.approx(0.9399828791, rel=1e-10)

    def test_far_apart_the_series_in_radius_over_spacing_holds(self):
        e = 1 / np.array([30.0, 100.0, 300.0])
        # What two discs with the pressure of one do to each other, and the first part of what moves away.
        v = e + e**3 / 3 - 4 / (3 * np.pi) * e**4
        # The next term of v/e is 2/5 e^4.
        k = punch.two_discs(1.0, 1.0, 1 / e)
        np.testing.assert_allclose((4 / k - 1) * np.pi / 2 / v, 1, rtol=0.5 * e.max() ** 4)

    def test_between_one_disc_and_two(self):
        k = punch.two_discs(2.0, 1.0, np.geomspace(3, 1e6, 20))
        assert (np.diff(k) > 0).all()
        assert k[-1] == pytest.approx(2 * punch.disc(2.0, 1.0), rel=1e-6)
        assert k[0] > punch.disc(2.0, 1.0)

    def test_refusal(self):
        with pytest.raises(ValueError, match="at least three radii"):
            punch.two_discs(1.0, 1.0, 2.9)
