"""The spectrum of the line that stands for a surface."""

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.mdr.lines.equivalent_line import LineSpectrum, TabulatedSpectrum, line_spectrum
from roughcontact.surface.analysis.power import PowerSpectrum

SURFACE = rc.SelfAffineSpectrum(0.8, rolloff=2e-4, long_cutoff=1e-3, short_cutoff=1e-6)
SURFACE = SURFACE.scaled(rms=1e-6)


def tabulated(density=(4.0, 2.0, 0.0, 0.5), kind="C2D", band=(1.0, 8.0)):
    count = np.ones(4)
    return PowerSpectrum(np.array([1.0, 2, 4, 8]), np.array(density), kind, count, count, *band)


def integral(spectrum, power, corners):
    """Return 2 int q^power C1D dq over logarithms of q, piece by piece."""
    return 2 * sum(
        quad(lambda t: math.exp(t * (power + 1)) * spectrum(np.array([math.exp(t)]))[0], a, b, epsrel=1e-12)[
            0
        ]
        for a, b in itertools.pairwise(corners)
    )


class TestLineSpectrum:
    def test_line_and_surface_have_one_rms_height(self):
        assert line_spectrum(SURFACE).moments().rms_height == pytest.approx(1e-6, rel=1e-12)

    def test_moments_are_integrals_over_the_line(self):
        line = LineSpectrum(SURFACE, 2.3)
        # A hair inside the limits, where the spectrum drops to zero.
        corners = np.log(
            [2 * math.pi / 1e-3 * (1 + 1e-14), 2 * math.pi / 2e-4, 2 * math.pi / 1e-6 * (1 - 1e-14)]
        )
        moments = line.moments()
        assert moments.m0 == pytest.approx(integral(line, 0, corners), rel=1e-10)
        assert moments.m2 == pytest.approx(integral(line, 2, corners), rel=1e-10)
        assert moments.m4 == pytest.approx(integral(line, 4, corners), rel=1e-10)
        assert moments.dimension == 1

    def test_rms_slope_of_the_line_is_the_rms_gradient_of_the_surface(self):
        assert line_spectrum(SURFACE).moments().rms_slope == pytest.approx(
            SURFACE.moments().rms_slope, rel=1e-12
        )

    def test_of_a_power_law_is_the_power_law_of_a_line(self):
        surface = rc.SelfAffineSpectrum(0.6, short_cutoff=1e-6, scale=3e-12)
        line = rc.SelfAffineSpectrum(0.6, short_cutoff=1e-6, scale=math.pi * 3e-12, dimension=1)
        q = np.geomspace(1e3, 1e8, 50)
        np.testing.assert_allclose(line_spectrum(surface)(q), line(q), rtol=1e-13)

    def test_a_plateau_of_the_surface_is_a_rise_of_the_line(self):
        q = 2 * math.pi / 1e-3 * np.array([1.0, 2, 4])
        np.testing.assert_allclose(np.diff(np.log(line_spectrum(SURFACE)(q))), math.log(2), rtol=1e-12)

    def test_keeps_the_band(self):
        line = line_spectrum(SURFACE)
        assert (line.q_min, line.q_max, line.dimension) == (SURFACE.q_min, SURFACE.q_max, 1)
        line = line_spectrum(lambda q: 1 / (1 + q**4))
        assert (line.q_min, line.q_max) == (0, math.inf)
        with pytest.raises(AttributeError):
            line.moments()

    def test_does_not_depend_on_the_size_of_the_domain(self):
        # The thesis' eq. 4.56 lacks a length: here a shape in q L and its scale stay the same spectrum.
        q = np.array([1e5, 1e6])
        for length in (1e-3, 1.0, 5.0):
            at_one = 2e-12 * length**3.6
            surface = rc.SelfAffineSpectrum(0.8, scale=at_one / length**3.6)
            expected = math.pi * at_one / length * (length * q) ** -2.6
            np.testing.assert_allclose(line_spectrum(surface)(q), expected, rtol=1e-12)

    def test_makes_lines(self):
        grid = rc.Grid(1000, 1e-6)
        line = rc.synthesise(grid, line_spectrum(SURFACE), np.random.default_rng(0))
        assert line.rms == pytest.approx(rc.grid_moments(grid, line_spectrum(SURFACE)).rms_height, rel=1e-12)

    @pytest.mark.parametrize("factor", [0.0, -1.0, math.nan, math.inf])
    def test_refuses_a_factor_that_is_none(self, factor):
        with pytest.raises(ValueError, match="factor must be positive"):
            line_spectrum(SURFACE, factor)

    def test_refuses_the_spectrum_of_a_line(self):
        for spectrum in (
            rc.SelfAffineSpectrum(0.5, dimension=1),
            line_spectrum(SURFACE),
            tabulated(kind="C1D"),
            rc.hurst_exponent(rc.self_affine(rc.Grid(256, 1.0), 0.5, 1.0, np.random.default_rng(0))),
        ):
            with pytest.raises(ValueError, match="surface"):
                line_spectrum(spectrum)


class TestTabulatedSpectrum:
    def test_is_a_power_law_between_bins_with_power(self):
        spectrum = TabulatedSpectrum(tabulated())
        # From 2 to 8 rad/m over the empty bin: 2 (q/2)^-1.
        q = np.array([1, math.sqrt(2), 2, 4, 5, 8])
        np.testing.assert_allclose(spectrum(q), [4, 4 / math.sqrt(2), 2, 1, 0.8, 0.5], rtol=1e-12)

    def test_goes_on_to_the_ends_of_its_band_and_no_further(self):
        spectrum = TabulatedSpectrum(tabulated(band=(0.9, 9.0)))
        q = np.array([0, 0.89, 0.9, 9, 9.01])
        np.testing.assert_allclose(spectrum(q), [0, 0, 4 / 0.9, 4 / 9, 0], rtol=1e-12)
        assert (spectrum.q_min, spectrum.q_max) == (0.9, 9.0)

    def test_needs_two_bins_with_power(self):
        with pytest.raises(ValueError, match="two bins"):
            TabulatedSpectrum(tabulated((1.0, 0, 0, 0)))

    def test_line_of_a_measured_surface_is_as_rough_as_the_surface(self):
        rng = np.random.default_rng(5)
        surface = rc.self_affine(rc.Grid((256, 256), 1e-6, periodic=True), 0.8, 1e-6, rng, support="disc")
        measured = rc.power_spectrum(surface)
        line = line_spectrum(measured.within(2 * math.pi / 256e-6, math.pi / 1e-6))
        grid = rc.Grid(256, 1e-6, periodic=True)
        # C2D in rings of one wave's width, read off at the line's waves: the longest waves of a square, at 1 and
        # sqrt(2), fall into one ring, hence a few per cent.
        discrete = rc.grid_moments(grid, line).m0 / math.pi * 2.5897  # lambda for H = 0.8, many waves
        assert math.sqrt(discrete) == pytest.approx(1e-6, rel=0.1)


@pytest.mark.parametrize("wrong", [5, rc.Surface(np.zeros((30, 30)), rc.Grid((30, 30), 1.0))])
def test_what_is_no_spectrum(wrong):
    with pytest.raises(ValueError, match=r"a spectrum C2D\(q\) is needed.*not (5|a Surface)$"):
        line_spectrum(wrong)


def test_a_factor_is_a_number():
    with pytest.raises(ValueError, match="factor must be one number"):
        LineSpectrum(lambda q: q, "a")
