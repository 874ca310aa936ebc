"""Draws of a posterior distribution, against the closed form of normal distributions and against its limits."""

import math

import numpy as np
import pytest
import scipy.integrate

from roughcontact.measurement.importance import Posterior, Prior, posterior

INF = math.inf
WIDE = Prior(*np.array([[0.0, INF, -8.0, 8.0], [1.0, 0.5, -4.0, 6.0]]).T)


def likelihood(centre, sd, direction):
    return lambda points: -0.5 * ((points @ direction - centre) / sd) ** 2


@pytest.mark.parametrize("sd", [0.3, 1e-3])
def test_a_normal_posterior_has_its_mean_its_deviation_and_its_information(sd):
    """y = a + b with a uniform and b normal: b keeps its prior, a is y - b, and a + b is known to sd.

    The effective number of draws is at least 2000, hence 4.5 standard errors of 1/sqrt(2000) of a deviation each.
    """
    found = posterior(WIDE, likelihood(2.0, sd, np.array([1.0, 1.0])), np.random.default_rng(1))
    assert found.effective > 2000
    a, b = found.points.T
    bound = 4.5 / math.sqrt(2000)
    for values, mean, deviation in ((a + b, 2.0, sd), (b, 1.0, 0.5), (a, 1.0, math.hypot(0.5, sd))):
        middle = found.weights @ values
        assert middle == pytest.approx(mean, abs=bound * deviation)
        spread = math.sqrt(found.weights @ (values - middle) ** 2)
        assert spread == pytest.approx(deviation, rel=bound)
    assert found.quantiles(b, np.array([0.5]))[0] == pytest.approx(1.0, abs=1.26 * bound * 0.5)
    nats = found.nats(WIDE)
    deviation = math.hypot(0.5, sd)  # a normal distribution within a uniform one of width 16
    assert nats[0] == pytest.approx(math.log(16 / deviation) - 0.5 * math.log(2 * math.pi * math.e), abs=0.03)
    assert nats[1] == pytest.approx(0, abs=0.03)


def test_densities_are_normalised_and_draws_follow_them():
    prior = Prior(*np.array([[0.0, INF, -1.0, 3.0], [1.0, 0.5, 0.8, 2.0]]).T)
    grids = np.meshgrid(np.linspace(-1.5, 3.5, 1001), np.linspace(0.5, 2.2, 1001), indexing="ij")
    points = np.stack([grid.ravel() for grid in grids], axis=1)
    cell = 5 / 1000 * 1.7 / 1000
    # Each of four ends falls between points of the sums, which are off by a cell of the density there.
    assert np.exp(prior.log_density(points)).sum() * cell == pytest.approx(
        1, abs=2 * (5e-3 / 4 + 1.7e-3 * 1.2)
    )
    uniform = np.random.default_rng(2).random((1000, 2))
    drawn = prior.draw(uniform)
    assert np.isfinite(prior.log_density(drawn)).all()
    np.testing.assert_allclose(prior.share_below(drawn), uniform, atol=1e-12)


def test_a_posterior_at_a_limit_stays_inside():
    prior = Prior(*np.array([[0.0, INF, 0.0, 1.0]]).T)
    found = posterior(prior, likelihood(1.5, 0.1, np.array([1.0])), np.random.default_rng(3))
    assert found.points.max() <= 1
    # Below the limit, at 1 - v, the density is exp(-50 v - 50 v^2).
    moments = [
        scipy.integrate.quad(lambda v, n=n: v**n * math.exp(-50 * v * (1 + v)), 0, 1)[0] for n in (0, 1)
    ]
    bound = 4.5 / math.sqrt(found.effective)  # of its standard deviation, which is at most the mean
    assert 1 - found.weights @ found.points[:, 0] == pytest.approx(moments[1] / moments[0], rel=bound)


def test_information_of_a_prior_that_returns_is_zero():
    points = WIDE.draw(np.random.default_rng(4).random((20000, 2)))
    same = Posterior(points, np.full(len(points), 1 / len(points)))
    # The sum of 128 squares over 2 * 20000 has the standard deviation sqrt(2 * 127)/40000 = 4e-4.
    assert (same.nats(WIDE) < 5 * 4e-4).all()
