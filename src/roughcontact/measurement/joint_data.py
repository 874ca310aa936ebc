"""What is measured at a joint: stiffnesses, or closures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from roughcontact.cached import cached_property
from roughcontact.errors import InputError
from roughcontact.theory.joints.ultrasound import stiffness_from_reflection
from roughcontact.units import in_si
from roughcontact.validation import Array, number, numeric, positive, require, require_numbers

__all__ = ["JointClosures", "JointData", "JointStiffness"]

_ERRORS = ("errors", "resolution")
NODES = 4  # of a rule of Gauss and Legendre, over the logarithm of the pressure from load to load


class JointData(Protocol):
    """A measurement, as a function of the stiffness of the joint at some pressures."""

    @property
    def pressures(self) -> Array:
        """Nominal pressures of the loads [Pa]; those of the measured values are the last d."""
        ...

    @property
    def measured(self) -> Array:
        """The measured values, shape (d,)."""
        ...

    @property
    def noise(self) -> Array:
        """Covariance of their errors, shape (d, d)."""
        ...

    @property
    def scale(self) -> Array | float:
        """What departures of the values count in, so that they are relative."""
        ...

    @property
    def log_pressures(self) -> Array:
        """Logarithms ln p at which the values depend on the stiffness, shape (n,)."""
        ...

    def observed(self, mean: Array, covariance: Array) -> tuple[Array, Array]:
        """Return mean and covariance of the values for those of ln(K/A0), shapes (m, n) and (m, n, n)."""
        ...


@dataclass(frozen=True, eq=False)
class JointStiffness:
    """Measured interfacial stiffness per area of a joint against nominal pressure.

    Parameters
    ----------
    pressures : array, shape (d,)
        Nominal pressures [Pa].
    stiffness : array, shape (d,)
        K/A0 [Pa/m], without the compliance of the bodies.
    errors : float or array, shape (d,)
        Relative standard deviations, independent of each other.
    gain : float
        Relative standard deviation of an error that all values share, such as that of a calibration.

    Raises
    ------
    ValueError
        If a value is not positive, or the numbers of values differ.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.JointStiffness(pressures=[5e6, 10e6], stiffness=[11e12, 21e12], errors=0.05).errors.tolist()
    [0.05, 0.05]
    """

    pressures: Array
    stiffness: Array
    errors: Array
    gain: float = 0.0

    def __post_init__(self) -> None:
        _take(self, pressures="Pa", stiffness="Pa/m", errors=None)
        object.__setattr__(self, "gain", float(positive(number(self.gain, "gain"), "gain", zero=True)))

    @classmethod
    @numeric(pressures="Pa", frequency="Hz", impedances="Pa*s/m")
    def from_reflection(
        cls,
        pressures: Array,
        reflected: Array,
        error: float | Array,
        *,
        frequency: float,
        impedances: tuple[float, float],
        gain: float = 0.0,
    ) -> JointStiffness:
        """Return the stiffness by the measured reflection of ultrasound.

        Parameters
        ----------
        pressures : array, shape (d,)
            Nominal pressures [Pa].
        reflected : array, shape (d,)
            Size of the reflection [-].
        error : float or array, shape (d,)
            Standard error of the reflection [-].
        frequency : float
            [Hz].
        impedances : tuple of float
            Acoustic impedances of both bodies [Pa s/m].
        gain : float
            As of the stiffness.

        Returns
        -------
        JointStiffness

        Raises
        ------
        ValueError
            As `theory.ultrasound.stiffness_from_reflection`, and if the error is not positive.

        Examples
        --------
        >>> import roughcontact as rc
        >>> data = rc.JointStiffness.from_reflection(
        ...     [5e6, 10e6], [0.96, 0.9], 0.005, frequency=2e6, impedances=(46.2e6, 46.2e6)
        ... )
        >>> (data.stiffness / 1e12).round().tolist(), data.errors.round(3).tolist()
        ([85.0, 141.0], [0.066, 0.029])
        """
        positive(number(error, "error"), "error")
        stiffness, deviation = stiffness_from_reflection(reflected, frequency, impedances, error)
        return cls(pressures, stiffness, deviation / stiffness, gain)

    @property
    def measured(self) -> Array:
        """Logarithms ln(K/A0), shape (d,)."""
        return np.log(self.stiffness)

    @property
    def noise(self) -> Array:
        """Covariance of the errors of ln(K/A0), shape (d, d)."""
        return np.diag(self.errors**2) + self.gain**2

    @property
    def scale(self) -> float:
        """1, since logarithms are measured."""
        return 1.0

    @property
    def log_pressures(self) -> Array:
        """Logarithms ln p, shape (d,)."""
        return np.log(self.pressures)

    def observed(self, mean: Array, covariance: Array) -> tuple[Array, Array]:
        """Return mean and covariance of the measured values: both as they are.

        Parameters
        ----------
        mean : array, shape (m, n)
            Of ln(K/A0) at `log_pressures`, of m joints.
        covariance : array, shape (m, n, n)

        Returns
        -------
        mean : array, shape (m, d)
            Of what is measured.
        covariance : array, shape (m, d, d)

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> data = rc.JointStiffness([5e6, 10e6], [11e12, 21e12], errors=0.05)
        >>> data.observed(np.full((1, 2), 30.0), np.zeros((1, 2, 2)))[0].tolist()
        [[30.0, 30.0]]
        """
        return mean, covariance


@dataclass(frozen=True, eq=False)
class JointClosures:
    """Measured closure of a joint against nominal pressure; the stiffness is not differenced from it.

    Parameters
    ----------
    pressures : array, shape (d,)
        Nominal pressures [Pa], increasing.
    closures : array, shape (d,)
        Decrease of the distance between two points of the bodies [m], from any origin.
    resolution : float or array, shape (d,)
        Standard deviation of the errors of the closures [m], independent of each other.
    compliance : float
        Of machine and bodies between the two points, closure over nominal pressure [m/Pa]; its closure is subtracted.
    compliance_error : float
        Standard deviation of the compliance [m/Pa].

    Raises
    ------
    ValueError
        If there are fewer than two loads, the pressures do not increase, or a value is not positive.

    Examples
    --------
    >>> import roughcontact as rc
    >>> data = rc.JointClosures([5e6, 10e6], [2e-6, 2.4e-6], resolution=1e-8, compliance=1e-14)
    >>> data.measured.round(9).tolist()  # from the first load on
    [3.5e-07]
    """

    pressures: Array
    closures: Array
    resolution: Array
    compliance: float = 0.0
    compliance_error: float = 0.0

    def __post_init__(self) -> None:
        require_numbers(self, compliance="m/Pa", compliance_error="m/Pa")
        _take(self, pressures="Pa", closures="m", resolution="m")
        for name in ("compliance", "compliance_error"):
            positive(getattr(self, name), name, zero=True)
        require(
            self.pressures.size > 1 and bool((np.diff(self.pressures) > 0).all()),
            "closures need two or more pressures that increase",
            "give the loads of one branch in the order of increasing pressure",
            place="pressures",
        )

    @property
    def measured(self) -> Array:
        """Closure of the joint since the first load [m], shape (d - 1,)."""
        since = self.closures - self.closures[0] - self.compliance * (self.pressures - self.pressures[0])
        return np.asarray(since[1:])

    @property
    def noise(self) -> Array:
        """Covariance of their errors [m^2]; that of the first load is in all of them."""
        since = self.pressures[1:] - self.pressures[0]
        first = self.resolution[0] ** 2
        shared = self.compliance_error**2 * np.outer(since, since)
        return np.asarray(np.diag(self.resolution[1:] ** 2) + first + shared)

    @property
    def scale(self) -> Array:
        """The closures."""
        return np.abs(self.measured)

    @cached_property
    def _rule(self) -> tuple[Array, Array]:
        """Nodes ln p between the loads, and their weights in ``int dp/K``."""
        ends = np.log(self.pressures)
        nodes, weights = np.polynomial.legendre.leggauss(NODES)
        middle, half = (ends[1:] + ends[:-1]) / 2, np.diff(ends) / 2
        at = middle[:, None] + half[:, None] * nodes
        steps = np.exp(at) * half[:, None] * weights  # dp = p dln p
        return at.ravel(), steps.ravel()

    @property
    def log_pressures(self) -> Array:
        """Logarithms ln p of the nodes between the loads."""
        return self._rule[0]

    def observed(self, mean: Array, covariance: Array) -> tuple[Array, Array]:
        """Return mean and covariance of the closures, to the second and the first order of the scatter of ln(K/A0).

        Parameters
        ----------
        mean : array, shape (m, n)
            Of ln(K/A0) at `log_pressures`, of m joints.
        covariance : array, shape (m, n, n)

        Returns
        -------
        mean : array, shape (m, d)
            Of what is measured.
        covariance : array, shape (m, d, d)

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> data = rc.JointClosures([5e6, 10e6], [2e-6, 2.4e-6], resolution=1e-8)
        >>> mean, _ = data.observed(np.full((1, 4), np.log(1e13)), np.zeros((1, 4, 4)))
        >>> f"{mean[0, 0]:.1e} m"  # 5 MPa over 1e13 Pa/m
        '5.0e-07 m'
        """
        steps = self._rule[1] * np.exp(-mean)
        bent = 1 + np.diagonal(covariance, axis1=1, axis2=2) / 2
        scatter = _up_to_each_load(steps[:, :, None] * covariance * steps[:, None, :])
        return _up_to_each_load(steps * bent), _up_to_each_load(scatter.swapaxes(1, 2))


def _up_to_each_load(steps: Array) -> Array:
    """Return sums along the last axis, from the first load to each."""
    return np.cumsum(steps.reshape(*steps.shape[:-1], -1, NODES).sum(axis=-1), axis=-1)


def _take(body: Any, **units: str | None) -> None:
    """Make fields of a measurement arrays in SI with a value for each pressure; one error holds for all loads."""
    size = np.size(body.pressures)
    for name, unit in units.items():
        values = np.atleast_1d(number(in_si(getattr(body, name), unit, name), name))
        if values.shape != (size,) and not (name in _ERRORS and values.size == 1):
            raise InputError(
                f"{name} must have a value for each of {size} pressures, not {values.size}", place=name
            )
        if name != "closures":
            positive(values, name)
        object.__setattr__(body, name, np.broadcast_to(values, (size,)).astype(np.float64))
