"""Mean over the measured cells of a field that vanishes in contact: the gap, or its change per unit depth.

Near full contact this mean is a small difference of other means: with one open cell of 200 x 200 on a free plane, less
than a millionth of them. In contact the field is zero by the conditions of contact, so the open cells alone give the
mean, and nothing cancels.
"""

from __future__ import annotations

import math

from roughcontact.arrays import max_abs, namespace
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.prescribed import prescribe
from roughcontact.validation import Array, Mask

__all__ = ["ACCURACY", "ROUNDING", "mean_opening"]


ACCURACY = 5e-7  # of a mean found as a difference; with what the stiffness k itself lacks, 1e-7, within 1e-6
SOLVED = 1e-7  # of the mean over the open cells: how far from zero the field may be in contact
ROUNDING = 1e-12  # of a mean over any number of cells, and of the product behind it
SWEEP = (1e-10, 1e-3)  # least and largest reduction of the error by one solve


def mean_opening(operator: Operator, opening: Array, region: Mask, measured: Mask) -> float:
    """Return the mean over the measured cells of a field that a pressure on a region brings to zero there.

    Parameters
    ----------
    operator : Operator
        The exact one.
    opening : array, shape ``operator.grid.shape``
        A gap [m], or its change per unit depth: small on the region. What is left there is taken off by a pressure on
        the region, until it is small against the mean over the open cells. Values where nothing was measured do not
        matter.
    region, measured : bool array
        The cells that are closed, and those that count.

    Notes
    -----
    A pressure on the region displaces no other cell of a half-space by more than those of the region (the maximum
    principle). So what is left on the region bounds the error of the mean over the open cells.
    """
    xp = namespace(opening)
    measure = Measure(operator.weights, xp)
    outside = measured & ~region
    share = measure.total(outside) / measure.total(measured)
    if share == 0:
        return 0.0
    before = math.inf
    while True:
        left = xp.where(region, opening, 0.0)
        error, mean = max_abs(left), measure.mean(opening, outside)
        if not SOLVED * abs(mean) < error < before / 2:
            return share * mean
        tolerance = min(max(SOLVED * abs(mean) / error, SWEEP[0]), SWEEP[1])
        del left  # planes are large
        opening = opening - operator.apply(prescribe(operator, region, opening, tolerance).pressure)
        before = error
