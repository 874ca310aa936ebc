import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.analysis.hurst import fit_spectrum, hurst_exponent
from roughcontact.surface.analysis.power import PowerSpectrum


def gaussian(n, hurst, seed, crop=False, **limits):
    """A Gaussian-amplitude surface of n x n cells, or as many cut out of one twice as long."""
    size = 2 * n if crop else n
    rng = np.random.default_rng(seed)
    whole = rc.self_affine(
        rc.Grid((size, size), 1e-6, True), hurst, 1e-6, rng, amplitudes="gaussian", **limits
    )
    return rc.Surface(whole.heights[:n, :n], rc.Grid((n, n), 1e-6)) if crop else whole


def exact(density, kind="C2D", freedom=100.0):
    q = np.geomspace(1e3, 1e6, 300)
    full = np.full(q.shape, freedom)
    return PowerSpectrum(q, density(q), kind, 2 * full, full, q[0], q[-1])


@pytest.mark.parametrize(("kind", "steepness"), [("C2D", 2 * (0.63 + 1)), ("C1D", 2 * 0.63 + 1)])
def test_a_law_without_noise_is_found_exactly(kind, steepness):
    spectrum = exact(lambda q: 3e-20 * (q / 1e4) ** -steepness, kind)
    fit = fit_spectrum(spectrum)
    assert fit.hurst == pytest.approx(0.63, abs=1e-9)
    assert fit.exponent == pytest.approx(steepness, abs=1e-8)
    assert fit(1e4) == pytest.approx(3e-20, rel=1e-8)
    assert (fit.rolloff_wavelength, fit.cutoff_wavelength, fit.short_wavelength) == (None, None, None)
    # Regression of 300 equally weighted points over ln q: variance = 1/(freedom sum (x - mean)^2), half of it for H.
    x = np.log(spectrum.wavenumber)
    assert fit.standard_error == pytest.approx(0.5 / math.sqrt(100 * ((x - x.mean()) ** 2).sum()), rel=1e-6)


def test_the_ends_of_a_law_without_noise_are_found():
    rolled = fit_spectrum(exact(lambda q: np.maximum(q, 1e4) ** -3.6))
    step = math.log(1e3) / 299  # between bins
    assert math.log(2 * math.pi / rolled.rolloff_wavelength / 1e4) == pytest.approx(0, abs=step)
    assert rolled.hurst == pytest.approx(0.8, abs=0.01)
    cut = fit_spectrum(exact(lambda q: np.where((q < 1e4) | (q > 2e5), 0.0, q**-3.6)))
    assert math.log(2 * math.pi / cut.cutoff_wavelength / 1e4) == pytest.approx(0, abs=step)
    assert math.log(2 * math.pi / cut.short_wavelength / 2e5) == pytest.approx(0, abs=step)
    assert cut.hurst == pytest.approx(0.8, abs=1e-8)
    assert cut(np.array([5e3, 3e5])).tolist() == [0, 0]


@pytest.mark.parametrize("hurst", [0.1, 0.5, 0.95])
@pytest.mark.parametrize("crop", [False, True])
def test_the_exponent_of_a_generated_surface_is_recovered(hurst, crop):
    fit = hurst_exponent(gaussian(512, hurst, 5, crop))
    assert fit.hurst == pytest.approx(hurst, abs=0.03)
    assert fit.hurst == pytest.approx(hurst, abs=4 * fit.standard_error)
    # Independent waves: pi/4 of n^2/2, fewer under a window by (35/18)^2; ln q scatters by 1/2 over a disc.
    waves = math.pi / 8 * 512**2 / ((35 / 18) ** 2 if crop else 1)
    assert fit.standard_error == pytest.approx(0.5 / (0.5 * math.sqrt(waves)), rel=0.02)
    assert 0.5 < fit.misfit < 2


@pytest.mark.parametrize(("hurst", "crop"), [(0.3, False), (0.1, True), (0.95, True)])
def test_the_standard_error_is_honest(hurst, crop):
    """100 seeds: an interval of 68.3 % holds the truth 68.3 +- 4.7 times; the scores have rms 1 +- 0.071.

    The bounds lie 2.8 of these away.
    """
    fits = [hurst_exponent(gaussian(128, hurst, 7000 + seed, crop), limit="none") for seed in range(100)]
    scores = np.array([(fit.hurst - hurst) / fit.standard_error for fit in fits])
    assert 55 <= (np.abs(scores) < 1).sum() <= 81
    assert 0.8 < np.sqrt(np.mean(scores**2)) < 1.2
    assert abs(scores.mean()) < 0.28


@pytest.mark.parametrize("hurst", [0.3, 0.8])
def test_ends_of_periodic_surfaces(hurst):
    """A limit lies between the last wave without and the first wave with the law, 1/6.4 apart."""
    cut = hurst_exponent(gaussian(256, hurst, 1, cutoff_wavelength=40e-6))
    assert 256e-6 / 6.4 * 0.97 < cut.cutoff_wavelength < 256e-6 / 6.08
    short = hurst_exponent(gaussian(256, hurst, 1, short_wavelength=8e-6))
    assert 256e-6 / 33 < short.short_wavelength <= 8e-6
    assert short.hurst == pytest.approx(hurst, abs=4 * short.standard_error)
    rolled = hurst_exponent(gaussian(256, hurst, 1, rolloff_wavelength=40e-6))
    # 64 independent waves in the plateau know its level to 1/8, and through the slope its end to 1/8/(2H + 2).
    assert math.log(rolled.rolloff_wavelength / 40e-6) == pytest.approx(0, abs=4 / 8 / (2 * hurst + 2))
    assert rolled.hurst == pytest.approx(hurst, abs=4 * rolled.standard_error)


def test_ends_of_cut_out_surfaces():
    """Under a window a limit is known to a wave or so."""
    short = hurst_exponent(gaussian(256, 0.6, 1, True, short_wavelength=8e-6))
    assert 256e-6 / short.short_wavelength == pytest.approx(32, abs=1)
    assert short.hurst == pytest.approx(0.6, abs=4 * short.standard_error)
    cut = hurst_exponent(gaussian(256, 0.6, 1, True, cutoff_wavelength=40e-6))
    assert 256e-6 / cut.cutoff_wavelength == pytest.approx(6.4, abs=1)
    assert cut.hurst == pytest.approx(0.6, abs=4 * cut.standard_error)


def test_a_line_has_an_exponent_too():
    surface = gaussian(1024, 0.7, 2)
    row = rc.Surface(surface.heights[17], rc.Grid(1024, 1e-6, True))
    fit = hurst_exponent(
        row, limit="none", q_max=2 * math.pi / 20e-6
    )  # where the cut of a band is still a law
    assert fit.kind == "C1D"
    assert fit.hurst == pytest.approx(0.7, abs=4 * fit.standard_error)


def test_bands_without_data_are_refused():
    spectrum = exact(lambda q: q**-3.0)
    with pytest.raises(ValueError, match="four bins"):
        fit_spectrum(spectrum, q_min=1e3, q_max=1.05e3)
    with pytest.raises(ValueError, match="limit must be"):
        fit_spectrum(spectrum, limit="both")
