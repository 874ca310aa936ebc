"""The slope of the force with the depth at fixed contact."""

from __future__ import annotations

import numpy as np

from roughcontact.adhesion.elastic_form import ElasticForm
from roughcontact.adhesion.truncated_newton import Counter, conjugate_gradients
from roughcontact.validation import Array, Mask

__all__ = ["force_slope"]

ACCURACY = 1e-5  # of the conjugate gradients, in the energy norm: a least value errs by the square


def force_slope(form: ElasticForm, free: Mask, curvature: Array, counter: Counter) -> float:
    """Return dF/dd [N/m] with the free cells in equilibrium.

    With the wall one unit deeper, the gap changes by y: zero on the cells that the wall holds, and such that no
    traction is left on the free ones, ``K (y + 1) - D y = 0``, the one standing for the cells of the grid. Where the
    mean displacement is zero, that of y + 1 is, and a constant pressure takes part. The slope is the least value of
    ``(y + 1).K (y + 1) - y.D y``.

    Parameters
    ----------
    form : ElasticForm
    free : array of bool
        Cells that the wall does not hold; those beyond the grid are.
    curvature : array
        D [Pa/m], by which the attraction falls with the gap.
    counter : Counter
        Counts products.
    """
    deeper = form.extended(np.ones(form.grid.shape), 0.0)
    count = float(np.count_nonzero(free))
    change = np.zeros(form.shape)
    if form.mean_free:
        if count == 0:
            return float("inf")  # in full contact the mean gap cannot close
        change = np.where(free, -deeper.size / count, 0.0)
    traction = form.stiffness(change + deeper) - curvature * change
    step, _ = conjugate_gradients(form, free, curvature, -np.where(free, traction, 0.0), ACCURACY, counter)
    change = change + step
    moved = change + deeper
    return form.dot(form.stiffness(moved), moved) - form.dot(curvature * change, change)
