import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.analysis.structure_fit import fit_structure


def gaussian(n, hurst, seed, crop=False, **limits):
    size = 2 * n if crop else n
    rng = np.random.default_rng(seed)
    whole = rc.self_affine(
        rc.Grid((size, size), 1e-6, True), hurst, 1e-6, rng, amplitudes="gaussian", **limits
    )
    return rc.Surface(whole.heights[:n, :n], rc.Grid((n, n), 1e-6)) if crop else whole


@pytest.mark.parametrize("hurst", [0.1, 0.5, 0.95])
@pytest.mark.parametrize("crop", [False, True])
def test_the_exponent_of_a_generated_surface_is_recovered(hurst, crop):
    fit = fit_structure(gaussian(256, hurst, 5, crop))
    assert fit.hurst == pytest.approx(hurst, abs=0.03)
    assert fit.hurst == pytest.approx(hurst, abs=4 * fit.standard_error)
    # No estimate can do better than the likelihood of its waves, see test_hurst: n^2/2 in the whole square.
    assert fit.standard_error > 0.9 / math.sqrt(256**2 / 2)


def test_the_law_has_the_density_of_the_spectrum():
    """With exact amplitudes C2D is known: rms^2 over the sum of q^(-2H - 2), thesis, eq. 2.14."""
    n, hurst = 128, 0.6
    surface = rc.self_affine(rc.Grid((n, n), 1e-6, True), hurst, 1e-6, np.random.default_rng(0))
    k = np.fft.fftfreq(n, 1 / n)
    squares = (k[:, None] ** 2 + k**2)[np.ix_(np.abs(k) < n / 2, np.abs(k) < n / 2)]
    lattice = (squares[squares > 0] ** -(hurst + 1)).sum()
    density = 1e-12 / lattice * (n * 1e-6 / (2 * math.pi)) ** 2  # at the longest wave
    fit = fit_structure(surface)
    q = 2 * math.pi / 20e-6
    expected = density * (q * n * 1e-6 / (2 * math.pi)) ** (-2 * hurst - 2)
    # The structure function has no noise; what is left is the integral in place of the sum over waves.
    assert float(fit(q)) == pytest.approx(expected, rel=0.02)
    assert fit.hurst == pytest.approx(hurst, abs=0.005)


@pytest.mark.parametrize("crop", [False, True])
def test_the_standard_error_is_honest(crop):
    """25 seeds: the scores have rms 1 +- 0.14; the bounds lie three of these away."""
    fits = [fit_structure(gaussian(96, 0.6, 300 + seed, crop)) for seed in range(25)]
    scores = np.array([(fit.hurst - 0.6) / fit.standard_error for fit in fits])
    assert 0.58 < np.sqrt(np.mean(scores**2)) < 1.42


@pytest.mark.parametrize("limit", ["rolloff", "cutoff"])
@pytest.mark.parametrize("crop", [False, True])
def test_long_waves_may_end(limit, crop):
    """The level of S beyond the limit is an average over some (256/40)^2 pi/2 = 64 waves, known to 1/8."""
    surface = gaussian(256, 0.6, 4, crop, **{f"{limit}_wavelength": 40e-6})
    fit = fit_structure(surface, limit=limit)
    assert getattr(fit, f"{limit}_wavelength") == pytest.approx(40e-6, rel=4 / 8 / (2 * 0.6))
    assert fit.hurst == pytest.approx(0.6, abs=4 * fit.standard_error)


def test_missing_points_do_no_harm():
    surface = gaussian(128, 0.6, 9)
    heights = surface.heights.copy()
    heights[30:50, 70:90] = np.nan  # 2.4 % of the surface
    whole, holed = fit_structure(surface), fit_structure(rc.Surface(heights, surface.grid))
    assert holed.hurst == pytest.approx(whole.hurst, abs=whole.standard_error)
    assert holed.hurst != whole.hurst


def test_what_cannot_be_fitted_is_refused():
    with pytest.raises(ValueError, match="32 x 32"):
        fit_structure(rc.Surface(np.zeros((8, 8)), rc.Grid((8, 8), 1.0)))
    with pytest.raises(ValueError, match="flat"):
        fit_structure(rc.Surface(np.zeros((64, 64)), rc.Grid((64, 64), 1.0)))
    with pytest.raises(ValueError, match="five lags"):
        fit_structure(gaussian(64, 0.5, 0), lags=np.array([1, 2, 3]))
