"""Power laws of ensembles in which samples are missing; tests/mdr/test_line_curves.py has the whole ones."""

import numpy as np
import pytest

from roughcontact.statistics.ensemble_fit import fit_ensemble, law_error

FORCE = np.geomspace(1e-3, 0.1, 12)
RNG = np.random.default_rng(5)
STIFFNESS = 0.9 * FORCE**0.6 * np.exp(RNG.normal(0, 0.3, (40, 1)) + RNG.normal(0, 0.1, (40, 12)))


@pytest.mark.parametrize("mean", ["arithmetic", "geometric"])
class TestMissing:
    def test_samples_are_as_if_they_had_never_been(self, mean):
        holed = np.concatenate([STIFFNESS[:15], np.full((3, 12), np.nan), STIFFNESS[15:]])
        assert fit_ensemble(FORCE, holed, (1.0, 2.0), mean) == fit_ensemble(
            FORCE, STIFFNESS, (1.0, 2.0), mean
        )

    def test_points_leave_the_means_of_the_others(self, mean):
        holed = STIFFNESS.copy()
        holed[4, :6] = holed[9, 3] = np.nan
        fit = fit_ensemble(FORCE, holed, (1.0, 1.0), mean)
        logs = (
            np.log(np.nanmean(holed, axis=0)) if mean == "arithmetic" else np.nanmean(np.log(holed), axis=0)
        )
        slope, offset = np.polyfit(np.log(FORCE), logs, 1)
        assert fit.exponent == pytest.approx(slope, rel=1e-12)
        assert np.log(fit.prefactor) == pytest.approx(offset, rel=1e-11)
        assert fit.samples == 40

    def test_points_leave_errors_that_the_jackknife_finds(self, mean):
        holed = STIFFNESS.copy()
        holed[4, :6] = holed[9, 3] = np.nan
        fits = [fit_ensemble(FORCE, np.delete(holed, i, axis=0), (1.0, 1.0), mean) for i in range(40)]
        # Leaving out one of n differs from an infinitesimal change by terms of order 1/n.
        error = np.sqrt(39**2 / 40 * np.var([f.exponent for f in fits], ddof=1))
        assert fit_ensemble(FORCE, holed, (1.0, 1.0), mean).exponent_error == pytest.approx(error, rel=2 / 40)


def test_the_error_of_a_law_is_that_of_a_sum_of_correlated_numbers():
    pairs = np.random.default_rng(2).multivariate_normal([0, 0], [[0.04, 0.09], [0.09, 0.25]], 100_000)
    x = np.log(0.02)
    # A standard deviation of n numbers is known to 1/sqrt(2 n), 0.22 %.
    drawn = (pairs[:, 0] * x + pairs[:, 1]).std()
    assert law_error(x, 0.2, 0.5, 0.09 / (0.2 * 0.5)) == pytest.approx(drawn, rel=0.01)
    assert law_error(-2.5, 0.2, 0.5, 1.0) == 0
