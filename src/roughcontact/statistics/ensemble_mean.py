"""Means over the samples of an ensemble, some of which may be missing."""

from __future__ import annotations

from typing import Literal, TypeAlias

import numpy as np

from roughcontact.errors import about
from roughcontact.validation import Array

__all__ = ["Mean", "mean_over_samples", "shares_of_samples"]

Mean: TypeAlias = Literal["arithmetic", "geometric"]


def mean_over_samples(values: Array, mean: Mean = "arithmetic", counts: Array | None = None) -> Array:
    """Return the mean of what is there, NaN where nothing is.

    Parameters
    ----------
    values : array, shape (samples, points)
        NaN where a sample has no value.
    mean : {"arithmetic", "geometric"}
        The geometric mean is what averages of ln k are: lower by about half the variance of ln k. With a zero it is
        zero; below zero there is none.
    counts : array, shape (..., samples), optional
        How often each sample counts; without, once.

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
        # A logarithm of zero would spoil even the means in which its sample does not count.
        logs = np.where(values > 0, np.log(values), 0.0)
        means = np.exp(weights @ logs / (weights @ there))
        means = np.where(weights @ (values == 0) > 0, 0.0, means)
        return np.asarray(np.where(weights @ (values < 0) > 0, np.nan, means))


def shares_of_samples(values: Array, mean: Mean = "arithmetic") -> Array:
    """Return what each sample adds to the logarithm of the mean, shape (samples, points); their mean is zero.

    It is ``k/mean(k) - 1``, of a geometric mean ``ln k - mean(ln k)``; nothing where a sample is missing, and the
    more from the others there.
    """
    there = ~np.isnan(values)
    means = mean_over_samples(values, mean)
    with np.errstate(invalid="ignore", divide="ignore"):
        shares = values / means - 1 if mean == "arithmetic" else np.log(values / means)
        return np.asarray(np.where(there, shares, 0.0) * (len(values) / there.sum(axis=0)))
