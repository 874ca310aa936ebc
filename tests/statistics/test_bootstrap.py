"""Resampled laws against a loop that does what the words say, and intervals against Student's."""

import numpy as np
import pytest
from scipy import stats

from roughcontact.statistics.bootstrap import counts_of, interval, resampled_laws

RNG = np.random.default_rng(8)


class TestCounts:
    def test_as_many_are_drawn_as_are_there(self):
        there = np.array([True, False, True, True, False])
        counts = counts_of(RNG.random((2000, 5)), there)
        assert (counts.sum(axis=1) == 3).all()
        assert (counts[:, ~there] == 0).all()
        # Of 3 draws with chance 1/3 each: mean 1, variance 2/3; five standard errors of 2000.
        np.testing.assert_allclose(counts[:, there].mean(axis=0), 1, atol=5 * np.sqrt(2 / 3 / 2000))
        np.testing.assert_allclose(counts[:, there].var(axis=0), 2 / 3, atol=0.15)

    def test_the_same_numbers_draw_the_same_samples(self):
        uniform = RNG.random((50, 7))
        np.testing.assert_array_equal(
            counts_of(uniform, np.ones(7, bool)), counts_of(uniform, np.ones(7, bool))
        )


def slow(force, stiffness, counts, mean):
    """Return alpha and ln zeta of each replicate, one after the other, without what is missing."""
    laws = []
    for each in counts.astype(int):
        drawn = np.repeat(stiffness, each, axis=0)
        there = ~np.isnan(drawn).all(axis=0)
        if mean == "arithmetic":
            logs = np.log(np.nanmean(drawn[:, there], axis=0))
        else:
            logs = np.nanmean(np.log(drawn[:, there]), axis=0)
        laws.append(np.polyfit(np.log(force[there]), logs, 1))
    return np.array(laws)


@pytest.mark.parametrize("mean", ["arithmetic", "geometric"])
@pytest.mark.parametrize("missing", [False, True])
def test_laws_are_those_of_the_drawn_curves(mean, missing):
    force = np.geomspace(1e-3, 0.07, 9)
    stiffness = 0.8 * force**0.6 * RNG.lognormal(0, 0.3, (6, 9))
    if missing:  # at the second force but one sample is there, and a third of the replicates lack it
        stiffness[:5, 1] = stiffness[2, 4] = np.nan
    counts = counts_of(RNG.random((40, 6)), np.ones(6, bool))
    found = resampled_laws(np.log(force), stiffness, counts, mean)
    np.testing.assert_allclose(found, slow(force, stiffness, counts, mean), rtol=1e-10, atol=1e-12)


class TestInterval:
    def test_of_many_samples_is_that_of_the_percentiles(self):
        values = RNG.normal(size=(500, 2))
        # Student's t of a million degrees of freedom is normal to 1e-6.
        found = interval(values, 0.9, 1_000_000)
        np.testing.assert_allclose(found, np.quantile(values, [0.05, 0.95], axis=0), atol=1e-4)

    @pytest.mark.parametrize("samples", [5, 20])
    def test_of_normal_means_is_students(self, samples):
        data = RNG.normal(size=samples)
        # The replicates of a mean scatter by the standard deviation with n over the root of n.
        values = stats.norm.ppf(
            (np.arange(200_000) + 0.5) / 200_000, data.mean(), data.std() / np.sqrt(samples)
        )
        expected = stats.t.interval(0.95, samples - 1, data.mean(), stats.sem(data))
        # Between the outermost 1e-3 of the values a quantile is off by a ten thousandth of the width.
        np.testing.assert_allclose(interval(values, 0.95, samples), expected, atol=2e-3 * stats.sem(data))

    def test_of_one_sample_or_of_none_there_is_none(self):
        assert np.isnan(interval(np.ones((5, 2)), 0.95, 1)).all()
        assert np.isnan(interval(np.ones((0, 2)), 0.95, 4)).all()
