"""Means over samples, some of which are missing."""

import numpy as np
import pytest

from roughcontact.statistics.ensemble_mean import mean_over_samples, shares_of_samples

VALUES = np.random.default_rng(1).lognormal(size=(6, 9))
MEANS = {"arithmetic": np.nanmean, "geometric": lambda v, axis: np.exp(np.nanmean(np.log(v), axis=axis))}


def holed():
    """Return values of which some are missing, and at the last point all."""
    values = VALUES.copy()
    values[0, :4] = values[3, 2] = np.nan
    values[:, -1] = np.nan
    return values


@pytest.mark.parametrize("mean", MEANS)
class TestMean:
    def test_is_that_of_what_is_there(self, mean):
        values = holed()
        found = mean_over_samples(values, mean)
        np.testing.assert_allclose(found[:-1], MEANS[mean](values[:, :-1], axis=0), rtol=1e-14)
        assert np.isnan(found[-1])

    def test_counts_samples_as_often_as_it_is_told(self, mean):
        values = holed()[:, :-1]
        counts = np.array([[2, 0, 1, 3, 0, 0], [1, 1, 1, 1, 1, 1]])
        found = mean_over_samples(values, mean, counts)
        repeated = np.repeat(values, counts[0], axis=0)
        np.testing.assert_allclose(found[0], MEANS[mean](repeated, axis=0), rtol=1e-14)
        np.testing.assert_allclose(found[1], mean_over_samples(values, mean), rtol=1e-14)

    def test_of_samples_that_are_not_drawn_is_none(self, mean):
        values = holed()
        assert np.isnan(mean_over_samples(values, mean, np.eye(6)[0])[:4]).all()

    def test_shares_add_up_to_nothing(self, mean):
        shares = shares_of_samples(holed()[:, :-1], mean)
        # Six numbers of order one, each rounded.
        np.testing.assert_allclose(shares.sum(axis=0), 0, atol=6 * 4e-16)
        assert (shares[0, :4] == 0).all()

    def test_shares_are_the_derivatives_of_the_logarithm_of_the_mean(self, mean):
        values = holed()[:, :-1]
        shares = shares_of_samples(values, mean)
        step = 1e-6  # the second derivative times it is what remains
        for sample in range(6):
            counts = np.ones(6)
            counts[sample] += step
            change = np.log(mean_over_samples(values, mean, counts) / mean_over_samples(values, mean))
            np.testing.assert_allclose(6 * change / step, shares[sample], atol=1e-4)


def test_a_zero_makes_the_geometric_mean_zero_and_less_than_zero_makes_it_none():
    values = np.array([[0.0, -1.0, 2.0], [3.0, 3.0, 8.0]])
    np.testing.assert_array_equal(mean_over_samples(values, "geometric")[:2], [0, np.nan])
    assert mean_over_samples(values, "geometric")[2] == pytest.approx(4, rel=1e-15)
    # A sample that does not count has no say.
    assert mean_over_samples(values, "geometric", np.array([0, 1]))[0] == pytest.approx(3, rel=1e-15)


def test_of_another_kind_is_refused():
    with pytest.raises(ValueError, match="'arithmetic' or 'geometric', not 'harmonic'"):
        mean_over_samples(VALUES, "harmonic")
