"""Flow through a joint as through an effective medium: Bruggeman's theory in two dimensions.

A cell of gap g has the conductance g^3 in its surroundings, the effective medium (Bruggeman, Ann. Phys. 416, 636
(1935)). The theory uses the distribution of the gaps and not their places. Its open cells stop to percolate where half
of the area is closed; Dapp and others (Phys. Rev. Lett. 108, 244301 (2012)) moved this threshold.
"""

from __future__ import annotations

import numpy as np
import scipy.optimize

from roughcontact.errors import about
from roughcontact.validation import Array, numeric, positive, require

__all__ = ["bruggeman"]

THRESHOLD = 0.5  # closed part of the area at which two-dimensional effective media stop to conduct


@numeric
def bruggeman(conductances: Array, threshold: float = THRESHOLD) -> float:
    """Return the conductance of an effective medium.

    It is the solution kappa of ``mean((m - kappa)/(m + s kappa)) = 0`` with ``s = threshold/(1 - threshold)``. Against
    flows through six pressed random surfaces it was 9 % too high at A/A0 = 0.05, 16 % at 0.17 and 50 % at 0.28.

    Parameters
    ----------
    conductances : array
        Conductances m of cells of equal size, such as their cubed gaps [m^3]; 0 where closed.
    threshold : float
        Closed part of the area from which nothing flows, above 0 and below 1.

    Returns
    -------
    float
        Conductance of the medium, in the unit of `conductances`; 0 if the closed part reaches the threshold.

    Raises
    ------
    ValueError
        If a conductance is negative or the threshold is out of range.

    Examples
    --------
    >>> from roughcontact.theory import leakage
    >>> round(leakage.bruggeman([1.0, 4.0]), 12)  # of two kinds of equal area: the geometric mean
    2.0
    """
    m = positive(conductances, "the conductances", zero=True).ravel()
    if not 0 < threshold < 1:
        raise about("threshold", f"must lie between 0 and 1, not at {threshold}")
    require(m.size > 0, "there are no conductances", place="conductances")
    largest = float(m.max())
    if np.mean(m == 0) >= threshold:
        return 0.0
    s, m = threshold / (1 - threshold), m / largest

    def excess(kappa: float) -> float:
        return float(np.mean((m - kappa) / (m + s * kappa)))

    lowest = np.finfo(float).tiny
    if excess(lowest) <= 0:
        return 0.0
    # In the logarithm, because the conductance falls by decades near the threshold.
    root = scipy.optimize.brentq(
        lambda x: excess(float(np.exp(x))), np.log(lowest), 0.0, xtol=1e-13, rtol=1e-14
    )
    return largest * float(np.exp(root))
