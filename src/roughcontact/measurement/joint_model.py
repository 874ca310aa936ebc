"""The likelihood of measured stiffnesses of a joint, and whether the model fits them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.special

from roughcontact.measurement.importance import Posterior, Prior
from roughcontact.measurement.joint_data import JointData
from roughcontact.measurement.joint_emulator import FLOWING, SOFTEST, JointEmulator
from roughcontact.validation import Array

__all__ = ["DISCREPANCY", "DRAWN", "UNLIKELY", "JointModel", "discrepancy"]

DISCREPANCY = 0.05  # of K, relative: what separates a real joint from a Gaussian elastic one
UNLIKELY = 0.02  # probability of a measurement below which the model is refused
DRAWN = 2000  # joints that a measurement is compared with
DECADE = math.log(10)  # of pressure, over which the discrepancy is correlated


def discrepancy(log_pressures: Array) -> Array:
    """Return the covariance of ln(K/A0) that separates real joints from the model, shape (n, n)."""
    apart = (log_pressures[:, None] - log_pressures) / DECADE
    return np.asarray(DISCREPANCY**2 * np.exp(-(apart**2) / 2))


@dataclass(frozen=True, slots=True, eq=False)
class JointModel:
    """Stiffness of a joint of a given area as a function of `PARAMETERS`, the hardness if it flows.

    Attributes
    ----------
    emulator : JointEmulator
    area : float
        Nominal area [m^2].
    carrying : float
        Share of it that carries the joint: the crests of a waviness. In between, the faces do not touch.
    """

    emulator: JointEmulator
    area: float
    carrying: float = 1.0

    def place(self, points: Array, log_pressures: Array) -> Array:
        """Return ln(p l/(E* h)) where the joint carries, shape (m, d), for points of shape (m, 5 or 6) and ln p."""
        return np.asarray(log_pressures - math.log(self.carrying) - _scale(points)[:, None])

    def inside(self, points: Array, log_pressures: Array) -> npt.NDArray[np.bool_]:
        """Return where all pressures are within those of the emulator, shape (m,)."""
        return self.margin(points, log_pressures) >= 0

    def margin(self, points: Array, log_pressures: Array) -> Array:
        """Return the distance of the pressures from the ends of the emulator in ln p, negative beyond, shape (m,)."""
        place = self.place(points, log_pressures)
        least, most = place.min(axis=1), place.max(axis=1)
        found = np.minimum(least - self.emulator.nodes[0], self.emulator.nodes[-1] - most)
        hardness = _hardness(points)
        if hardness is not None:
            found = np.minimum(found, hardness + math.log(FLOWING) - most)
            found = np.minimum(found, hardness - math.log(SOFTEST))
        return np.asarray(found)

    def stiffness(self, points: Array, log_pressures: Array) -> tuple[Array, Array]:
        """Return mean and covariance of ln(K/A0) over joints, shapes (m, n) and (m, n, n), discrepancy included."""
        mean, covariance = self.emulator.at(
            *self._of(points), self.place(points, log_pressures), _hardness(points)
        )
        level = points[:, 4] - points[:, 1] + math.log(self.carrying)
        return mean + level[:, None], covariance + discrepancy(log_pressures)

    def _of(self, points: Array) -> tuple[Array, Array, Array]:
        """Return what the emulator needs of the topography: H, L/l and l/l_c."""
        _, rolloff, hurst, band = points.T[:4]
        return hurst, math.sqrt(self.area * self.carrying) * np.exp(-rolloff), np.exp(band)

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
        mean = self.emulator.mean_at(*self._of(points), shift + step, _hardness(points))
        return np.asarray((mean[:, 1] - mean[:, 0]) / (step[1] - step[0]))

    def p_value(self, data: JointData, prior: Prior | None, found: Posterior) -> tuple[float, str]:
        """Return the probability that a joint of the model departs as far in level, slope or curvature, and in which.

        Level, slope and curvature against ln p are compared with joints of the posterior, and the level with joints of
        the prior too, if one is given. The smallest of the probabilities counts, times their number.
        """
        rng = np.random.default_rng(0)
        drawn = found.points[rng.choice(len(found.weights), DRAWN, p=found.weights)]
        chances = [(chance, name) for name, chance in self.chances(data, drawn).items()]
        if prior is not None:
            points = prior.draw(rng.random((DRAWN, prior.mean.size)))
            points = points[self.inside(points, data.log_pressures)]
            if len(points):
                chances.append((self.chances(data, points)["level"], "level"))
        chance, departs = min(chances)
        return min(1.0, len(chances) * chance), departs

    def chances(self, data: JointData, points: Array) -> dict[str, float]:
        """Return the probabilities that level, slope and curvature of measurements of joints are as far out."""
        size = data.measured.size
        at = np.log(data.pressures[-size:])
        contrasts = np.linalg.qr(np.vander(at - at.mean(), min(size, 3), increasing=True))[0].T / data.scale
        mean, covariance = self.at(points, data)
        departure = (data.measured - mean) @ contrasts.T
        scatter = np.sqrt(np.einsum("ki,mij,kj->mk", contrasts, covariance, contrasts))
        above = scipy.special.ndtr(departure / scatter).mean(axis=0)
        both = 2 * np.minimum(above, 1 - above)
        return dict(zip(("level", "slope", "curvature"), both.tolist(), strict=False))


def _scale(points: Array) -> Array:
    """Return ln(E* h/l)."""
    return np.asarray(points[:, 4] + points[:, 0] - points[:, 1])


def _hardness(points: Array) -> Array | None:
    """Return the logarithm of the hardness over E* h/l, if the points have a hardness."""
    return points[:, 5] - _scale(points) if points.shape[1] > 5 else None
