"""The slope of the force with the depth at fixed contact."""

from __future__ import annotations

import numpy as np

from roughcontact.adhesion.elastic_form import ElasticForm
from roughcontact.adhesion.truncated_newton import Counter, conjugate_gradients
from roughcontact.validation import Array, Mask

__all__ = ["force_slope"]

ACCURACY = 1e-5  # of the conjugate gradients, in the energy norm: the error of the minimum is its square


def force_slope(form: ElasticForm, free: Mask, curvature: Array, counter: Counter) -> float:
    """Return dF/dd [N/m] with the free cells in equilibrium.

    If the wall moves by one unit, the gap changes by y. It is zero on the cells at the wall, and leaves no traction on
    the free cells: ``K (y + 1) - D y = 0``, where the 1 stands for the cells of the grid. If the mean displacement must
    be zero, that of y + 1 is zero, and a constant pressure is added. The slope is the minimum of ``(y + 1).K (y + 1) -
    y.D y``.

    Parameters
    ----------
    form : ElasticForm
    free : array of bool
        Cells that are not at the wall, including those beyond the grid.
    curvature : array
        D [Pa/m], the decrease of the attraction with the gap.
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
