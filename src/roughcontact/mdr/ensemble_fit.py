"""The power law of an ensemble of stiffness curves, and how certain it is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from roughcontact.contact.power_law import PowerLaw, fit_power_law

__all__ = ["EnsembleFit", "fit_ensemble"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class EnsembleFit:
    """A power law of a mean stiffness with the standard errors that the scatter of the samples leaves.

    Attributes
    ----------
    law : PowerLaw
        Through the means.
    exponent_error : float
        Standard error of the exponent alpha.
    prefactor_error : float
        Standard error of the prefactor zeta.
    correlation : float
        Of the errors of alpha and of ln zeta: near 1, since zeta is read off at a dimensionless force of 1,
        far outside the window. Compare laws at a force inside, not by their zetas alone.
    mean : {"arithmetic", "geometric"}
        Which mean over the samples.
    samples : int
        Number of samples.
    """

    law: PowerLaw
    exponent_error: float
    prefactor_error: float
    correlation: float
    mean: Literal["arithmetic", "geometric"]
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
        a, b = self.exponent_error, self.prefactor_error / self.prefactor
        variance = (a * x) ** 2 + 2 * self.correlation * a * b * x + b**2
        return np.asarray(self.law.stiffness(force) * np.sqrt(variance))


def fit_ensemble(
    force: Array,
    stiffness: Array,
    scales: tuple[float, float],
    mean: Literal["arithmetic", "geometric"] = "arithmetic",
) -> EnsembleFit:
    """Return the straight line through the logarithm of the mean stiffness over ln F by least squares.

    Parameters
    ----------
    force : array, shape (loads,)
        Forces [N].
    stiffness : array, shape (samples, loads)
        Stiffness [N/m] of every sample at these forces.
    scales : tuple of float
        E* h L [N] and E* L [N/m].
    mean : {"arithmetic", "geometric"}
        Which mean over the samples.

    Notes
    -----
    Exponent and ln zeta are linear in the logarithms of the means. What a sample adds to such a logarithm is
    ``k/mean(k) - 1``, or ``ln k - mean(ln k)`` of a geometric mean, and samples are independent while the forces of
    one sample are not: the standard errors come from what each sample adds to the two parameters as a whole.
    """
    samples = len(stiffness)
    if mean == "arithmetic":
        means = stiffness.mean(axis=0)
        share = stiffness / means - 1
    else:
        logs = np.log(stiffness)
        means = np.exp(logs.mean(axis=0))
        share = logs - logs.mean(axis=0)
    law = fit_power_law(force, means, *scales)
    x = np.log(force / scales[0])
    parameters = share @ np.linalg.pinv(np.stack([x, np.ones_like(x)], axis=1)).T
    if samples < 2:
        return EnsembleFit(law, np.nan, np.nan, np.nan, mean, samples)
    covariance = np.cov(parameters, rowvar=False) / samples
    alpha, ln_zeta = np.sqrt(np.diag(covariance))
    correlation = covariance[0, 1] / (alpha * ln_zeta) if alpha * ln_zeta > 0 else 0.0
    return EnsembleFit(law, float(alpha), float(law.prefactor * ln_zeta), float(correlation), mean, samples)
