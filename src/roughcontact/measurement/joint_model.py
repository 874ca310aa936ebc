"""The likelihood of measured stiffnesses of a joint, and whether the model fits them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.special

from roughcontact.measurement.importance import Posterior, Prior
from roughcontact.measurement.joint_data import JointData
from roughcontact.measurement.joint_emulator import JointEmulator
from roughcontact.validation import Array

__all__ = ["DISCREPANCY", "JointModel", "discrepancy"]

DISCREPANCY = 0.05  # of K, relative: what separates a real joint from a Gaussian elastic one
DRAWN = 2000  # joints that a measurement is compared with
DECADE = math.log(10)  # of pressure, over which the discrepancy is correlated


def discrepancy(log_pressures: Array) -> Array:
    """Return the covariance of ln(K/A0) that separates real joints from the model, shape (n, n)."""
    apart = (log_pressures[:, None] - log_pressures) / DECADE
    return np.asarray(DISCREPANCY**2 * np.exp(-(apart**2) / 2))


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

    def inside(self, points: Array, log_pressures: Array) -> npt.NDArray[np.bool_]:
        """Return where all pressures are within those of the emulator, shape (m,)."""
        return self.margin(points, log_pressures) >= 0

    def margin(self, points: Array, log_pressures: Array) -> Array:
        """Return the distance of the pressures from the ends of the emulator in ln p, negative beyond, shape (m,)."""
        place = self.place(points, log_pressures)
        low, high = self.emulator.nodes[0], self.emulator.nodes[-1]
        return np.asarray(np.minimum(place.min(axis=1) - low, high - place.max(axis=1)))

    def stiffness(self, points: Array, log_pressures: Array) -> tuple[Array, Array]:
        """Return mean and covariance of ln(K/A0) over joints, shapes (m, n) and (m, n, n), discrepancy included."""
        _, rolloff, hurst, band, modulus = points.T
        side = math.sqrt(self.area) * np.exp(-rolloff)
        mean, covariance = self.emulator.at(hurst, side, np.exp(band), self.place(points, log_pressures))
        return mean + (modulus - rolloff)[:, None], covariance + discrepancy(log_pressures)

    def at(self, points: Array, data: JointData) -> tuple[Array, Array]:
        """Return mean and covariance of what is measured, its noise included, shapes (m, d) and (m, d, d)."""
        mean, covariance = data.observed(*self.stiffness(points, data.log_pressures))
        return mean, covariance + data.noise

    def log_likelihood(self, points: Array, data: JointData) -> Array:
        """Return the logarithm of the density of the measurement, shape (m,), without a constant.

        The covariance is itself estimated from `JointEmulator.freedom` specimens, hence a distribution of Student
        (Sellentin and Heavens 2016).
        """
        found = np.full(len(points), -np.inf)
        kept = self.inside(points, data.log_pressures)
        mean, covariance = self.at(points[kept], data)
        root = np.linalg.cholesky(covariance)
        residual = np.linalg.solve(root, (data.measured - mean)[:, :, None])[:, :, 0]
        squares = (residual**2).sum(axis=1)
        volume = np.log(np.diagonal(root, axis1=1, axis2=2)).sum(axis=1)
        free = self.emulator.freedom
        found[kept] = -volume - (free + data.measured.size) / 2 * np.log1p(squares / free)
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

    def p_value(self, data: JointData, prior: Prior | None, found: Posterior) -> tuple[float, str]:
        """Return the probability that a joint of the model departs as far in level, slope or curvature, and in which.

        Level, slope and curvature against ln p are compared with joints of the posterior, and the level with joints of
        the prior too, if one is given. The smallest of the probabilities counts, times their number.
        """
        size = data.measured.size
        at = np.log(data.pressures[-size:])
        contrasts = np.linalg.qr(np.vander(at - at.mean(), min(size, 3), increasing=True))[0].T / data.scale
        rng = np.random.default_rng(0)
        drawn = found.points[rng.choice(len(found.weights), DRAWN, p=found.weights)]
        chances = [
            (self._beyond(data, drawn, contrast), name)
            for name, contrast in zip(("level", "slope", "curvature"), contrasts, strict=False)
        ]
        if prior is not None:
            points = prior.draw(rng.random((DRAWN, prior.mean.size)))
            points = points[self.inside(points, data.log_pressures)]
            if len(points):
                chances.append((self._beyond(data, points, contrasts[0]), "level"))
        chance, departs = min(chances)
        return min(1.0, len(chances) * chance), departs

    def _beyond(self, data: JointData, points: Array, contrast: Array) -> float:
        """Return the probability that a contrast of other measurements is as far out as that of the data."""
        mean, covariance = self.at(points, data)
        departure = (data.measured - mean) @ contrast / np.sqrt(contrast @ covariance @ contrast)
        above = float(scipy.special.ndtr(departure).mean())
        return 2 * min(above, 1 - above)
