"""Viscoelastic materials fitted to a DMA table or to a power law, by non-negative least squares on given times."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import nnls

from roughcontact.errors import InputError
from roughcontact.validation import Array, exactly_one, number, numeric, positive_scalar, require
from roughcontact.viscoelastic.conversions import Kind, from_creep, reduced
from roughcontact.viscoelastic.prony_series import Viscoelastic

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["creep_power_law", "from_dma", "power_law"]

BEYOND = 10.0  # factor by which the times of the terms exceed the band; terms within it cannot fit its ends
SAMPLES = 20  # of a power law, per decade


@numeric(frequencies="Hz", angular_frequencies="rad/s", storage="Pa", loss="Pa", bulk="Pa", temperature="K")
def from_dma(
    storage: ArrayLike,
    loss: ArrayLike,
    *,
    frequencies: ArrayLike | None = None,
    angular_frequencies: ArrayLike | None = None,
    kind: Kind = "young",
    poisson: float | None = None,
    bulk: float | None = None,
    terms_per_decade: float = 3.0,
    temperature: float | None = None,
) -> Viscoelastic:
    """Return the reduced modulus of a body from a table of dynamic mechanical analysis.

    A Prony series with logarithmically spaced times is fitted to storage and loss modulus by non-negative least
    squares of the relative deviations. It is then converted exactly to the reduced modulus.

    Parameters
    ----------
    storage, loss : array, shape (n,)
        Storage and loss modulus [Pa], positive.
    frequencies : array, shape (n,), optional
        Frequencies [Hz].
    angular_frequencies : array, shape (n,), optional
        Angular frequencies [rad/s]. Give one of the two.
    kind : str
        The modulus that was measured: ``"young"``, ``"shear"`` or ``"reduced"``.
    poisson : float, optional
        Poisson's ratio if it is constant in time [-].
    bulk : float, optional
        Bulk modulus if it is constant in time [Pa]. Give one of the two, except with ``"reduced"``.
    terms_per_decade : float
        Times of the fit per decade of frequency. Terms of zero weight are left out.
    temperature : float, optional
        Temperature of the measurement [K].

    Returns
    -------
    Viscoelastic
        Its ``band`` goes from 1/omega_max to 1/omega_min, and ``misfit`` is the largest relative deviation of a storage
        or loss modulus of the table.

    Raises
    ------
    ValueError
        If the table has fewer than three frequencies, a value is not positive, or kind and constants do not agree.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact import viscoelastic
    >>> rubber = viscoelastic.prony(1e6, [2e6, 3e6], [0.01, 1.0])
    >>> omega = np.geomspace(0.1, 1e3, 20)
    >>> measured = rubber.complex_modulus(omega)
    >>> body = viscoelastic.from_dma(
    ...     measured.real, measured.imag, angular_frequencies=omega, kind="young", poisson=0.5
    ... )
    >>> body.misfit < 0.02, [f"{time:g} s" for time in body.band]
    (True, ['0.001 s', '10 s'])
    >>> f"{float(body.relaxation(1.0)) / float(rubber.relaxation(1.0)):.3f}"  # 1/(1 - nu^2) = 1.333
    '1.333'
    """
    name, given = exactly_one(frequencies=frequencies, angular_frequencies=angular_frequencies)
    w = np.atleast_1d(number(given, name)) * (2 * np.pi if name == "frequencies" else 1.0)
    table = np.atleast_1d(number(storage, "storage")), np.atleast_1d(number(loss, "loss"))
    if w.ndim != 1 or not w.shape == table[0].shape == table[1].shape or len(set(w.tolist())) < 3:
        raise InputError(
            "a DMA table needs storage and loss at three or more frequencies, not arrays of shapes "
            f"{table[0].shape}, {table[1].shape} and {w.shape}",
            place=f"{name}, storage, loss",
        )
    for what, values in ((name, w), ("storage", table[0]), ("loss", table[1])):
        require(
            (values > 0) & (values < np.inf),
            f"{what} must be positive",
            "leave out the rows of the table in which it is not",
            place=what,
            value=values,
        )
    band = 1 / float(w.max()), 1 / float(w.min())
    times = _times(band, terms_per_decade)
    x = np.multiply.outer(w, times)
    columns = np.concatenate([x**2 / (1 + x**2), x / (1 + x**2)])
    steady = np.concatenate([np.ones_like(w), np.zeros_like(w)])
    (equilibrium, *moduli), misfit = _fitted(np.column_stack([steady, columns]), np.concatenate(table))
    measured = Viscoelastic(*_kept(equilibrium, moduli, times), 0.0, band, temperature, misfit)
    return reduced(measured, kind, poisson=poisson, bulk=bulk)


@numeric(modulus="Pa", time="s", equilibrium="Pa", band="s")
def power_law(
    modulus: float,
    time: float,
    exponent: float,
    *,
    band: tuple[float, float],
    equilibrium: float = 0.0,
    terms_per_decade: float = 2.0,
) -> Viscoelastic:
    """Return ``E(t) = E_inf + modulus (t/time)^-exponent`` in a band of times, by Prony terms.

    Parameters
    ----------
    modulus : float
        Reduced modulus of the power law at `time` [Pa].
    time : float
        Reference time [s].
    exponent : float
        Between 0 and 1 [-].
    band : tuple of float
        Shortest and longest time [s].
    equilibrium : float
        E_inf [Pa].
    terms_per_decade : float
        Terms per decade of time.

    Returns
    -------
    Viscoelastic
        ``misfit`` is the largest relative error of E(t) in the band.

    Raises
    ------
    ValueError
        If a number is out of range.

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> gel = viscoelastic.power_law(1e5, 1.0, 0.3, band=(1e-3, 1e3))
    >>> round(float(gel.relaxation(100.0))), gel.misfit < 2e-3
    (25113, True)
    """
    t, law = _power_law(modulus, time, -exponent, band, equilibrium, "equilibrium")
    times = _long_times(band, terms_per_decade)
    elements = np.exp(-np.divide.outer(t, times))
    weights, misfit = _fitted(elements, law - equilibrium, law)
    return Viscoelastic(*_kept(equilibrium, weights, times), 0.0, band, None, misfit)


@numeric(compliance="Pa^-1", time="s", instantaneous="Pa^-1", band="s")
def creep_power_law(
    compliance: float,
    time: float,
    exponent: float,
    *,
    band: tuple[float, float],
    instantaneous: float = 0.0,
    terms_per_decade: float = 2.0,
) -> Viscoelastic:
    """Return ``J(t) = J_0 + compliance (t/time)^exponent`` in a band of times, by retarded terms.

    Parameters
    ----------
    compliance : float
        Reduced compliance of the power law at `time` [1/Pa].
    time : float
        Reference time [s].
    exponent : float
        Between 0 and 1 [-].
    band : tuple of float
        Shortest and longest time [s].
    instantaneous : float
        J_0 [1/Pa].
    terms_per_decade : float
        Terms per decade of time.

    Returns
    -------
    Viscoelastic
        ``misfit`` is the largest relative error of J(t) in the band.

    Raises
    ------
    ValueError
        If a number is out of range.

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> rock = viscoelastic.creep_power_law(1e-11, 3600.0, 0.2, band=(60.0, 1e7), instantaneous=2e-11)
    >>> f"{float(rock.creep()(3600.0)):.2e} 1/Pa", rock.misfit < 2e-3
    ('3.00e-11 1/Pa', True)
    """
    t, law = _power_law(compliance, time, exponent, band, instantaneous, "instantaneous")
    times = _long_times(band, terms_per_decade)
    retarded = -np.expm1(-np.divide.outer(t, times))
    (more, *weights), misfit = _fitted(np.column_stack([np.ones_like(t), retarded]), law - instantaneous, law)
    return replace(from_creep(*_kept(instantaneous + more, weights, times)), band=band, misfit=misfit)


def _power_law(
    factor: float, time: float, exponent: float, band: tuple[float, float], constant: float, name: str
) -> tuple[Array, Array]:
    """Return times in the band and the law at them, or refuse its numbers."""
    positive_scalar(factor, "modulus" if exponent < 0 else "compliance")
    positive_scalar(time, "time")
    require(0 < abs(exponent) < 1, "exponent must be between 0 and 1", place="exponent", value=abs(exponent))
    require(0 <= constant < np.inf, f"{name} must not be negative", place=name, value=constant)
    low, high = Viscoelastic(1.0, band=band).band  # type: ignore[misc]  # checked there
    t = np.geomspace(low, high, 1 + round(SAMPLES * max(1.0, np.log10(high / low))))
    return t, constant + factor * (t / time) ** exponent


def _times(band: tuple[float, float], per_decade: float) -> Array:
    """Return the times of the terms, beyond both ends of the band."""
    require(
        0.1 <= per_decade <= 20,
        "terms_per_decade must lie between 0.1 and 20",
        place="terms_per_decade",
        value=per_decade,
    )
    low, high = band[0] / BEYOND, band[1] * BEYOND
    return np.geomspace(low, high, 1 + round(per_decade * np.log10(high / low)))


def _long_times(band: tuple[float, float], per_decade: float) -> Array:
    """Return the times of the terms, and one so long that its term is a constant or a flow within the band."""
    return np.append(_times(band, per_decade), band[1] * BEYOND**4)


def _fitted(columns: Array, values: Array, scale: Array | None = None) -> tuple[list[float], float]:
    """Return the weights that fit the values best, none negative, and the largest deviation relative to the scale."""
    scale = values if scale is None else scale
    size = np.linalg.norm(columns / scale[:, None], axis=0)  # balances the columns
    weights = nnls(columns / scale[:, None] / size, values / scale)[0] / size
    return weights.tolist(), float(np.abs((columns @ weights - values) / scale).max())


def _kept(
    constant: float, weights: list[float], times: Array
) -> tuple[float, tuple[float, ...], tuple[float, ...]]:
    """Return the constant, and weights and times of the terms that are not 0."""
    kept = [(weight, time) for weight, time in zip(weights, times.tolist(), strict=True) if weight]
    return constant, tuple(weight for weight, _ in kept), tuple(time for _, time in kept)
