"""Uncertainty of the power law of an ensemble, by drawing its samples again with replacement."""

from __future__ import annotations

import math

import numpy as np

from roughcontact.statistics.ensemble_mean import Mean, mean_over_samples
from roughcontact.validation import Array, Mask

__all__ = ["counts_of", "interval", "resampled_laws"]


def counts_of(uniform: Array, there: Mask) -> Array:
    """Return how often each sample is drawn, shape (replicates, samples); missing samples are never drawn.

    Parameters
    ----------
    uniform : array, shape (replicates, samples)
        Random numbers from 0 to 1. Ensembles with the same samples get the same draws from the same numbers: samples
        that are paired between ensembles stay paired in every replicate.
    there : bool array, shape (samples,)
    """
    size, replicates = int(there.sum()), len(uniform)
    drawn = (uniform[:, :size] * size).astype(np.intp) + size * np.arange(replicates)[:, np.newaxis]
    counts = np.zeros(uniform.shape)
    counts[:, there] = np.bincount(drawn.ravel(), minlength=replicates * size).reshape(replicates, size)
    return counts


def resampled_laws(ln_force: Array, stiffness: Array, counts: Array, mean: Mean) -> Array:
    """Return alpha and ln zeta of every replicate, shape (replicates, 2).

    Parameters
    ----------
    ln_force : array, shape (points,)
    stiffness : array, shape (samples, points)
        Whole curves are drawn, not points: the points of one are not independent. NaN where a sample has none.
    counts : array, shape (replicates, samples)
    mean : {"arithmetic", "geometric"}
    """
    y = np.log(mean_over_samples(stiffness, mean, counts))
    there = ~np.isnan(y)  # a point may be missing in all samples of a replicate
    with np.errstate(invalid="ignore", divide="ignore"):
        if there.all():
            x = ln_force - ln_force.mean()
            slope = y @ x / (x @ x)
            return np.stack([slope, y.mean(axis=1) - slope * ln_force.mean()], axis=1)
        n, y = there.sum(axis=1), np.where(there, y, 0.0)
        middle = there @ ln_force / n
        x = np.where(there, ln_force - middle[:, np.newaxis], 0.0)
        slope = (x * y).sum(axis=1) / (x * x).sum(axis=1)
        return np.stack([slope, y.sum(axis=1) / n - slope * middle], axis=1)


def interval(values: Array, level: float, samples: int) -> Array:
    """Return confidence limits: a share `level` of the intervals of many ensembles contains the true value.

    Parameters
    ----------
    values : array, shape (replicates, ...)
        Values of the replicates.
    level : float
    samples : int
        Number of samples from which the replicates were drawn.

    Returns
    -------
    array, shape (2, ...)
        Percentiles of the replicates; NaN for fewer than two samples.

    Notes
    -----
    Replicates scatter less than ensembles, by ``sqrt(1 - 1/n)``, and do not include the uncertainty of their scatter.
    The percentiles compensate for both if the statistic is a mean of n normal samples: ``Phi(-sqrt(n/(n-1)) t)``
    instead of ``(1 - level)/2``, with Student's t of n - 1 (T. C. Hesterberg, What teachers should know about the
    bootstrap, Am. Stat. 69, 371 (2015), expanded percentiles).
    """
    from scipy.special import ndtr, stdtrit

    if samples < 2 or not len(values):
        return np.full((2, *values.shape[1:]), np.nan)
    quantile = float(stdtrit(samples - 1, (1 + level) / 2))
    tail = float(ndtr(-math.sqrt(samples / (samples - 1)) * quantile))
    return np.asarray(np.quantile(values, [tail, 1 - tail], axis=0))
