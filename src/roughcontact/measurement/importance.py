"""Draws from a posterior distribution, by importance sampling that adapts its proposal."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import scipy.optimize
import scipy.special
import scipy.stats

from roughcontact.errors import InputError
from roughcontact.validation import Array

__all__ = ["Posterior", "Prior", "posterior"]

ROUNDS, DRAWS = 5, 2048
TAILS = 5  # degrees of freedom of the proposals
WIDER = 1.3  # proposals than what they are fitted to
KEPT = 0.02  # effective share of the draws that a proposal is fitted to


@dataclass(frozen=True, slots=True, eq=False)
class Prior:
    """Independent normal distributions, cut off at limits; with an infinite standard deviation uniform.

    Attributes
    ----------
    mean, deviation : array, shape (k,)
    low, high : array, shape (k,)
        Finite.
    """

    mean: Array
    deviation: Array
    low: Array
    high: Array

    def log_density(self, points: Array) -> Array:
        """Return the logarithm of the density at points of shape (m, k), shape (m,)."""
        edges = [(end - self.mean) / self.deviation for end in (self.low, self.high)]
        flat = np.isinf(self.deviation)
        with np.errstate(divide="ignore"):
            shares = np.log(scipy.special.ndtr(edges[1]) - scipy.special.ndtr(edges[0]))
        scale = np.where(
            flat,
            np.log(self.high - self.low),
            shares + np.log(np.where(flat, 1, self.deviation)) + math.log(2 * math.pi) / 2,
        )
        inside = ((points >= self.low) & (points <= self.high)).all(axis=1)
        values = -(((points - self.mean) / self.deviation) ** 2).sum(axis=1) / 2 - scale.sum()
        return np.where(inside, values, -np.inf)

    def draw(self, uniform: Array) -> Array:
        """Return points for numbers between 0 and 1, both of shape (m, k)."""
        flat = np.isinf(self.deviation)
        scale = np.where(flat, 1, self.deviation)
        edges = [scipy.special.ndtr((end - self.mean) / scale) for end in (self.low, self.high)]
        normal = self.mean + scale * scipy.special.ndtri(edges[0] + uniform * (edges[1] - edges[0]))
        return np.where(flat, self.low + uniform * (self.high - self.low), normal)

    def share_below(self, points: Array) -> Array:
        """Return the distribution functions at points, both of shape (m, k)."""
        flat = np.isinf(self.deviation)
        scale = np.where(flat, 1, self.deviation)
        low, at, high = (scipy.special.ndtr((x - self.mean) / scale) for x in (self.low, points, self.high))
        return np.where(flat, (points - self.low) / (self.high - self.low), (at - low) / (high - low))


@dataclass(frozen=True, slots=True, eq=False)
class Posterior:
    """Weighted draws.

    Attributes
    ----------
    points : array, shape (m, k)
    weights : array, shape (m,)
        Their sum is 1.
    """

    points: Array
    weights: Array

    @property
    def effective(self) -> float:
        """The number of equally weighted draws that would be as good."""
        return 1 / float((self.weights**2).sum())

    def quantiles(self, values: Array, shares: Array) -> Array:
        """Return quantiles of a number of each draw, values of shape (m,)."""
        order = np.argsort(values)
        below = np.cumsum(self.weights[order]) - self.weights[order] / 2
        return np.interp(shares, below, values[order])

    def nats(self, prior: Prior, bins: int = 128) -> Array:
        """Return the information gained over the prior in each parameter, the divergence of Kullback and Leibler."""
        shares = prior.share_below(self.points)
        found = []
        for share in shares.T:
            p = np.bincount(np.minimum((share * bins).astype(int), bins - 1), self.weights, bins)
            held = p[p > 0]
            # Scatter of the draws in the bins adds half of a degree of freedom each.
            bias = (held.size - 1) / (2 * self.effective)
            found.append(float((held * np.log(held * bins)).sum()) - bias)
        return np.maximum(found, 0)


def posterior(prior: Prior, log_likelihood: Callable[[Array], Array], rng: np.random.Generator) -> Posterior:
    """Return draws of the posterior distribution.

    The first draws are those of the prior. Each further proposal is a distribution of Student with mean and covariance
    of all earlier draws; all draws are weighted by the mixture of all proposals (Cornuet and others 2012).

    Raises
    ------
    InputError
        If the likelihood of all draws of the prior is zero.
    """
    k = prior.mean.size
    uniform = scipy.stats.qmc.Sobol(k, rng=rng).random(4 * DRAWS)
    points = prior.draw(uniform)
    densities: list[Callable[[Array], Array]] = [prior.log_density]
    sizes = [len(points)]
    target = _target(prior, log_likelihood, points)
    if not np.isfinite(target).any():
        raise InputError(
            "no joint that is possible beforehand has been computed at these pressures",
            "give larger errors of the topography, or other pressures",
        )
    for _ in range(ROUNDS):
        weights = _tempered(target - _mixture(densities, sizes, points))
        mean = weights @ points
        deviation = points - mean
        covariance = WIDER**2 * (weights * deviation.T) @ deviation
        covariance += 1e-12 * np.trace(covariance) * np.eye(k)
        proposal = scipy.stats.multivariate_t(mean, covariance * (TAILS - 2) / TAILS, df=TAILS, seed=rng)
        fresh = proposal.rvs(DRAWS).reshape(DRAWS, k)
        densities.append(partial(_log_density, proposal))
        sizes.append(DRAWS)
        points = np.concatenate([points, fresh])
        target = np.concatenate([target, _target(prior, log_likelihood, fresh)])
    log_weights = target - _mixture(densities, sizes, points)
    weights = np.exp(log_weights - log_weights.max())
    kept = weights > 0
    return Posterior(points[kept], weights[kept] / weights.sum())


def _log_density(proposal: Any, points: Array) -> Array:
    return np.atleast_1d(proposal.logpdf(points))


def _target(prior: Prior, log_likelihood: Callable[[Array], Array], points: Array) -> Array:
    """Return the logarithm of prior times likelihood; the likelihood is computed inside the limits only."""
    found = prior.log_density(points)
    inside = np.isfinite(found)
    found[inside] += log_likelihood(points[inside])
    return found


def _mixture(densities: list[Callable[[Array], Array]], sizes: list[int], points: Array) -> Array:
    """Return the logarithm of the density of all proposals together."""
    shares = np.log(np.array(sizes) / sum(sizes))
    values = np.stack([density(points) for density in densities])
    return np.asarray(scipy.special.logsumexp(values + shares[:, None], axis=0))


def _tempered(log_weights: Array) -> Array:
    """Return weights to a power, the largest up to 1 that leaves enough effective draws to fit a proposal to."""

    def weights(power: float) -> Array:
        finite = np.where(np.isfinite(log_weights), power * log_weights, -np.inf)
        found = np.exp(finite - finite.max())
        return np.asarray(found / found.sum())

    def surplus(power: float) -> float:
        return 1 / float((weights(power) ** 2).sum()) - KEPT * log_weights.size

    if surplus(1) >= 0 or surplus(1e-6) <= 0:
        return weights(1 if surplus(1) >= 0 else 1e-6)
    return weights(float(scipy.optimize.brentq(surplus, 1e-6, 1, xtol=1e-4)))
