"""The answer of an inference from the stiffness of a joint."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughcontact import methods
from roughcontact.guesses import hinted
from roughcontact.measurement.importance import Posterior
from roughcontact.measurement.joint_data import JointClosures, JointData
from roughcontact.measurement.joint_explanations import JointExplanation
from roughcontact.measurement.joint_model import UNLIKELY, JointModel
from roughcontact.validation import Array, numeric, require

__all__ = ["InferredParameter", "JointInference", "closure_quantiles", "ends", "stiffness_quantiles"]

SHARES = (0.05, 0.5, 0.95)
PART = 100  # joints at once: their covariances at all nodes take megabytes, not gigabytes
INFORMED = 0.3  # nats, a standard deviation of 0.74 of the prior's: with less, a parameter counts as unknown


@dataclass(frozen=True, slots=True)
class InferredParameter:
    """A parameter before and after the measurement.

    Attributes
    ----------
    name, unit : str
    prior, posterior : tuple of float
        Quantiles of 5, 50 and 95 %.
    nats : float
        Information gained: divergence of Kullback and Leibler between posterior and prior.
    """

    name: str
    unit: str
    prior: tuple[float, float, float]
    posterior: tuple[float, float, float]
    nats: float

    @property
    def informed(self) -> bool:
        """Whether the measurement holds information about it: at least 0.3 nats."""
        return self.nats >= INFORMED

    def __str__(self) -> str:
        """Return it in words."""
        if not self.informed:
            return f"{self.name}: no information ({self.nats:.2f} nats)"
        low, middle, high = self.posterior
        return f"{self.name}: {middle:.3g} {self.unit} ({low:.3g} to {high:.3g}), {self.nats:.2f} nats"


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class JointInference:
    """The topography of a joint, inferred from its stiffness.

    Attributes
    ----------
    exponent : float
        Local exponent a of K ~ p^a, of the joints of the posterior in the middle of the pressures.
    p_value : float
        Probability that a joint of the model departs as far from it as the measurement.
    departs : str
        In what the measurement departs most: "level", "slope" or "curvature".
    parameters : tuple of InferredParameter
        Rms height, roll-off wavelength, Hurst exponent, band, modulus and, if given, hardness; empty if the model does
        not fit, or for one load.
    explanations : tuple of JointExplanation
        If it is not the joint of a given topography: what would make it so.
    data : JointData
        The measurement.
    notes : tuple of str
    model : JointModel
    posterior : Posterior
        Weighted draws of the logarithms of rms height and roll-off wavelength, the Hurst exponent, and the logarithms
        of band, modulus and, if given, hardness.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> p = np.array([7e6, 15e6, 30e6, 65e6, 140e6])
    >>> data = rc.JointStiffness(p, 1.9e7 * p**0.88, errors=0.05)
    >>> found = rc.infer_joint(data, modulus=115e9, modulus_error=0.02, area=2.5e-6, branch="loading")
    >>> found.fits, [each.name for each in found.parameters if each.informed]
    (True, ['rms', 'rolloff'])
    """

    exponent: float
    p_value: float
    departs: str
    parameters: tuple[InferredParameter, ...]
    explanations: tuple[JointExplanation, ...]
    data: JointData
    notes: tuple[str, ...]
    model: JointModel
    posterior: Posterior

    plot = methods.joint_inference
    to_dataset = methods.inference_dataset
    to_record = methods.inference_record

    @property
    def fits(self) -> bool:
        """Whether a joint of the model departs as far with a probability of 2 % or more."""
        return not self.p_value < UNLIKELY

    @property
    def effective_height(self) -> float:
        """Median of the effective height ``rms^a rolloff^(1 - a)`` [m]; NaN if the model does not fit."""
        return float(self._heights(0.5)) if self.fits else float("nan")

    @numeric
    def interval(self, level: float = 0.9) -> tuple[float, float]:
        """Return the interval of the effective height.

        Parameters
        ----------
        level : float
            Its probability.

        Returns
        -------
        tuple of float
            Between the outer quantiles [m]; NaN if the model does not fit.

        Raises
        ------
        ValueError
            If the level is not between 0 and 1.

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> p = np.array([7e6, 15e6, 30e6, 65e6, 140e6])
        >>> data = rc.JointStiffness(p, 1.9e7 * p**0.88, errors=0.05)
        >>> found = rc.infer_joint(data, modulus=115e9, modulus_error=0.02, area=2.5e-6, branch="loading")
        >>> low, high = found.interval(0.9)
        >>> low < found.effective_height < high
        True
        """
        require(0 < level < 1, f"level must lie between 0 and 1, not {level:g}", place="level")
        if not self.fits:
            return float("nan"), float("nan")
        low, high = self._heights(np.array([1 - level, 1 + level]) / 2)
        return float(low), float(high)

    @numeric(pressures="Pa")
    def predicted(self, pressures: float | Array, level: float = 0.9) -> tuple[Array, Array, Array]:
        """Return the stiffness of joints like this one.

        Parameters
        ----------
        pressures : float or array, shape (n,)
            Nominal pressures [Pa]; NaN is returned where they are outside the emulator.
        level : float
            Probability of the band.

        Returns
        -------
        low, median, high : array, shape (n,)
            Interfacial stiffness per area [Pa/m] of another joint of the posterior.

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> p = np.array([7e6, 15e6, 30e6, 65e6, 140e6])
        >>> data = rc.JointStiffness(p, 1.9e7 * p**0.88, errors=0.05)
        >>> found = rc.infer_joint(data, modulus=115e9, modulus_error=0.02, area=2.5e-6, branch="loading")
        >>> low, median, high = found.predicted(30e6)
        >>> bool(low[0] < median[0] < high[0])
        True
        """
        low, median, high = stiffness_quantiles(self, np.atleast_1d(pressures), ends(level))
        return low, median, high

    @numeric(pressures="Pa")
    def predicted_closures(self, pressures: Array, level: float = 0.9) -> tuple[Array, Array, Array]:
        """Return the closures of joints like this one.

        Parameters
        ----------
        pressures : array, shape (n,)
            Nominal pressures [Pa], increasing, within those of the measurement.
        level : float
            Probability of the band.

        Returns
        -------
        low, median, high : array, shape (n,)
            Closure since the first of these pressures [m] of another joint of the posterior.

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> p = np.array([7e6, 15e6, 30e6, 65e6, 140e6])
        >>> data = rc.JointClosures(p, 4e-7 * (p / 1e6) ** 0.12, resolution=5e-9)
        >>> found = rc.infer_joint(data, modulus=115e9, modulus_error=0.02, area=2.5e-6, branch="loading")
        >>> low, median, high = found.predicted_closures(p)
        >>> float(median[0]), bool((low < high)[1:].all())
        (0.0, True)
        """
        low, median, high = closure_quantiles(self, pressures, ends(level))
        return low, median, high

    @numeric(height="m")
    def share_below(self, height: float) -> float:
        """Return the probability that the effective height is below a height [m].

        Parameters
        ----------
        height : float
            [m].

        Returns
        -------
        float

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> p = np.array([7e6, 15e6, 30e6, 65e6, 140e6])
        >>> data = rc.JointStiffness(p, 1.9e7 * p**0.88, errors=0.05)
        >>> found = rc.infer_joint(data, modulus=115e9, modulus_error=0.02, area=2.5e-6, branch="loading")
        >>> f"{found.share_below(found.effective_height):.1f}"
        '0.5'
        """
        return float(self.posterior.weights[self._log_heights < np.log(height)].sum())

    @property
    def width(self) -> float:
        """Standard deviation of the logarithm of the effective height."""
        values, weights = self._log_heights, self.posterior.weights
        return float(np.sqrt(weights @ (values - weights @ values) ** 2))

    @property
    def _log_heights(self) -> Array:
        """Logarithm of the effective height [m] of each draw."""
        rms, rolloff = self.posterior.points[:, :2].T
        return np.asarray(self.exponent * rms + (1 - self.exponent) * rolloff)

    def _heights(self, shares: Array | float) -> Array:
        return np.exp(self.posterior.quantiles(self._log_heights, np.asarray(shares)))

    def __repr__(self) -> str:
        """Return the answer in one line."""
        if not self.fits:
            return f"JointInference(not this model: p = {self.p_value:.2g}, by its {self.departs})"
        low, high = self.interval()
        return f"JointInference(h_eff = {self.effective_height:.3g} m, {low:.3g} to {high:.3g} with 90 %)"


def stiffness_quantiles(inference: JointInference, pressures: Array, shares: list[float]) -> Array:
    """Return quantiles of the stiffness of joints of the posterior, shape (shares, pressures).

    They are NaN outside the emulator.
    """
    rng, points = _drawn(inference.posterior)
    found = np.full((len(shares), len(pressures)), np.nan)
    for j, each in enumerate(np.log(np.asarray(pressures, np.float64))):
        one = np.array([each])
        kept = points[inference.model.inside(points, one)]
        if len(kept) < len(points) / 2:
            continue
        mean, covariance = inference.model.stiffness(kept, one)
        drawn = mean[:, 0] + np.sqrt(covariance[:, 0, 0]) * rng.standard_normal(len(kept))
        found[:, j] = np.exp(np.quantile(drawn, shares))
    return found


def closure_quantiles(inference: JointInference, pressures: Array, shares: list[float]) -> Array:
    """Return quantiles of the closure of joints of the posterior, shape (shares, pressures); zero at the first."""
    model, zero = inference.model, np.zeros(np.shape(pressures))
    data = JointClosures(pressures, zero, resolution=np.array(1.0))
    rng, points = _drawn(inference.posterior)
    kept = points[model.inside(points, data.log_pressures)]
    means, scatters = [], []
    for part in np.array_split(kept, -(-len(kept) // PART)):
        mean, covariance = data.observed(*model.stiffness(part, data.log_pressures))
        means.append(mean)
        scatters.append(np.sqrt(np.diagonal(covariance, axis1=1, axis2=2)))
    mean = np.concatenate(means)
    drawn = mean + np.concatenate(scatters) * rng.standard_normal(mean.shape)
    return np.pad(np.quantile(drawn, shares, axis=0), ((0, 0), (1, 0)))


def _drawn(posterior: Posterior) -> tuple[np.random.Generator, Array]:
    """Return a generator, and parameters of joints of the posterior, shape (4000, 5)."""
    rng = np.random.default_rng(0)
    return rng, posterior.points[rng.choice(len(posterior.weights), 4000, p=posterior.weights)]


def ends(level: float) -> list[float]:
    """Return the quantiles between which a band of this probability lies, with the median between them."""
    return [(1 - level) / 2, 0.5, (1 + level) / 2]
