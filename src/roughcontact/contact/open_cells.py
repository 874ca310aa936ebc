"""Mean over the measured cells of a field that vanishes in contact: the gap, or its change per unit depth.

Near full contact this mean is a small difference of other means: with one open cell of 200 x 200 on a free plane, it is
less than a millionth of them. In contact the field is zero by the conditions of contact, so only the open cells
contribute to the mean, and nothing cancels.
"""

from __future__ import annotations

import math

from roughcontact.arrays import max_abs, namespace
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.prescribed import prescribe
from roughcontact.validation import Array, Mask

__all__ = ["ACCURACY", "ROUNDING", "mean_opening"]


ACCURACY = 5e-7  # of a mean found as a difference; with the error of the stiffness k, 1e-7, within 1e-6
SOLVED = 1e-7  # of the mean over the open cells: largest value of the field in contact
ROUNDING = 1e-12  # of a mean over any number of cells, and of the product that it follows from
SWEEP = (1e-10, 1e-3)  # smallest and largest factor of the error in one solve


def mean_opening(operator: Operator, opening: Array, region: Mask, measured: Mask) -> float:
    """Return the mean over the measured cells of a field that a pressure on a region brings to zero there.

    Parameters
    ----------
    operator : Operator
        The exact operator.
    opening : array, shape ``operator.grid.shape``
        A gap [m], or its change per unit depth: small on the region. A pressure on the region reduces its values there
        until they are small against the mean over the open cells. Values of cells that were not measured are ignored.
    region, measured : bool array
        The closed cells, and the measured cells.

    Notes
    -----
    A pressure on the region displaces no other cell of a half-space by more than those of the region (the maximum
    principle). So the values left on the region bound the error of the mean over the open cells.
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
