import math

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.analysis.cut import cut_factor, profile_spectrum, surface_spectrum
from roughcontact.surface.analysis.power import PowerSpectrum
from roughcontact.surface.analysis.spectra import power_spectrum


def spectrum(q, density, kind):
    full = np.full(q.shape, 100.0)
    return PowerSpectrum(q, density, kind, 2 * full, full, q[0], q[-1])


def test_the_factor_of_a_cut():
    assert cut_factor(1.0) == pytest.approx(math.pi / 2, rel=1e-14)
    assert cut_factor(0.7) == pytest.approx(1.79104, abs=5e-6)
    assert cut_factor(0.5) == pytest.approx(2.0, rel=1e-14)
    with pytest.raises(ValueError, match="above -1/2"):
        cut_factor(-0.5)


@pytest.mark.parametrize("hurst", [0.1, 0.7])
def test_a_power_law_goes_there_and_back(hurst):
    q = np.geomspace(1.0, 1e3, 100)
    surface = spectrum(q, q ** (-2 * hurst - 2), "C2D")
    line = spectrum(q, cut_factor(hurst) * q ** (-2 * hurst - 1), "C1D")
    for method in ("law", "abel"):
        np.testing.assert_allclose(surface_spectrum(line, method=method).density, surface.density, rtol=1e-6)
    # The cut of a law that ends at q1 lacks int_q1^inf: of relative size (k/q1)^(2H + 1) by and large.
    cut = profile_spectrum(surface)
    low = np.flatnonzero(q < 10)
    lack = 2 / cut_factor(hurst) / (2 * hurst + 1) * (q[low] / q[-1]) ** (2 * hurst + 1)
    assert (np.abs(cut.density[low] / line.density[low] - 1) < 1.01 * lack + 1e-6).all()


def test_a_gaussian_spectrum_goes_there_and_back():
    """C2D = exp(-q^2), C1D = sqrt(pi) exp(-k^2): no law at all.

    Between bins that are w apart in ln q, a power law misses ln C by up to w^2/8 of its curvature 4 q^2.
    """
    q = np.geomspace(0.01, 3.5, 600)
    width = math.log(350) / 599
    error = 1.5 * width**2 / 8 * 4 * 3.5**2
    surface, line = (
        spectrum(q, np.exp(-(q**2)), "C2D"),
        spectrum(q, math.sqrt(math.pi) * np.exp(-(q**2)), "C1D"),
    )
    inner = q < 2  # beyond it the end of the band shows: exp(-3.5^2 + 2^2) is 3e-4
    np.testing.assert_allclose(
        profile_spectrum(surface).density[:, None][: inner.sum(), 0], line.density[inner], rtol=error + 3e-4
    )
    back = surface_spectrum(line, method="abel")
    np.testing.assert_allclose(back.density[inner], surface.density[inner], rtol=20 * error + 3e-3)


def test_the_surface_behind_one_line_scan():
    """A line has one wave a wavenumber: its densities scatter by their own size, their mean over a decade by 1/sqrt."""
    n = 2048
    grid = rc.Grid((n, n), 1e-6, True)
    surface = rc.self_affine(grid, 0.6, 1e-6, np.random.default_rng(1), amplitudes="gaussian")
    rings = power_spectrum(surface).within(2e4, 2e5)
    scan = rc.Surface(surface.heights[100], rc.Grid(n, 1e-6, True))
    guess = surface_spectrum(power_spectrum(scan).within(2e4, 2e5), hurst=0.6)
    assert guess.kind == "C2D"
    ratio = np.mean(guess.density / np.interp(guess.wavenumber, rings.wavenumber, rings.density))
    assert ratio == pytest.approx(1, abs=4 / math.sqrt(guess.density.size))


def test_wrong_kinds_and_noise_are_refused():
    q = np.geomspace(1, 10, 20)
    with pytest.raises(ValueError, match="already"):
        profile_spectrum(spectrum(q, q**-2, "C1D"))
    with pytest.raises(ValueError, match="already"):
        surface_spectrum(spectrum(q, q**-2, "C2D"))
    jagged = q**-2 * np.where(np.arange(20) % 2, 1, 1e-3)
    with pytest.raises(ValueError, match="coarser bins"):
        surface_spectrum(spectrum(q, jagged, "C1D"), method="abel")
    with pytest.raises(ValueError, match="method must be"):
        surface_spectrum(spectrum(q, q**-2, "C1D"), method="fourier")
