"""Joint conductance: the correlations against the models they fit, and the constriction of a spot in a tube."""

import math

import numpy as np
import pytest
from scipy.special import erfcinv, j0, jn_zeros

import roughcontact as rc
from roughcontact.theory.asperity_models import bush_gibson_thomas
from roughcontact.theory.joints import conductance, holm, thermal

MOMENTS = rc.Moments(4e-12, 0.02, 1e9)
PAIR = (400.0, 16.0)
K_S = conductance.harmonic_mean(PAIR)
SIGMA, SLOPE = 2e-6, math.sqrt(2 * 0.02 / math.pi)


def joint(fraction, radius_part):
    """h sigma/(k_s m) of cut-off Gaussian heights: n spots of radius a, 2 k_s a n/psi.

    The geometric fraction erfc(t/sqrt2)/2 is that of spots; elastic ones have half their area (`radius_part` 1/sqrt2).
    """
    depth = math.sqrt(2) * erfcinv(2 * fraction / radius_part**2)
    return (
        radius_part * np.exp(-(depth**2) / 2) / (2 * math.sqrt(2 * math.pi)) / (1 - np.sqrt(fraction)) ** 1.5
    )


class TestCorrelations:
    FRACTION = np.geomspace(1e-6, 0.05, 30)

    def test_plastic(self):
        h = thermal.plastic_conductance(self.FRACTION * 3e9, 3e9, PAIR, MOMENTS)
        # What the module promises of the fit.
        assert h == pytest.approx(K_S * SLOPE / SIGMA * joint(self.FRACTION, 1.0), rel=0.05)

    def test_elastic(self):
        pressure = self.FRACTION * 1e11 * SLOPE / math.sqrt(2)
        h = thermal.elastic_conductance(pressure, 1e11, PAIR, MOMENTS)
        assert h == pytest.approx(K_S * SLOPE / SIGMA * joint(self.FRACTION, 1 / math.sqrt(2)), rel=0.05)

    def test_coefficients_and_exponents(self):
        assert thermal.plastic_conductance(1e-2, 1.0, PAIR, MOMENTS) == pytest.approx(
            1.25 * K_S * SLOPE / SIGMA * 1e-2**0.95, rel=1e-13
        )
        one, two = thermal.elastic_conductance(np.array([1e6, 2e6]), 1e11, PAIR, MOMENTS)
        assert two / one == pytest.approx(2**0.94, rel=1e-13)

    def test_elastic_pressure_is_that_of_asperity_theory(self):
        # Bush, Gibson and Thomas: A/A0 = sqrt(2 pi) p/(E* g), g = sqrt(2 m2).
        pressure = thermal.mean_absolute_slope(MOMENTS) / math.sqrt(2)
        expected = math.sqrt(2 * MOMENTS.m2) / math.sqrt(2 * math.pi)
        assert pressure == pytest.approx(expected, rel=1e-14)
        assert bush_gibson_thomas.asymptotic_fraction(pressure, MOMENTS, 1.0) == pytest.approx(1, rel=1e-14)

    def test_mean_absolute_slope_of_a_gaussian_surface(self):
        # Slopes of a random sum of many waves are Gaussian: E|s| = sqrt(2/pi) rms.
        grid = rc.Grid((256, 256), 1e-6, periodic=True)
        surface = rc.self_affine(grid, hurst=0.3, rms=1e-7, rng=np.random.default_rng(5), rolloff=3e-5)
        slopes = np.fft.ifft(
            2j * np.pi * np.fft.fftfreq(256, 1e-6) * np.fft.fft(surface.heights, axis=1), axis=1
        ).real
        # 65536 slopes, correlated over few cells.
        assert np.abs(slopes).mean() == pytest.approx(
            thermal.mean_absolute_slope(rc.surface_moments(surface)), rel=0.02
        )

    def test_laws(self):
        area, force = 1e-4, np.array([10.0, 1e3])
        plastic = thermal.plastic_law(MOMENTS, 3e9, PAIR, area)
        assert plastic.predict("thermal_conductance", force) == pytest.approx(
            area * thermal.plastic_conductance(force / area, 3e9, PAIR, MOMENTS), rel=1e-14
        )
        elastic = thermal.elastic_law(MOMENTS, 1e11, PAIR, area)
        assert elastic.predict("thermal_conductance", force) == pytest.approx(
            area * thermal.elastic_conductance(force / area, 1e11, PAIR, MOMENTS), rel=1e-14
        )
        for law in (plastic, elastic):
            top = law.domain[1]
            assert np.isnan(law.predict("thermal_conductance", 1.01 * top))
            assert law.predict("thermal_conductance", top) > 0

    def test_bad_input_is_refused(self):
        with pytest.raises(ValueError, match=r"0\.05 of the hardness"):
            thermal.plastic_conductance(1e9, 3e9, PAIR, MOMENTS)
        with pytest.raises(ValueError, match="hardness"):
            thermal.plastic_law(MOMENTS, 0.0, PAIR, 1.0)
        with pytest.raises(ValueError, match="m2"):
            thermal.elastic_law(rc.Moments(1.0, math.inf, math.inf), 1.0, PAIR, 1.0)
        with pytest.raises(ValueError, match="m0"):
            thermal.plastic_law(rc.Moments(0.0, 1.0, 1.0), 1.0, PAIR, 1.0)


def tube_constriction(eps, terms=20000):
    """psi of an isothermal disc in a coaxial tube: the least dissipation of three flux distributions on the disc."""
    n = np.arange(1, terms + 1)
    far = (n + 0.25) * math.pi
    zeros = far - 3 / (8 * far) + 36 / (3 * (8 * far) ** 3)  # McMahon
    zeros[:60] = jn_zeros(1, 60)
    x = zeros * eps
    # Transforms of (1 - r^2)^(k - 1/2), each of total 1: Gamma functions times j_k(x)/x^k.
    flux = np.array(
        [
            np.sin(x) / x,
            3 * (np.sin(x) - x * np.cos(x)) / x**3,
            15 * ((3 - x**2) * np.sin(x) - 3 * x * np.cos(x)) / x**5,
        ]
    )
    matrix = 4 * eps / math.pi * (flux / (zeros * j0(zeros) ** 2)) @ flux.T
    # Of the rest of the first series the mean of sin^2 counts.
    matrix[0, 0] += 1 / (eps * math.pi**2 * (terms + 0.75))
    return 1 / np.linalg.inv(matrix).sum()


class TestConstriction:
    @pytest.mark.parametrize("eps", [0.1, 0.3, 0.5, 0.7])
    def test_tube(self, eps):
        # The sum is known to 1e-6 (its rest) and from above by the trial fluxes; the series is printed to 1e-5 in
        # each of four coefficients, and ends at the seventh power.
        assert thermal.constriction(eps, "tube") == pytest.approx(tube_constriction(eps), abs=2e-4)

    def test_small_spots(self):
        assert thermal.constriction(0.0, "tube") == thermal.constriction(0.0) == 1
        assert thermal.constriction(1.0) == 0
        # The last digit of each of the five coefficients.
        assert thermal.constriction(1.0, "tube") == pytest.approx(0, abs=1e-3)

    def test_forms_agree(self):
        # In the range of fractions that joints have.
        eps = np.linspace(0, 0.3, 7)
        assert thermal.constriction(eps) == pytest.approx(thermal.constriction(eps, "tube"), rel=0.065)

    def test_a_wide_cell_is_a_half_space(self):
        alone = holm.spot_resistance(1e-6, (1 / 400, 1 / 16))
        assert thermal.cell_resistance(1e-6, 1e3, PAIR) == pytest.approx(float(alone), rel=1e-8)

    def test_bad_input_is_refused(self):
        with pytest.raises(ValueError, match="no larger than its cell"):
            thermal.constriction(1.1)
        with pytest.raises(ValueError, match="form"):
            thermal.constriction(0.1, "square")
