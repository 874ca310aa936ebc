"""How narrow the interval of the effective height of a joint will be after a planned measurement."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughcontact import methods
from roughcontact.errors import InputError
from roughcontact.guesses import hinted
from roughcontact.measurement.importance import Prior
from roughcontact.measurement.joint_data import JointStiffness
from roughcontact.measurement.joint_emulator import joint_emulator
from roughcontact.measurement.joint_model import JointModel, discrepancy
from roughcontact.measurement.joint_topography import JointTopography, prior_of
from roughcontact.validation import Array, numeric, positive, require, whole

__all__ = ["JointPlan", "fisher_width", "plan_joint"]

STEP = 1e-3  # of the derivatives, in the logarithm of a parameter


@hinted
@dataclass(frozen=True, eq=False)
class JointPlan:
    """Expected width of the effective height, for several areas and numbers of specimens.

    Attributes
    ----------
    areas : array, shape (a,)
        Nominal areas [m^2].
    specimens : array, shape (s,)
        Numbers of joints that are measured.
    width : array, shape (a, s)
        Standard deviation of the logarithm of the effective height.
    pressures : array, shape (n,)
        Nominal pressures of the loads [Pa].
    without : array, shape (n,)
        Width of the first area and number of specimens without one of the loads; empty for one load.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> topography = rc.JointTopography(rms=1.2e-6, rms_error=0.5, rolloff=1e-4, rolloff_error=0.3)
    >>> plan = rc.plan_joint(
    ...     np.geomspace(7e6, 140e6, 5), errors=0.05, gain=0.03, modulus=115e9, modulus_error=0.02,
    ...     areas=np.array([1e-6, 2e-6]), profile=topography,
    ... )
    >>> bool((np.diff(plan.width) < 0).all())
    True
    """

    areas: Array
    specimens: Array
    width: Array
    pressures: Array
    without: Array

    to_dataset = methods.plan_dataset

    @numeric
    def reaching(self, width: float) -> tuple[float, int] | None:
        """Return the smallest total area that reaches a width.

        Parameters
        ----------
        width : float
            Wanted standard deviation of the logarithm of the effective height.

        Returns
        -------
        tuple of float and int, or None
            Area of each specimen [m^2] and their number; None if none of the plan reaches it.

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> topography = rc.JointTopography(rms=1.2e-6, rms_error=0.5, rolloff=1e-4, rolloff_error=0.3)
        >>> plan = rc.plan_joint(
        ...     np.geomspace(7e6, 140e6, 5), errors=0.05, gain=0.03, modulus=115e9, modulus_error=0.02,
        ...     areas=np.array([1e-6, 2e-6]), profile=topography,
        ... )
        >>> plan.reaching(0.01) is None
        True
        """
        total = np.where(self.width <= width, self.areas[:, None] * self.specimens, np.inf)
        if np.isinf(total).all():
            return None
        row, column = np.unravel_index(total.argmin(), total.shape)
        return float(self.areas[row]), int(self.specimens[column])


@numeric(pressures="Pa", modulus="Pa", areas="m^2")
def plan_joint(
    pressures: Array,
    *,
    errors: float | Array,
    gain: float,
    modulus: float,
    modulus_error: float,
    areas: Array,
    specimens: tuple[int, ...] = (1, 2, 4, 8, 16),
    profile: JointTopography,
) -> JointPlan:
    """Return how well the effective height will be known after measuring stiffnesses.

    Fisher's information of the emulator at the stated topography: derivatives of the mean stiffness over the covariance
    of joints, errors and discrepancy. More specimens reduce the scatter of joints and the errors of loads, not those
    of gain, modulus and model.

    Parameters
    ----------
    pressures : array, shape (n,)
        Nominal pressures of the loads [Pa].
    errors : float or array, shape (n,)
        Relative standard deviations of the stiffnesses.
    gain : float
        Relative standard deviation that all stiffnesses share.
    modulus, modulus_error : float
        Reduced modulus E* [Pa] and its relative standard deviation.
    areas : array, shape (a,)
        Nominal areas of a joint [m^2].
    specimens : tuple of int
        Numbers of joints.
    profile : JointTopography
        What is expected.

    Returns
    -------
    JointPlan

    Raises
    ------
    ValueError
        If a value is not positive, a joint is smaller than 64 squares of the roll-off wavelength, or a pressure is
        outside the emulator.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> topography = rc.JointTopography(rms=1.2e-6, rms_error=0.5, rolloff=1e-4, rolloff_error=0.3)
    >>> plan = rc.plan_joint(
    ...     np.geomspace(7e6, 140e6, 5), errors=0.05, gain=0.03, modulus=115e9, modulus_error=0.02,
    ...     areas=np.array([1e-6, 2e-6]), profile=topography,
    ... )
    >>> plan.width.shape
    (2, 5)
    """
    many = [whole(number, "specimens") for number in specimens]
    require(min(many, default=0) > 0, "specimens must be numbers from 1 on", place="specimens")
    spots = np.atleast_1d(positive(areas, "areas")).astype(np.float64)
    one = np.ones_like(np.atleast_1d(pressures), dtype=np.float64)
    data = JointStiffness(pressures, one, np.asarray(errors, dtype=np.float64), gain)

    def width(area: float, number: int, loads: JointStiffness) -> float:
        prior = prior_of((modulus, modulus_error), area, profile)
        middle = np.clip(prior.mean, prior.low, prior.high)
        middle[3] = (prior.low[3] + prior.high[3]) / 2  # the band is uniform
        return fisher_width(JointModel(joint_emulator(), area), loads, middle, prior, number)

    widths = [[width(float(area), number, data) for number in many] for area in spots]
    kept = [np.arange(one.size) != k for k in range(one.size)] if one.size > 1 else []
    fewer = [JointStiffness(data.pressures[some], one[some], data.errors[some], gain) for some in kept]
    without = [width(float(spots[0]), many[0], loads) for loads in fewer]
    return JointPlan(
        spots, np.array(many, dtype=np.float64), np.array(widths), data.pressures, np.array(without)
    )


def fisher_width(
    model: JointModel, data: JointStiffness, point: Array, prior: Prior, specimens: int = 1
) -> float:
    """Return the standard deviation of the logarithm of the effective height by Fisher's information and the prior.

    Raises
    ------
    InputError
        If a pressure is outside the emulator.
    """
    at = data.log_pressures
    if not model.inside(point[None], at).all():
        place = np.exp(model.place(point[None], at))
        low, high = model.emulator.nodes[[0, -1]]
        raise InputError(
            f"p l/(E* h) is {place.min():.2g} to {place.max():.2g}, and the emulator holds {np.exp(low):.2g} to "
            f"{np.exp(high):.2g}",
            "leave out the smallest or the largest pressures",
            "pressures",
        )
    steps = STEP * np.eye(point.size)
    sides = [model.stiffness(point + sign * steps, at)[0] for sign in (1, -1)]
    slopes = ((sides[0] - sides[1]) / (2 * STEP)).T  # of each load and parameter
    common = discrepancy(at)  # specimens share it, as they share gain and modulus
    scatter = model.stiffness(point[None], at)[1][0] - common + np.diag(data.errors**2)
    covariance = scatter / specimens + common + data.gain**2
    flat = np.isinf(prior.deviation)
    variance = np.where(flat, (prior.high - prior.low) ** 2 / 12, np.where(flat, 1, prior.deviation) ** 2)
    information = slopes.T @ np.linalg.solve(covariance, slopes) + np.diag(1 / variance)
    exponent = float(model.exponent(point[None], float(at.mean()))[0])
    weights = np.array([exponent, 1 - exponent, 0, 0, 0])
    return float(np.sqrt(weights @ np.linalg.solve(information, weights)))
