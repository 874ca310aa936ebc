"""The power law of an ensemble of stiffness curves, and its standard errors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughcontact.statistics.ensemble_mean import Mean, mean_over_samples, shares_of_samples
from roughcontact.statistics.power_law import PowerLaw, fit_power_law
from roughcontact.validation import Array

__all__ = ["EnsembleFit", "fit_ensemble", "law_error"]


@dataclass(frozen=True, slots=True)
class EnsembleFit:
    """A power law of a mean stiffness with standard errors from the scatter of the samples.

    Attributes
    ----------
    law : PowerLaw
        Through the means.
    exponent_error : float
        Standard error of the exponent alpha.
    prefactor_error : float
        Standard error of the prefactor zeta.
    correlation : float
        Correlation of the errors of alpha and ln zeta: near 1, because zeta is the value at a dimensionless force of
        1, far outside the window. Compare laws at a force inside the window, not only by zeta.
    mean : {"arithmetic", "geometric"}
        Which mean over the samples.
    samples : int
        Number of samples.
    """

    law: PowerLaw
    exponent_error: float
    prefactor_error: float
    correlation: float
    mean: Mean
    samples: int

    @property
    def exponent(self) -> float:
        """Exponent alpha."""
        return self.law.exponent

    @property
    def prefactor(self) -> float:
        """Prefactor zeta."""
        return self.law.prefactor

    def stiffness_error(self, force: float | Array) -> Array:
        """Return the standard error of the law's stiffness [N/m] at a `force` [N]."""
        x = np.log(np.asarray(force, dtype=np.float64) / self.law.force_scale)
        error = law_error(x, self.exponent_error, self.prefactor_error / self.prefactor, self.correlation)
        return np.asarray(self.law.stiffness(force) * error)


def law_error(
    ln_force: Array, exponent: Array | float, ln_prefactor: Array | float, r: Array | float
) -> Array:
    """Return the standard error of ``ln zeta + alpha ln F`` from those of alpha and ln zeta and their correlation."""
    variance = (exponent * ln_force) ** 2 + 2 * r * exponent * ln_prefactor * ln_force + ln_prefactor**2
    # If both cancel, rounding may give a negative number.
    return np.asarray(np.sqrt(np.maximum(variance, 0.0)))


def fit_ensemble(
    force: Array, stiffness: Array, scales: tuple[float, float], mean: Mean = "arithmetic"
) -> EnsembleFit:
    """Return the straight line through the logarithm of the mean stiffness over ln F by least squares.

    Parameters
    ----------
    force : array, shape (loads,)
        Forces [N].
    stiffness : array, shape (samples, loads)
        Stiffness [N/m] of every sample at these forces; NaN where a sample has none, but not all at one force.
    scales : tuple of float
        E* h L [N] and E* L [N/m].
    mean : {"arithmetic", "geometric"}
        Which mean over the samples.

    Notes
    -----
    Exponent and ln zeta are linear in the logarithms of the means. A sample contributes ``k/mean(k) - 1`` to such a
    logarithm, or ``ln k - mean(ln k)`` for a geometric mean. Samples are independent, but the forces of one sample are
    not: the standard errors come from the total contribution of each sample to the two parameters.
    """
    stiffness = stiffness[~np.isnan(stiffness).all(axis=1)]
    samples = len(stiffness)
    law = fit_power_law(force, mean_over_samples(stiffness, mean), *scales)
    if samples < 2:
        return EnsembleFit(law, np.nan, np.nan, np.nan, mean, samples)
    x = np.log(force / scales[0])
    line = np.linalg.pinv(np.stack([x, np.ones_like(x)], axis=1))
    covariance = np.cov(shares_of_samples(stiffness, mean) @ line.T, rowvar=False) / samples
    alpha, ln_zeta = np.sqrt(np.diag(covariance))
    correlation = covariance[0, 1] / (alpha * ln_zeta) if alpha * ln_zeta > 0 else 0.0
    return EnsembleFit(law, float(alpha), float(law.prefactor * ln_zeta), float(correlation), mean, samples)
