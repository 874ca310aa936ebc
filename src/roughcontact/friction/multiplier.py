"""The displacement of the bodies that belongs to a traction under a given force: a Lagrangian multiplier."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import beside, namespace, numbers

__all__ = ["common_displacement"]

Array = npt.NDArray[np.float64]


def common_displacement(level: Array, normal: Array, limit: Array, self_influence: float) -> Array:
    """Return the displacement [m] that the free parts of `level` have in common, shape (k,), as NumPy's array.

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
    xp = namespace(level)

    def forward_of(shift: Array) -> Array:
        return xp.sum((level - beside(shift[:, None], level)) * normal, axis=0)  # type: ignore[no-any-return]

    across = level - xp.sum(level * normal, axis=0) * normal
    weight = xp.ones_like(limit)
    for _ in range(2):  # the weights take a first answer to know who slips how far
        free = float(xp.sum(weight)) * np.eye(level.shape[0]) - numbers((weight * normal) @ normal.T)
        shift = np.asarray(np.linalg.lstsq(free, numbers(across @ weight), rcond=None)[0], np.float64)
        forward = forward_of(shift)
        weight = 1 / (1 + xp.clip(-forward, 0.0, None) / (limit * self_influence))
    if bool(xp.all(xp.any(normal != 0, axis=0) & (forward > 0))):
        # All slip, and all the wrong way: what is free says too little. None slips forward from here on:
        pull = numbers(normal @ limit)
        pull /= np.sqrt(pull @ pull)
        leaning = beside(pull, normal) @ normal
        if bool(xp.all(leaning > 0)):
            mean = numbers(xp.mean(level, axis=1))
            return np.asarray(mean + pull * float(xp.max(forward_of(mean) / leaning)))
    return shift
