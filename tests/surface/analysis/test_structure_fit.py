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
    smallest = fit_structure(gaussian(32, hurst, 5, crop))
    assert smallest.hurst == pytest.approx(hurst, abs=4 * smallest.standard_error)
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


@pytest.mark.parametrize("hurst", [0.3, 0.95])
def test_the_standard_error_is_that_of_the_waves_one_by_one(hurst):
    """The information about H in the structure function of a periodic grid, by sums over its waves."""
    n, step = 64, 1e-4
    fit = fit_structure(rc.self_affine(rc.Grid((n, n), 1.0, True), hurst, 1.0, np.random.default_rng(0)))
    lags = np.tile(np.unique(np.geomspace(1, n // 8, 22).round()), 2)
    is_y = np.arange(lags.size) >= lags.size // 2
    q = 2 * np.pi * np.fft.fftfreq(n)
    along = np.where(is_y[:, None, None], q[:, None], q)
    jumps = 1 - np.cos(along * lags[:, None, None])
    length = np.hypot(q[:, None], q)
    length[0, 0] = np.inf
    nyquist = np.zeros((n, n), dtype=bool)
    nyquist[n // 2] = nyquist[:, n // 2] = True
    power = (2 * np.pi / n) ** 2 * length ** (-2 * hurst - 2)
    steeper = power * length ** (-2 * step)
    free = jumps * np.where(nyquist, 0, power)
    structure = 2 * free.sum(axis=(1, 2))
    slope = 2 * (jumps * np.where(nyquist, 0, steeper)).sum(axis=(1, 2)) / structure - 1
    gradient = np.stack([np.ones(lags.size), slope / step], axis=1)
    # <h_q^2 h_q'^2> of exponential powers; each wave and its opposite are one.
    covariance = 8 * np.einsum("ayx,byx->ab", free, free) / np.outer(structure, structure)
    trends = [lags**order * (is_y == axis) for order in (2, 4) for axis in (0, 1)]
    trends.append((jumps * np.where(nyquist, power, 0)).sum(axis=(1, 2)))
    loose = np.stack(trends, axis=1) / structure[:, None]
    loose /= np.linalg.norm(loose, axis=0)
    covariance += 1e2 * loose @ loose.T + 1e-10 * np.eye(lags.size)
    information = gradient.T @ np.linalg.solve(covariance, gradient)
    expected = math.sqrt(np.linalg.inv(information)[1, 1])
    # With exact amplitudes H is all but the true one. The integrals reach half a wave further than the sums: a rim of
    # 2/n of the waves, of which the free Nyquist waves should take at least half.
    assert fit.standard_error == pytest.approx(expected, rel=0.5 / n)


@pytest.mark.parametrize(("hurst", "crop"), [(0.6, False), (0.95, True)])
def test_the_standard_error_is_honest(hurst, crop):
    """25 seeds: the scores have rms 1 +- 0.14, the mean misfit is 1 +- 0.07: three of each."""
    fits = [fit_structure(gaussian(96, hurst, 300 + seed, crop)) for seed in range(25)]
    scores = np.array([(fit.hurst - hurst) / fit.standard_error for fit in fits])
    assert 0.58 < np.sqrt(np.mean(scores**2)) < 1.42
    # 2 times 11 lags, less 2 parameters and 5 trends.
    assert np.mean([fit.misfit for fit in fits]) == pytest.approx(1, abs=3 * math.sqrt(2 / 15 / 25))


@pytest.mark.parametrize(("noise", "holds"), [(0.1, True), (0.2, False)])
def test_a_misfit_beyond_chance_raises_the_error(noise, holds):
    """White noise, in units of the steps between neighbours: it lowers H by 0.15 at most, by that the error by 1 %."""
    surface = gaussian(96, 0.8, 1)
    added = noise * np.diff(surface.heights).std() * np.random.default_rng(2).standard_normal((96, 96))
    clean, noisy = fit_structure(surface), fit_structure(rc.Surface(surface.heights + added, surface.grid))
    # chi^2 of 15 degrees of freedom exceeds 37.7 once in a thousand times.
    assert (noisy.misfit < 37.7 / 15) == holds
    factor = 1 if holds else math.sqrt(noisy.misfit)
    assert noisy.standard_error == pytest.approx(factor * clean.standard_error, rel=0.02)


@pytest.mark.parametrize("limit", ["rolloff", "long_cutoff"])
@pytest.mark.parametrize("crop", [False, True])
def test_long_waves_may_end(limit, crop):
    """The level of S beyond the limit is an average over some (256/40)^2 pi/2 = 64 waves, known to 1/8."""
    surface = gaussian(256, 0.6, 4, crop, **{limit: 40e-6})
    fit = fit_structure(surface, limit=limit)
    assert getattr(fit, limit) == pytest.approx(40e-6, rel=4 / 8 / (2 * 0.6))
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
