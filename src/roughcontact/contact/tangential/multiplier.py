"""The displacement of the bodies that belongs to a traction under a given force: a Lagrangian multiplier."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

__all__ = ["common_displacement"]

Array = npt.NDArray[np.float64]


def common_displacement(level: Array, normal: Array, limit: Array, self_influence: float) -> Array:
    """Return the displacement [m] that the free parts of `level` have in common, shape (k,).

    Parameters
    ----------
    level : array, shape (k, n)
        Displacement of the cells less what they had slipped before [m]: less the answer it is their slip now.
    normal : array, shape (k, n)
        Unit vectors of the traction in cells at their limit, where only what lies across is free; zero elsewhere.
    limit : array, shape (n,)
        Largest traction [Pa].
    self_influence : float
        Displacement of a cell per traction on itself [m/Pa].

    Notes
    -----
    The mean with the weights of the preconditioner: a cell that slips far under little traction follows any
    displacement, and says nothing about it.
    """
    across = level - (level * normal).sum(axis=0) * normal
    weight = np.ones(level.shape[1])
    for _ in range(2):  # the weights take a first answer to know who slips how far
        free = weight.sum() * np.eye(len(level)) - (weight * normal) @ normal.T
        shift = np.linalg.lstsq(free, across @ weight, rcond=None)[0]
        forward = ((level - shift[:, None]) * normal).sum(axis=0)
        weight = 1 / (1 + np.maximum(-forward, 0.0) / (limit * self_influence))
    if normal.any(axis=0).all() and (forward > 0).all():
        # All slip, and all the wrong way: what is free says too little. None slips forward from here on:
        pull = normal @ limit
        pull /= np.sqrt(pull @ pull)
        leaning = pull @ normal
        if (leaning > 0).all():
            mean = level.mean(axis=1)
            forward = ((level - mean[:, None]) * normal).sum(axis=0)
            return np.asarray(mean + pull * (forward / leaning).max())
    return np.asarray(shift)
