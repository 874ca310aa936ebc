"""Sums over waves against closed forms, and every description of a surface that Persson's theory takes."""

import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.theory.random_surfaces.waves import Waves

SELF_AFFINE = {"long_cutoff": 1e-3, "short_cutoff": 1e-6}


@pytest.fixture
def rng():
    return np.random.default_rng(7)


class TestContinuous:
    @pytest.mark.parametrize("hurst", [-1.0, -0.5, 0.0, 0.3, 0.8, 1.0, 1.5, 3.0])
    @pytest.mark.parametrize("rolloff", [None, 2.3e-4])
    def test_moments_are_the_closed_ones(self, hurst, rolloff):
        spectrum = rc.SelfAffineSpectrum(hurst, rolloff=rolloff, **SELF_AFFINE)
        waves, exact = Waves.of_spectrum(spectrum), spectrum.moments()
        # Gauss' rule is at rounding on these panels; sums of some hundred terms lose a digit or two.
        for name in ("m0", "m2", "m4"):
            assert getattr(waves, name) == pytest.approx(getattr(exact, name), rel=1e-12)

    @pytest.mark.parametrize("hurst", [0.3, 0.8, 1.5])
    def test_slope_at_a_node_is_that_of_all_longer_waves(self, hurst):
        spectrum = rc.SelfAffineSpectrum(hurst, **SELF_AFFINE)
        waves = Waves.of_spectrum(spectrum)
        power = 2 - 2 * hurst
        x = waves.wavenumber / spectrum.q_min
        grown = 2 * math.pi * spectrum.q_min**power * np.expm1(power * np.log(x)) / power
        # x is known to rounding, and x - 1 near the first wave therefore less well: only beyond 1e-4.
        beyond = x > 1 + 1e-4
        # Eight nodes on panels that are twice as wide as far from the singularity: 10^-8.
        assert waves.slope[beyond] == pytest.approx(np.sqrt(grown)[beyond], rel=1e-8)

    def test_integrals_with_the_singularity_of_the_first_wave(self):
        # int q^3 C2D/g dq = g(q_max)/(2 pi): a band of C2D = q^-3 has g^2 = 2 pi (q - q0).
        waves = Waves.of_spectrum(lambda q: q**-3.0, 2.0, 50.0)
        total = np.sum(waves.power * waves.wavenumber**2 / waves.slope)
        # int dg^2/g = 2 g
        assert total == pytest.approx(2 * math.sqrt(2 * math.pi * 48), rel=1e-8)

    def test_features_at_small_slopes_are_resolved(self):
        # int exp(-c^2/g^2) dg^2/g = 2 [g exp(-c^2/g^2) - sqrt(pi) c erfc(c/g)]
        waves = Waves.of_spectrum(lambda q: q**-3.0, 2.0, 50.0)
        g = math.sqrt(2 * math.pi * 48)
        for c in g * np.geomspace(1e-6, 1, 9):
            exact = 2 * (g * math.exp(-((c / g) ** 2)) - math.sqrt(math.pi) * c * math.erfc(c / g))
            total = np.sum(
                waves.power * waves.wavenumber**2 / waves.slope * np.exp(-((c / waves.slope) ** 2))
            )
            assert total == pytest.approx(exact, rel=1e-8)

    def test_a_smaller_magnification_is_a_shorter_band(self):
        spectrum = rc.SelfAffineSpectrum(0.8, rolloff=2e-4, **SELF_AFFINE)
        whole = Waves.of_spectrum(spectrum)
        for node in (350, 400, 450):
            part = Waves.of_spectrum(spectrum, q_max=whole.wavenumber[node])
            assert part.rms_slope == pytest.approx(whole.slope[node], rel=1e-8)

    def test_a_corner_of_any_spectrum_can_be_named(self):
        def bent(q):
            return np.where(q < 10, q**-2.0, 100 * q**-4.0)

        waves = Waves.of_spectrum(bent, 1.0, 100.0, breaks=[10.0])
        assert waves.m0 == pytest.approx(2 * math.pi * (math.log(10) + 50 * (1e-2 - 1e-4)), rel=1e-12)

    def test_steep_spectra_do_not_upset_the_order(self):
        waves = Waves.of_spectrum(rc.SelfAffineSpectrum(3.0, long_cutoff=1.0, short_cutoff=1e-7))
        assert (np.diff(waves.slope) >= 0).all()

    @pytest.mark.parametrize(
        ("spectrum", "reason"),
        [
            (rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3), "no shortest wave"),
            (rc.SelfAffineSpectrum(0.8, short_cutoff=1e-6), "no longest wave"),
            (rc.SelfAffineSpectrum(0.8, rolloff=1e-4, short_cutoff=1e-6), "no longest wave"),
            (rc.SelfAffineSpectrum(0.8, dimension=1, **SELF_AFFINE), "line"),
        ],
    )
    def test_missing_limits_are_refused_with_the_reason(self, spectrum, reason):
        with pytest.raises(ValueError, match=reason):
            Waves.of(spectrum)

    def test_the_band_is_within_that_of_the_spectrum(self):
        spectrum = rc.SelfAffineSpectrum(0.8, **SELF_AFFINE)
        wider = Waves.of_spectrum(spectrum, spectrum.q_min / 2, spectrum.q_max * 2)
        assert np.array_equal(wider.power, Waves.of_spectrum(spectrum).power)

    def test_limits_may_be_given_apart(self):
        spectrum = rc.SelfAffineSpectrum(0.8)
        closed = rc.SelfAffineSpectrum(0.8, **SELF_AFFINE)
        waves = Waves.of_spectrum(spectrum, closed.q_min, closed.q_max)
        assert waves.m2 == pytest.approx(closed.moments().m2, rel=1e-12)

    def test_bad_spectra_are_refused(self):
        with pytest.raises(ValueError, match="no wave lies between"):
            Waves.of_spectrum(lambda q: q**-3.0, 5.0, 2.0)
        with pytest.raises(ValueError, match="not negative"):
            Waves.of_spectrum(lambda q: -(q**-3.0), 2.0, 5.0)
        with pytest.raises(ValueError, match="zero between its limits"):
            Waves.of_spectrum(lambda q: 0 * q, 2.0, 5.0)
        with pytest.raises(ValueError, match="is needed"):
            Waves.of(rc.StretchedSpectrum(rc.SelfAffineSpectrum(0.8, **SELF_AFFINE), 2.0))


class TestMeasured:
    def test_moments_are_those_of_the_analysis(self, rng):
        grid = rc.Grid((64, 48), 1e-6, periodic=True)
        spectrum = rc.power_spectrum(rc.self_affine(grid, hurst=0.7, rms=1e-7, rng=rng))
        waves, exact = Waves.of(spectrum), rc.spectrum_moments(spectrum)
        for name in ("m0", "m2", "m4"):
            assert getattr(waves, name) == pytest.approx(getattr(exact, name), rel=1e-10)

    def test_band_may_be_chosen(self, rng):
        grid = rc.Grid((64, 64), 1e-6, periodic=True)
        spectrum = rc.power_spectrum(rc.self_affine(grid, hurst=0.7, rms=1e-7, rng=rng))
        waves = Waves.of_measured(spectrum, q_max=1e6)
        assert waves.m2 == pytest.approx(rc.spectrum_moments(spectrum, q_max=1e6).m2, rel=1e-10)
        with pytest.raises(ValueError, match="two bins"):
            Waves.of_measured(spectrum, 1.0, 2.0)

    def test_profiles_are_refused_with_the_remedy(self, rng):
        grid = rc.Grid((64, 64), 1e-6, periodic=True)
        profiles = rc.power_spectrum(rc.self_affine(grid, hurst=0.7, rms=1e-7, rng=rng), direction="x")
        with pytest.raises(ValueError, match="surface_spectrum"):
            Waves.of(profiles)


class TestHeights:
    @pytest.mark.parametrize("shape", [(32, 32), (31, 33), (16, 45)])
    def test_moments_are_those_of_the_periodic_surface(self, rng, shape):
        grid = rc.Grid(shape, (2e-6, 1e-6), periodic=True)
        heights = 1e-7 * rng.normal(size=shape) + 3.0
        waves, exact = Waves.of_heights(heights, grid.spacing), rc.surface_moments(rc.Surface(heights, grid))
        assert waves.m0 == pytest.approx(np.var(heights), rel=1e-12)
        assert waves.m2 == pytest.approx(exact.m2, rel=1e-12)
        # Bands keep the sums of q^0 and q^2; of width 1e-3, they change that of q^4 by 1e-6/12 at most a few times.
        assert waves.m4 == pytest.approx(exact.m4, rel=1e-6)

    def test_one_wave_is_spread_over_its_own_slope(self):
        x = np.arange(32)
        heights = np.broadcast_to(0.01 * np.cos(2 * np.pi * 3 * x / 32), (32, 32))
        waves = Waves.of_heights(heights, (0.5, 0.5))
        q = 2 * np.pi * 3 / 16
        # Whatever the transform leaves of other waves is rounding.
        real = waves.power > 1e-25
        assert waves.wavenumber[real] == pytest.approx(q, rel=1e-9)
        assert waves.m0 == pytest.approx(0.01**2 / 2, rel=1e-12)
        assert waves.slope[real].max() < waves.rms_slope == pytest.approx(0.01 * q / math.sqrt(2), rel=1e-12)

    def test_bad_heights_are_refused(self):
        with pytest.raises(ValueError, match="two axes"):
            Waves.of_heights(np.zeros(8), (1.0, 1.0))
        with pytest.raises(ValueError, match="not measured"):
            Waves.of_heights(np.full((4, 4), np.nan), (1.0, 1.0))
        with pytest.raises(ValueError, match="flat"):
            Waves.of_heights(np.ones((4, 4)), (1.0, 1.0))


class TestBands:
    def test_a_narrow_band_is_a_wave(self):
        q, width = 7.0, 1e-7
        density = 1e-6 / (2 * math.pi * q * q * width)
        band = Waves.of_spectrum(lambda x: np.full_like(x, density), q, q * (1 + width))
        wave = Waves.of_bands(np.array([q]), np.array([1e-6]))
        for c in (0.0, 1e-3, 3e-3):
            a, b = (
                np.sum(w.power * w.wavenumber / w.slope * np.exp(-((c / w.slope) ** 2))) for w in (band, wave)
            )
            # They differ by the width of the band, and by what 1 + width loses in rounding.
            assert a == pytest.approx(b, rel=1e-6)

    def test_bad_bands_are_refused(self):
        with pytest.raises(ValueError, match="increasing"):
            Waves.of_bands(np.array([2.0, 1.0]), np.array([1.0, 1.0]))
        with pytest.raises(ValueError, match="positive and finite"):
            Waves.of_bands(np.array([1.0, 2.0]), np.array([1.0, 0.0]))

    def test_the_value_checks_itself(self):
        good = (np.array([1.0, 2.0]), np.array([1.0, 1.0]), np.array([0.5, 1.0]))
        assert not Waves(*good).power.flags.writeable
        with pytest.raises(ValueError, match="long waves to short"):
            Waves(good[0][::-1], *good[1:])
        with pytest.raises(ValueError, match="one value for each"):
            Waves(good[0], good[1][:1], good[2])
        with pytest.raises(ValueError, match="positive and finite"):
            Waves(good[0], good[1], np.array([0.0, 1.0]))
