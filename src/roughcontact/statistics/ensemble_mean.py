"""Means over the samples of an ensemble, some of which may be missing."""

from __future__ import annotations

from typing import Literal, TypeAlias

import numpy as np

from roughcontact.errors import about
from roughcontact.validation import Array

__all__ = ["Mean", "mean_over_samples", "shares_of_samples"]

Mean: TypeAlias = Literal["arithmetic", "geometric"]


def mean_over_samples(values: Array, mean: Mean = "arithmetic", counts: Array | None = None) -> Array:
    """Return the mean of the values that are not missing; NaN if all are missing.

    Parameters
    ----------
    values : array, shape (samples, points)
        NaN where a sample has no value.
    mean : {"arithmetic", "geometric"}
        The geometric mean belongs to averages of ln k: it is lower by about half the variance of ln k. It is zero if a
        value is zero, and undefined for negative values.
    counts : array, shape (..., samples), optional
        Weight of each sample; by default 1.

    Returns
    -------
    array, shape (..., points)

    Raises
    ------
    ValueError
        If `mean` is neither.
    """
    if mean not in ("arithmetic", "geometric"):
        raise about("mean", f"must be 'arithmetic' or 'geometric', not {mean!r}")
    weights = np.ones(len(values)) if counts is None else np.asarray(counts, dtype=np.float64)
    there = ~np.isnan(values)
    with np.errstate(invalid="ignore", divide="ignore"):
        if mean == "arithmetic":
            return np.asarray(weights @ np.where(there, values, 0.0) / (weights @ there))
        # The logarithm of zero would give NaN even in means in which the weight of its sample is zero.
        logs = np.where(values > 0, np.log(values), 0.0)
        means = np.exp(weights @ logs / (weights @ there))
        means = np.where(weights @ (values == 0) > 0, 0.0, means)
        return np.asarray(np.where(weights @ (values < 0) > 0, np.nan, means))


def shares_of_samples(values: Array, mean: Mean = "arithmetic") -> Array:
    """Return the contribution of each sample to the logarithm of the mean, shape (samples, points), with mean zero.

    It is ``k/mean(k) - 1``, or ``ln k - mean(ln k)`` for a geometric mean; zero where a sample is missing, with larger
    contributions from the other samples there.
    """
    there = ~np.isnan(values)
    means = mean_over_samples(values, mean)
    with np.errstate(invalid="ignore", divide="ignore"):
        shares = values / means - 1 if mean == "arithmetic" else np.log(values / means)
        return np.asarray(np.where(there, shares, 0.0) * (len(values) / there.sum(axis=0)))
