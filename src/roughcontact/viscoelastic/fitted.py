"""Viscoelastic materials fitted to a DMA table or to a power law, by non-negative least squares on given times."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.optimize import nnls

from roughcontact.errors import InputError
from roughcontact.validation import Array, exactly_one, number, numeric, positive_scalar, require
from roughcontact.viscoelastic.conversions import Kind, reduced
from roughcontact.viscoelastic.prony_series import Viscoelastic

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["from_dma", "power_law"]

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
    >>> from roughcontact import Viscoelastic, viscoelastic
    >>> rubber = Viscoelastic(1e6, (2e6, 3e6), (0.01, 1.0))
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
    values = np.concatenate(table)
    weights, misfit = _fitted(np.column_stack([steady, columns]), values, values)
    facts = {"band": band, "temperature": temperature, "misfit": misfit}
    measured = _material(float(weights[0]), weights[1:], times, **facts)
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
    positive_scalar(modulus, "modulus")
    positive_scalar(time, "time")
    require(0 < exponent < 1, "exponent must be between 0 and 1", place="exponent", value=exponent)
    require(
        0 <= equilibrium < np.inf, "equilibrium must not be negative", place="equilibrium", value=equilibrium
    )
    low, high = Viscoelastic(1.0, band=band).band  # type: ignore[misc]  # checked there
    t = np.geomspace(low, high, 1 + round(SAMPLES * max(1.0, np.log10(high / low))))
    law = equilibrium + modulus * (t / time) ** -exponent
    # The last term is so long that it is a constant in the band.
    times = np.append(_times(band, terms_per_decade), high * BEYOND**4)
    weights, misfit = _fitted(np.exp(-np.divide.outer(t, times)), law - equilibrium, law)
    return _material(equilibrium, weights, times, band=band, misfit=misfit)


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


def _fitted(columns: Array, values: Array, scale: Array) -> tuple[Array, float]:
    """Return the weights that fit the values best, none negative, and the largest deviation relative to the scale."""
    size = np.linalg.norm(columns / scale[:, None], axis=0)  # balances the columns
    weights = nnls(columns / scale[:, None] / size, values / scale)[0] / size
    return weights, float(np.abs((columns @ weights - values) / scale).max())


def _material(equilibrium: float, weights: Array, times: Array, **facts: Any) -> Viscoelastic:
    """Return the material without the terms of zero weight."""
    kept = weights > 0
    return Viscoelastic(equilibrium, tuple(weights[kept]), tuple(times[kept]), **facts)
