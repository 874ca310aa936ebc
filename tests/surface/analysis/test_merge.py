import numpy as np
import pytest

import roughcontact as rc
from roughcontact.surface.analysis.merge import merge_spectra, spectra_ratio
from roughcontact.surface.analysis.power import PowerSpectrum
from roughcontact.surface.analysis.spectra import power_spectrum


def law(low, high, factor=1.0, freedom=50.0, kind="C2D"):
    q = np.geomspace(low, high, 200)
    full = np.full(q.shape, freedom)
    return PowerSpectrum(q, factor * q**-3.5, kind, 2 * full, full, low, high)


def test_two_bands_of_one_law_make_one_law():
    merged = merge_spectra([law(1e2, 1e4), law(1e3, 1e6)], per_decade=50)
    assert (merged.q_min, merged.q_max) == (1e2, 1e6)
    assert merged.freedom.sum() == pytest.approx(2 * 200 * 50)
    # A bin of a fiftieth decade spans 0.046 in ln q, so that the variance in it is at most 0.046^2/4: the mean of
    # exp(-3.5 x) exceeds its value at the mean by half of 3.5^2 times that, 3.3e-3.
    np.testing.assert_allclose(merged.density * merged.wavenumber**3.5, 1, rtol=3.3e-3)
    assert (np.diff(merged.wavenumber) > 0).all()


def test_overlap_is_weighted_by_what_is_known():
    one, other = law(1e3, 1e4, 1.0, freedom=30), law(1e3, 1e4, 2.0, freedom=10)
    merged = merge_spectra([one, other], per_decade=1e4)
    np.testing.assert_allclose(merged.density * merged.wavenumber**3.5, 1.25, rtol=1e-9)
    np.testing.assert_allclose(merged.freedom, 40)


def test_bands_cut_what_is_not_reliable():
    wide = law(1e2, 1e5)
    merged = merge_spectra([wide.within(1e3, 1e4)])
    assert 1e3 <= merged.wavenumber[0] < merged.wavenumber[-1] <= 1e4


def test_the_ratio_tells_two_surfaces_apart():
    ratio, error = spectra_ratio(law(1e2, 1e4), law(1e3, 1e6))
    # Bins of a tenth decade weigh their 5 waves (200 over 2 and 200 over 3 decades) at different places.
    assert ratio == pytest.approx(1, abs=0.1)
    double, _ = spectra_ratio(law(1e2, 1e4, 2.0), law(1e3, 1e6))
    assert double == pytest.approx(2 * ratio, rel=1e-12)
    assert 0 < error < 0.2


def test_three_instruments_see_one_surface():
    """A map, and two maps of a quarter of it at its own and at half the resolution: one spectrum."""
    n = 512
    surface = rc.self_affine(
        rc.Grid((n, n), 1e-6, True), 0.7, 1e-6, np.random.default_rng(0), amplitudes="gaussian"
    )
    whole = power_spectrum(surface)
    part = power_spectrum(rc.Surface(surface.heights[:256, :256], rc.Grid((256, 256), 1e-6)))
    ratio, error = spectra_ratio(part, whole)
    assert ratio == pytest.approx(1, abs=4 * error)
    merged = merge_spectra([whole.within(None, 1e6), part.within(5e5, None)])
    expected = np.interp(np.log(merged.wavenumber), np.log(whole.wavenumber), np.log(whole.density))
    scatter = 1 / np.sqrt(merged.freedom) + 1 / np.sqrt(
        np.interp(merged.wavenumber, whole.wavenumber, whole.freedom)
    )
    assert (np.abs(np.log(merged.density) - expected) < 5 * scatter).all()


def test_what_does_not_fit_together_is_refused():
    with pytest.raises(ValueError, match="no spectrum"):
        merge_spectra([])
    with pytest.raises(ValueError, match="cannot be merged"):
        merge_spectra([law(1, 10), law(1, 10, kind="C1D")])
    with pytest.raises(ValueError, match="do not overlap"):
        spectra_ratio(law(1, 10), law(20, 100))
