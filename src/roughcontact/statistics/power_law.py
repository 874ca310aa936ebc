"""The power law k ~ F^alpha of a stiffness curve."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact.validation import Array, numeric, require

__all__ = ["FORCE_LIMIT", "ROUNDING", "PowerLaw", "fit_power_law"]

FORCE_LIMIT = 0.07  # thesis, section 4.5: the power law is fitted up to this dimensionless force
# Change of the exponent from one end of the window to the other. The exponents 1/(1 + H) of surfaces with H = 0.5 and
# 0.8 differ by 0.11: with such a bend, the exponent cannot distinguish two surfaces.
BEND = 0.1
CHANCE = 0.00135  # probability of a bend in one direction by chance: three standard errors
ROUNDING = 1e-9  # a force is a sum: a load on the limit of a window belongs to it, despite rounding


@dataclass(frozen=True, slots=True)
class PowerLaw:
    """k/(E* L) = prefactor * (F/(E* h L))^exponent (thesis, eq. 4.53).

    Attributes
    ----------
    exponent, prefactor : float
        alpha and zeta; their uncertainty follows from an ensemble, not from one curve.
    scatter : float
        Standard deviation of ln k about the law.
    window : tuple of float
        Lowest and highest force of the points [N].
    count : int
        Number of points.
    force_scale, stiffness_scale : float
        E* h L [N] and E* L [N/m].
    bend, bend_error : float
        Change of the exponent from the lowest force of the window to the highest, by the parabola through the
        logarithms, and its standard error; infinite for three points.
    rule : str
        Description of the selected points: how many of all, and why.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> law = rc.loading_curve(ball, 1e9, forces=np.geomspace(1e-2, 1e-1, 9)).fit()
    >>> f"k ~ F^{law.exponent:.2f}, {law.stiffness(2e-2) / 1e3:.1f} N/mm at 20 mN", law.straight
    ('k ~ F^0.34, 22.8 N/mm at 20 mN', True)
    """

    exponent: float
    prefactor: float
    scatter: float
    window: tuple[float, float]
    count: int
    force_scale: float
    stiffness_scale: float
    bend: float = 0.0
    bend_error: float = math.inf
    rule: str = ""

    @property
    def straight(self) -> bool:
        """Whether the points are compatible with a power law: the exponent changes by less than 0.1, or by chance."""
        if self.count < 4:
            return True
        from scipy.special import stdtrit

        # By Student's distribution: few points scatter more.
        sure = -float(stdtrit(self.count - 3, CHANCE)) * self.bend_error
        return abs(self.bend) <= max(BEND, sure)

    @property
    def ends(self) -> tuple[float, float]:
        """The local exponents at the lowest and at the highest force of the window, by the parabola.

        Exact for points evenly spaced in the logarithm, whose mean slope is that of the middle.
        """
        return self.exponent - self.bend / 2, self.exponent + self.bend / 2

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


def fit_power_law(
    force: Array, stiffness: Array, force_scale: float, stiffness_scale: float, rule: str = ""
) -> PowerLaw:
    """Return the straight line through ln k over ln F by least squares.

    Raises
    ------
    ValueError
        If there is no rms height to scale the force.
    """
    require(force_scale > 0, "a flat surface has no rms height to scale the force by")
    x, y = np.log(force / force_scale), np.log(stiffness / stiffness_scale)
    slope, offset = np.polyfit(x, y, 1)
    rest = y - (slope * x + offset)
    bend, bend_error = _bend(x, y)
    return PowerLaw(
        float(slope),
        float(np.exp(offset)),
        float(np.sqrt(np.mean(rest**2))),
        (float(force.min()), float(force.max())),
        len(force),
        force_scale,
        stiffness_scale,
        bend,
        bend_error,
        rule,
    )


def _bend(x: Array, y: Array) -> tuple[float, float]:
    """Return the change of the slope of the parabola through the points, and its standard error."""
    width = float(np.ptp(x))
    if len(x) < 4 or width == 0:
        return 0.0, math.inf
    powers = np.vander((x - x.mean()) / width, 3)
    factors, _, rank, _ = np.linalg.lstsq(powers, y)
    if rank < 3:
        return 0.0, math.inf  # only two different forces
    rest = y - powers @ factors
    variance = float(rest @ rest) / (len(x) - 3) * np.linalg.inv(powers.T @ powers)[0, 0]
    return float(2 * factors[0] / width), float(2 * math.sqrt(variance) / width)
