"""The likelihood of measured stiffnesses of a joint, and whether the model fits them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy.special

from roughcontact.measurement.importance import Posterior, Prior
from roughcontact.measurement.joint_emulator import JointEmulator
from roughcontact.validation import Array

__all__ = ["DISCREPANCY", "JointModel"]

DISCREPANCY = 0.05  # of K, relative: what separates a real joint from a Gaussian elastic one
DECADE = math.log(10)  # of pressure, over which the discrepancy is correlated


@dataclass(frozen=True, slots=True, eq=False)
class JointModel:
    """Stiffness of a joint of a given area as a function of `PARAMETERS`.

    Attributes
    ----------
    emulator : JointEmulator
    area : float
        Nominal area [m^2].
    """

    emulator: JointEmulator
    area: float

    def place(self, points: Array, log_pressures: Array) -> Array:
        """Return ln(p l/(E* h)), shape (m, d), for points of shape (m, 5) and ln p of shape (d,)."""
        rms, rolloff, _, _, modulus = points.T
        return np.asarray(log_pressures + (rolloff - modulus - rms)[:, None])

    def inside(self, points: Array, log_pressures: Array) -> Array:
        """Return where all loads are within those of the emulator, shape (m,)."""
        place = self.place(points, log_pressures)
        low, high = self.emulator.nodes[0], self.emulator.nodes[-1]
        return np.asarray(((place >= low) & (place <= high)).all(axis=1))

    def at(self, points: Array, log_pressures: Array) -> tuple[Array, Array]:
        """Return mean and covariance of ln(K/A0) over joints, shapes (m, d) and (m, d, d), discrepancy included."""
        _, rolloff, hurst, band, modulus = points.T
        side = math.sqrt(self.area) * np.exp(-rolloff)
        mean, covariance = self.emulator.at(hurst, side, np.exp(band), self.place(points, log_pressures))
        apart = (log_pressures[:, None] - log_pressures) / DECADE
        return mean + (modulus - rolloff)[:, None], covariance + DISCREPANCY**2 * np.exp(-(apart**2) / 2)

    def log_likelihood(self, points: Array, log_pressures: Array, measured: Array, noise: Array) -> Array:
        """Return the logarithm of the density of measured ln(K/A0), shape (m,).

        The covariance is itself a sample of `JointEmulator.freedom` specimens, hence a distribution of Student
        (Sellentin and Heavens 2016).
        """
        found = np.full(len(points), -np.inf)
        kept = self.inside(points, log_pressures)
        mean, covariance = self.at(points[kept], log_pressures)
        root = np.linalg.cholesky(covariance + noise)
        residual = np.linalg.solve(root, (measured - mean)[:, :, None])[:, :, 0]
        squares = (residual**2).sum(axis=1)
        volume = np.log(np.diagonal(root, axis1=1, axis2=2)).sum(axis=1)
        free = self.emulator.freedom
        found[kept] = -volume - (free + measured.size) / 2 * np.log1p(squares / free)
        return found

    def exponent(self, points: Array, log_pressure: float) -> Array:
        """Return dln K/dln p at a pressure, shape (m,)."""
        step = np.array([-0.25, 0.25])
        low, high = self.emulator.nodes[0], self.emulator.nodes[-1]
        shift = np.clip(self.place(points, np.array([log_pressure])), low + step[1], high - step[1])
        _, rolloff, hurst, band, _ = points.T
        side = math.sqrt(self.area) * np.exp(-rolloff)
        mean, _ = self.emulator.at(hurst, side, np.exp(band), shift + step)
        return np.asarray((mean[:, 1] - mean[:, 0]) / (step[1] - step[0]))

    def p_value(
        self, prior: Prior | None, found: Posterior, log_pressures: Array, measured: Array, noise: Array
    ) -> tuple[float, str]:
        """Return the probability that a joint of the model departs as far in level, slope or curvature, and in which.

        Slope and curvature of ln K against ln p are compared with joints of the posterior, the level with joints of the
        prior, if one is given. The smallest of the probabilities counts, times their number.
        """
        contrasts = np.linalg.qr(np.vander(log_pressures - log_pressures.mean(), 3, increasing=True))[0].T
        chances: dict[str, float] = {}
        rows = np.random.default_rng(0).choice(len(found.weights), 2000, p=found.weights)
        mean, covariance = self.at(found.points[rows], log_pressures)
        for name, contrast in list(zip(("level", "slope", "curvature"), contrasts, strict=False))[
            1 : measured.size
        ]:
            chances[name] = float(
                _beyond((measured - mean) @ contrast, contrast @ (covariance + noise) @ contrast)
            )
        if prior is not None:
            points = prior.draw(np.random.default_rng(0).random((4000, prior.mean.size)))
            points = points[self.inside(points, log_pressures)]
            mean, covariance = self.at(points, log_pressures)
            level = contrasts[0]
            chances["level"] = float(_beyond((measured - mean) @ level, level @ (covariance + noise) @ level))
        worst = min(chances, key=lambda name: chances[name])
        return min(1.0, len(chances) * chances[worst]), worst


def _beyond(departure: Array, variance: Array) -> float:
    """Return the probability that normal departures of draws are as far from zero, on either side."""
    above = float(scipy.special.ndtr(departure / np.sqrt(variance)).mean())
    return 2 * min(above, 1 - above)
