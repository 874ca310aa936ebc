"""Stiffness per area of joints of Gaussian surfaces: mean and scatter, fitted to computed ensembles.

Lengths count in roll-off wavelengths l, heights in rms heights h, pressures and hardness in E* h/l and stiffnesses in
E*/l. A specimen is then described by its Hurst exponent, its side L/l and its band l/l_c, and on first loading of
surfaces that flow also by its hardness.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import numpy as np

from roughcontact.validation import Array

__all__ = [
    *("BAND", "FLOWING", "HURST", "LARGE", "LEAST_AREA", "SIDE", "SOFTEST"),
    *("JointEmulator", "flow_terms", "joint_emulator", "terms"),
]

HURST, SIDE, BAND = (0.3, 1.2), (4.0, 16.0), (4.0, 8.0)  # of the computed ensembles
LARGE = 32.0  # L/l of the joints at which the law of larger areas was measured
SOFTEST = 0.6  # hardness over E* h/l of the computed joints that flow
FLOWING = 0.5  # largest share of the joint that flows, p over hardness
LEAST_AREA = 64.0  # l^2: below, single asperities carry the joint


@dataclass(frozen=True, slots=True, eq=False)
class JointEmulator:
    """Mean and covariance of ln(K l/(E* A0)) over specimens, at nodes of ln(p l/(E* h)).

    Attributes
    ----------
    nodes : array, shape (n,)
        ln(p l/(E* h)), in equal steps.
    mean, deviation : array, shape (10, n)
        Coefficients of `terms`: of the mean, and of the logarithm of the standard deviation.
    correlation : array, shape (n, n)
        Of the nodes of one specimen.
    misfit : array, shape (n,)
        Standard deviation of the means of unseen ensembles about the fit, without their own scatter.
    departure : array, shape (n,)
        Mean of joints of `LARGE` less that of independent pieces.
    flow : array, shape (4,)
        Coefficients of `flow_terms`: mean of ln K on first loading of joints that flow, less that of elastic ones.
    flow_misfit : float
        Standard deviation of the means of joints that flow about it, relative to it.
    freedom : float
        Number of specimens behind the covariance, less one for each ensemble.
    inflation : float
        Factor of the covariance with which 90 % intervals cover 90 % of unseen specimens.
    """

    nodes: Array
    mean: Array
    deviation: Array
    correlation: Array
    misfit: Array
    departure: Array
    flow: Array
    flow_misfit: float
    freedom: float
    inflation: float

    def at(
        self, hurst: Array, side: Array, band: Array, pressure: Array, hardness: Array | None = None
    ) -> tuple[Array, Array]:
        """Return mean and covariance at ln(p l/(E* h)).

        Joints larger than the largest ensemble are made of independent pieces: their variance falls with the area, and
        the mean of the logarithm rises to the logarithm of the mean. Under light loads they are softer than that. This
        was measured at 1 024 l^2 and H = 0.8, and half of it counts as an error.

        Parameters
        ----------
        hurst, side, band : array, shape (m,)
            Of m specimens.
        pressure : array, shape (m, d)
            ln(p l/(E* h)), within the nodes.
        hardness : array, shape (m,), optional
            Logarithm of the hardness over E* h/l, on first loading; None for elastic joints.

        Returns
        -------
        mean : array, shape (m, d)
            Of ln(K l/(E* A0)).
        covariance : array, shape (m, d, d)
        """
        _, deviation, share, beyond = self._parts(hurst, side, band)
        weights = _weights(self.nodes, pressure)
        scatter = deviation * np.sqrt(self.inflation * share)
        unsure = beyond * self.departure / 2
        nodes = scatter[:, :, None] * self.correlation  # the largest array here, hence in place
        nodes *= scatter[:, None, :]
        nodes += np.diag(self.misfit**2)
        nodes += unsure[:, :, None] * unsure[:, None, :]
        covariance = weights @ nodes @ weights.swapaxes(1, 2)
        if hardness is not None:
            softer = flow_terms(pressure, hardness[:, None]) @ self.flow
            covariance = covariance + self.flow_misfit**2 * softer[:, :, None] * softer[:, None, :]
        return self.mean_at(hurst, side, band, pressure, hardness), covariance

    def mean_at(
        self, hurst: Array, side: Array, band: Array, pressure: Array, hardness: Array | None = None
    ) -> Array:
        """Return the mean of `at` without the covariance, which costs far more."""
        known, deviation, share, beyond = self._parts(hurst, side, band)
        mean = known @ self.mean + deviation**2 * (1 - share) / 2 + beyond * self.departure
        mean = (_weights(self.nodes, pressure) @ mean[:, :, None])[:, :, 0]
        if hardness is not None:
            mean = mean + flow_terms(pressure, hardness[:, None]) @ self.flow
        return np.asarray(mean)

    def _parts(self, hurst: Array, side: Array, band: Array) -> tuple[Array, Array, Array, Array]:
        """Return the terms, the standard deviations, and the parts of the largest ensemble and of pieces of it."""
        known = terms(hurst, np.minimum(side, SIDE[1]), band)
        share = np.minimum(SIDE[1] / side, 1)[:, None] ** 2  # of the variance of the largest ensemble
        return known, np.exp(known @ self.deviation), share, (1 - share) / (1 - (SIDE[1] / LARGE) ** 2)


def terms(hurst: Array, side: Array, band: Array) -> Array:
    """Return the polynomials of second degree in H, ln L/l and ln l/l_c, shape (m, 10), scaled to the ensembles."""
    axes = [
        2 * (x - low) / (high - low) - 1
        for x, (low, high) in (
            (np.asarray(hurst), HURST),
            (np.log(side), np.log(SIDE)),
            (np.log(band), np.log(BAND)),
        )
    ]
    products = [a * b for k, a in enumerate(axes) for b in axes[k:]]
    return np.stack([np.ones_like(axes[0]), *axes, *products], axis=-1)


def flow_terms(pressure: Array, hardness: Array) -> Array:
    """Return what the effect of flow on ln K is fitted with, shape (..., 4), for ln(p l/(E* h)) and the hardness alike.

    For hard joints it vanishes with one over the hardness; the last term is that of joints that flow in half.
    """
    over = np.exp(-hardness)
    p = np.exp(pressure)
    return np.stack(np.broadcast_arrays(over, over * np.sqrt(p), over * p, (over * p) ** 2), axis=-1)


@cache
def joint_emulator() -> JointEmulator:
    """Return the emulator of the package, see ``benchmarks/joint_table.py``."""
    table = json.loads(files(__package__).joinpath("joint_table.json").read_text(encoding="utf-8"))
    arrays = {name: np.array(value) for name, value in table.items() if isinstance(value, list)}
    return JointEmulator(**{**table, **arrays})


def _weights(nodes: Array, pressure: Array) -> Array:
    """Return the weights of cubic interpolation between even nodes, shape (m, d, number)."""
    place = (pressure - nodes[0]) / (nodes[1] - nodes[0])
    first = np.clip(np.floor(place).astype(int) - 1, 0, nodes.size - 4)
    t = place - first
    near = np.stack(
        [
            -(t - 1) * (t - 2) * (t - 3) / 6,
            t * (t - 2) * (t - 3) / 2,
            -t * (t - 1) * (t - 3) / 2,
            t * (t - 1) * (t - 2) / 6,
        ],
        axis=-1,
    )
    found = np.zeros((*place.shape, nodes.size))
    np.put_along_axis(found, first[..., None] + np.arange(4), near, axis=-1)
    return found
