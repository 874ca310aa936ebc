"""Nominally flat surfaces as independent cells, each a rough indenter of its own (thesis, section 5.1)."""

from __future__ import annotations

import numpy as np

from roughcontact.theory.stiffness_laws import pohrt_popov
from roughcontact.validation import Array

__all__ = ["cells_stiffness", "exponential_rate", "single_cell_stiffness"]

_DEEPEST = 20.0  # over h; far beyond what eq. 5.5 is about


def cells_stiffness(below: Array, length: float, force: Array, hurst: float) -> Array:
    """Return the stiffness k/(E* L) of cells that do not feel each other, each under eq. 5.5 from its top on.

    Parameters
    ----------
    below : array, shape (n,)
        How far the tops of the cells lie below the highest, over the rms height h.
    length : float
        Side of a cell over L.
    force : array, shape (m,)
        F/(E* h L), ascending.
    hurst : float
        Hurst exponent H, above 0 and at most 2.
    """
    zeta, power = float(pohrt_popov.prefactor(hurst)), float(1 / pohrt_popov.exponent(hurst))  # H + 1
    depth = np.geomspace(1e-4, _DEEPEST, 800)
    sunk = np.maximum(depth - below[:, None], 0)
    # F/(E* h l) of a cell at a depth d/h (eq. 5.1), and its k/(E* l) at that force.
    carried = (zeta * (power - 1) / power * sunk) ** (power / (power - 1))
    together = length * carried.sum(axis=0)
    stiffness = length * zeta * (carried ** (1 / power)).sum(axis=0)
    return np.asarray(np.exp(np.interp(np.log(force), np.log(together), np.log(stiffness))))


def single_cell_stiffness(length: Array | float, force: Array, hurst: float) -> Array:
    """Return the stiffness k/(E* L) of one cell of side `length` L that carries a whole force F/(E* h L) (eq. 5.5)."""
    zeta, alpha = float(pohrt_popov.prefactor(hurst)), float(pohrt_popov.exponent(hurst))
    return np.asarray(length * zeta * (force / length) ** alpha)


def exponential_rate(below: Array) -> float:
    """Return lambda h of an exponential distribution of tops, from the mean height of the upper half above the median.

    An exponential distribution has the same mean excess above every height, 1/lambda. NaN of fewer than four tops.

    Parameters
    ----------
    below : array, shape (n,)
        See `cells_stiffness`.
    """
    if below.size < 4:
        return float("nan")
    excess = np.median(below) - below
    return float(1 / excess[excess > 0].mean())
