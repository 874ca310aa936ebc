"""The power law k ~ F^alpha of a stiffness curve."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughcontact.validation import Array, numeric, require

__all__ = ["FORCE_LIMIT", "ROUNDING", "PowerLaw", "fit_power_law"]

FORCE_LIMIT = 0.07  # thesis, section 4.5: the power law is fitted up to this dimensionless force
ROUNDING = 1e-9  # a force is a sum: a load on the limit of a window belongs to it, whatever its last digit


@dataclass(frozen=True, slots=True)
class PowerLaw:
    """k/(E* L) = prefactor * (F/(E* h L))^exponent (thesis, eq. 4.53).

    Attributes
    ----------
    exponent, prefactor : float
        alpha and zeta; one curve cannot say how certain they are, an ensemble can.
    scatter : float
        Standard deviation of ln k about the law.
    window : tuple of float
        Lowest and highest force of the points [N].
    count : int
        Number of points.
    force_scale, stiffness_scale : float
        E* h L [N] and E* L [N/m].
    """

    exponent: float
    prefactor: float
    scatter: float
    window: tuple[float, float]
    count: int
    force_scale: float
    stiffness_scale: float

    @numeric
    def stiffness(self, force: float | Array) -> Array:
        """Return the stiffness at given forces.

        Parameters
        ----------
        force : float or array
            Normal force [N].

        Returns
        -------
        array, the shape of `force`
            Stiffness k [N/m].
        """
        ratio = np.asarray(force, dtype=np.float64) / self.force_scale
        return np.asarray(self.stiffness_scale * self.prefactor * ratio**self.exponent)


def fit_power_law(force: Array, stiffness: Array, force_scale: float, stiffness_scale: float) -> PowerLaw:
    """Return the straight line through ln k over ln F by least squares.

    Raises
    ------
    ValueError
        If there is no rms height that could scale the force.
    """
    require(force_scale > 0, "a flat surface has no rms height to scale the force by")
    x, y = np.log(force / force_scale), np.log(stiffness / stiffness_scale)
    slope, offset = np.polyfit(x, y, 1)
    rest = y - (slope * x + offset)
    return PowerLaw(
        float(slope),
        float(np.exp(offset)),
        float(np.sqrt(np.mean(rest**2))),
        (float(force.min()), float(force.max())),
        len(force),
        force_scale,
        stiffness_scale,
    )
