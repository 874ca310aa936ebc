"""Persson's gap, stiffness and energy: closed forms, quadrature, thermodynamics and scale laws."""

import itertools
import math

import mpmath
import numpy as np
import pytest
from scipy.integrate import quad

import roughcontact as rc
from roughcontact.theory.persson_theory import persson_separation as separation
from roughcontact.theory.random_surfaces.waves import Waves

MODULUS = 1e11
RMS = 1e-6


def self_affine(hurst, decades=3.0):
    longest = 1e-3
    return rc.SelfAffineSpectrum(hurst, long_cutoff=longest, short_cutoff=longest * 10**-decades).scaled(RMS)


def finite_band_decay(hurst, zeta):
    """u0/(gamma h) of C2D ~ q^(-2H-2) from q0 to zeta q0, by 2F1: u0 = gamma sqrt(2/pi) int dg/q."""
    rest = abs(1 - hurst)
    if hurst < 1:
        reach, power = math.sqrt(zeta ** (2 * rest) - 1), 1 / (2 * rest)
        series = reach * mpmath.hyp2f1(0.5, power, 1.5, -(reach**2))
    else:
        reach, power = math.sqrt(1 - zeta ** (-2 * rest)), 1 / (2 * rest)
        series = reach * mpmath.hyp2f1(0.5, -power, 1.5, reach**2)
    return (
        math.sqrt(2 / math.pi) * math.sqrt(hurst / rest) * float(series) / math.sqrt(1 - zeta ** (-2 * hurst))
    )


class TestDecayLength:
    @pytest.mark.parametrize(
        ("hurst", "ratio", "digits"),
        [
            (0.3, 1.54825, 5e-6),
            (0.5, math.sqrt(math.pi / 2), 1e-12),
            (0.7, 1.11000, 5e-6),
            (0.8, 1.06385, 5e-6),
            (0.9, 1.02811, 5e-6),
            (1.0, 1.0, 0),
            (1.5, 0.92132, 5e-6),
            (2.0, math.sqrt(math.pi) / 2, 1e-12),
        ],
    )
    def test_without_a_shortest_wave(self, hurst, ratio, digits):
        assert separation.self_affine_decay(hurst) == pytest.approx(ratio, abs=digits)

    @pytest.mark.parametrize("hurst", [0.3, 0.7, 1.5, 2.0])
    def test_without_a_shortest_wave_by_quadrature(self, hurst):
        # int_1^inf x^(-2H) [2(1-H)/(x^(2(1-H)) - 1)]^(1/2) dx with x = 1 + s^2
        def integrand(s):
            rise = math.expm1(2 * (1 - hurst) * math.log1p(s * s)) / (2 * (1 - hurst))
            return (1 + s * s) ** (-2 * hurst) * 2 * s / math.sqrt(rise)

        value = quad(integrand, 0, 1)[0] + quad(integrand, 1, math.inf, limit=400)[0]
        assert separation.self_affine_decay(hurst) == pytest.approx(
            math.sqrt(hurst / math.pi) * value, rel=1e-7
        )

    def test_is_smooth_at_one(self):
        # Its slope there is about -0.26.
        for hurst in (1 - 1e-6, 1 + 1e-6):
            assert separation.self_affine_decay(hurst) == pytest.approx(1, abs=1e-6)

    @pytest.mark.parametrize("hurst", [0.3, 0.5, 0.8, 1.5, 2.0])
    @pytest.mark.parametrize("decades", [0.3, 2.0, 4.0])
    def test_of_a_band(self, hurst, decades):
        u0 = separation.decay_length(self_affine(hurst, decades), gamma=1)
        assert u0 / RMS == pytest.approx(finite_band_decay(hurst, 10**decades), rel=1e-8)

    @pytest.mark.parametrize(("hurst", "ratio"), [(0.3, 1.28320), (0.8, 1.05358)])
    def test_of_two_decades(self, hurst, ratio):
        assert separation.decay_length(self_affine(hurst, 2.0), gamma=0.45) / (0.45 * RMS) == pytest.approx(
            ratio, abs=5e-6
        )

    def test_follows_the_heights_and_nothing_else(self):
        small, large = self_affine(0.8), self_affine(0.8).scaled(3 * RMS)
        wide = rc.SelfAffineSpectrum(0.8, long_cutoff=1.0, short_cutoff=1e-3).scaled(RMS)
        u0 = separation.decay_length(small)
        assert separation.decay_length(large) == pytest.approx(3 * u0, rel=1e-12)
        assert separation.decay_length(wide) == pytest.approx(u0, rel=1e-12)


class TestOneWave:
    """Heights of one wave: all integrals over the slope in closed form, for gamma = 1."""

    Q, POWER = 5e3, 1e-12
    WAVE = Waves.of_bands(np.array([Q]), np.array([POWER]))
    SLOPE = Q * math.sqrt(POWER)

    def test_stiffness(self):
        for p in MODULUS * self.SLOPE * np.array([1e-5, 1e-2, 0.3, 1.0]):
            c = math.sqrt(2) * p / MODULUS
            rest = self.SLOPE * math.exp(-((c / self.SLOPE) ** 2)) - math.sqrt(math.pi) * c * math.erfc(
                c / self.SLOPE
            )
            length = math.sqrt(2 / math.pi) * rest / self.Q
            # The nodes promise 1e-8.
            assert separation.stiffness(p, MODULUS, self.WAVE, gamma=1) == pytest.approx(p / length, rel=1e-8)

    def test_low_loads(self):
        assert separation.decay_length(self.WAVE, gamma=1) == pytest.approx(
            math.sqrt(2 / math.pi) * self.SLOPE / self.Q, rel=1e-12
        )
        # The mean of ln g over the wave is ln(g) - 1; exp(-C/2) = 0.749306, C Euler's constant.
        plain = 0.749306 * MODULUS * self.SLOPE / (math.sqrt(2) * math.e)
        assert separation.reference_pressure(MODULUS, self.WAVE, gamma=1) == pytest.approx(plain, rel=1e-6)
        usual = plain * math.exp(3 * 0.55 / 0.45 * 0.407125)
        # The constant has six digits, and 3.7 stands before it.
        assert separation.reference_pressure(MODULUS, self.WAVE) == pytest.approx(usual, rel=3e-6)


class TestAgainstQuadrature:
    Q0, Q1 = 1e4, 1e6
    SPECTRUM = rc.SelfAffineSpectrum(0.7, long_cutoff=2 * np.pi / Q0, short_cutoff=2 * np.pi / Q1).scaled(RMS)

    def over_waves(self, function):
        """sqrt(pi) int q^2 C2D w f(w) dq, the page's integral as it stands, with q = q0 (1 + s^2)."""
        scale = float(self.SPECTRUM(np.array([1e5]))[0]) * 1e5**3.4

        def integrand(s):
            q = self.Q0 * (1 + s * s)
            square = math.pi * scale * self.Q0**0.6 * math.expm1(0.6 * math.log1p(s * s)) / 0.6
            w = 1 / math.sqrt(square)
            return math.sqrt(math.pi) * q**2 * scale * q**-3.4 * w * function(w) * 2 * self.Q0 * s

        edges = [1e-12, 1e-8, 1e-6, 1e-4, 1e-2, 0.1, 1, math.sqrt(self.Q1 / self.Q0 - 1)]
        return sum(
            quad(integrand, a, b, epsabs=0, epsrel=1e-11, limit=200)[0] for a, b in itertools.pairwise(edges)
        )

    @pytest.mark.parametrize("ratio", [1e-6, 1e-3, 1e-2, 5e-2])
    @pytest.mark.parametrize("gamma", [1.0, 0.45])
    def test_stiffness(self, ratio, gamma):
        def fall(w):
            x = w * ratio
            return (gamma + 3 * (1 - gamma) * math.erf(x) ** 2) * math.exp(-(x**2))

        value = separation.stiffness(ratio * MODULUS, MODULUS, self.SPECTRUM, gamma=gamma)
        assert value == pytest.approx(ratio * MODULUS / self.over_waves(fall), rel=1e-8)

    @pytest.mark.parametrize("ratio", [1e-4, 1e-2])
    def test_mean_gap(self, ratio):
        def tail(w):
            def inner(t):
                return (0.45 + 1.65 * math.erf(t) ** 2) * math.exp(-(t**2)) / t

            x = w * ratio
            # Beyond 7 there is exp(-49); in ln t the integrand is smooth.
            return (
                quad(lambda u: inner(math.exp(u)) * math.exp(u), math.log(x), math.log(7))[0]
                if x < 7
                else 0.0
            )

        value = separation.mean_gap(ratio * MODULUS, MODULUS, self.SPECTRUM)
        assert value == pytest.approx(self.over_waves(tail), rel=1e-8)

    def test_energy(self):
        ratio = 1e-2

        def squeezed(w):
            part = math.erf(w * ratio)
            # (pi/2) E* q^2 C2D W against sqrt(pi) q^2 C2D w f
            return math.sqrt(math.pi) / 2 * part * (0.45 + 0.55 * part**2) / w

        value = separation.elastic_energy(ratio * MODULUS, MODULUS, self.SPECTRUM)
        assert value == pytest.approx(MODULUS * self.over_waves(squeezed), rel=1e-8)


class TestConstants:
    def test_erf_squared_tail(self):
        value = quad(lambda x: math.erf(x) ** 2 * math.exp(-x * x) / x, 0, 8, epsabs=1e-13)[0]
        assert pytest.approx(value, abs=1e-12) == separation.ERF_SQUARED_TAIL
        assert pytest.approx(0.407125, abs=5e-7) == separation.ERF_SQUARED_TAIL

    def test_closure(self):
        # int_0^inf W'(P) dP/dx dx = W(1) - W(0) = 1 for every gamma.
        for gamma in (0.45, 1.0):
            total = quad(
                lambda x, g=gamma: 2 / math.sqrt(math.pi) * float(separation._fall(np.array(x), g)), 0, 8
            )[0]
            assert total == pytest.approx(1, rel=1e-10)


class TestLimits:
    SPECTRUM = self_affine(0.8)

    def test_low_loads_are_exponential(self):
        u0 = separation.decay_length(self.SPECTRUM)
        p_c = separation.reference_pressure(MODULUS, self.SPECTRUM)
        # What is neglected is of the order of (w p/E*)^2 where the waves are, and linear in p near the first one.
        p = 1e-11 * MODULUS
        assert separation.mean_gap(p, MODULUS, self.SPECTRUM) == pytest.approx(
            u0 * math.log(p_c / p), rel=1e-8
        )
        assert separation.stiffness(p, MODULUS, self.SPECTRUM) == pytest.approx(p / u0, rel=1e-8)

    def test_no_load(self):
        assert separation.mean_gap(0.0, MODULUS, self.SPECTRUM) == math.inf
        assert separation.stiffness(0.0, MODULUS, self.SPECTRUM) == 0
        assert separation.elastic_energy(0.0, MODULUS, self.SPECTRUM) == 0

    def test_full_contact(self):
        waves = Waves.of(self.SPECTRUM)
        p = 50 * MODULUS * waves.rms_slope
        assert separation.stiffness(p, MODULUS, waves) == math.inf
        assert separation.mean_gap(p, MODULUS, waves) == 0
        # A wave of mean square B^2 takes (E* q/4) B^2 to flatten.
        full = MODULUS / 4 * float(waves.wavenumber @ waves.power)
        assert separation.elastic_energy(p, MODULUS, waves) == pytest.approx(full, rel=1e-13)

    def test_everything_grows_with_the_load(self):
        p = np.geomspace(1e-8, 0.05, 40) * MODULUS
        assert (np.diff(separation.stiffness(p, MODULUS, self.SPECTRUM)) > 0).all()
        assert (np.diff(separation.mean_gap(p, MODULUS, self.SPECTRUM)) < 0).all()
        assert (np.diff(separation.elastic_energy(p, MODULUS, self.SPECTRUM)) > 0).all()

    def test_scale_laws(self):
        p = np.geomspace(1e-6, 1e-2, 5) * MODULUS
        # A surface magnified by 7: same slopes, everything as long as it is.
        scaled = rc.SelfAffineSpectrum(0.8, long_cutoff=7e-3, short_cutoff=7e-6).scaled(7 * RMS)
        given = (MODULUS, self.SPECTRUM)
        assert separation.mean_gap(p, MODULUS, scaled) == pytest.approx(
            7 * separation.mean_gap(p, *given), rel=1e-12
        )
        assert separation.stiffness(p, MODULUS, scaled) == pytest.approx(
            separation.stiffness(p, *given) / 7, rel=1e-12
        )
        stiff = separation.stiffness(3 * p, 3 * MODULUS, self.SPECTRUM)
        assert stiff == pytest.approx(3 * separation.stiffness(p, *given), rel=1e-12)

    def test_shapes(self):
        p = np.full((2, 3), 1e6)
        assert separation.mean_gap(p, MODULUS, self.SPECTRUM).shape == (2, 3)
        assert separation.stiffness(1e6, MODULUS, self.SPECTRUM).shape == ()

    def test_bad_input_is_refused(self):
        with pytest.raises(ValueError, match="gamma"):
            separation.stiffness(1.0, MODULUS, self.SPECTRUM, gamma=0.0)
        with pytest.raises(ValueError, match="pressure"):
            separation.mean_gap(-1.0, MODULUS, self.SPECTRUM)
        with pytest.raises(ValueError, match="modulus"):
            separation.elastic_energy(1.0, 0.0, self.SPECTRUM)
        with pytest.raises(ValueError, match="positive Hurst"):
            separation.self_affine_decay(0.0)
