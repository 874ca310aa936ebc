"""Checks of a load that varies in time."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.validation import Array, number
from roughcontact.viscoelastic.prony_series import Viscoelastic

__all__ = ["checked_band", "checked_history"]


def checked_history(times: Sequence[float] | Array, loads: Sequence[float] | Array) -> tuple[Array, Array]:
    """Return a history as arrays, or refuse numbers that are not finite and times that decrease.

    Parameters
    ----------
    times : array, shape (n,)
        Times [s].
    loads : array, shape (n,)
        Loads at these times.

    Returns
    -------
    times, loads : array, shape (n,)
        The same as float64.

    Raises
    ------
    ValueError
        If the numbers of loads and times differ, a number is not finite, or the times decrease.

    Examples
    --------
    >>> checked_history([0, 1], [2, 3])
    (array([0., 1.]), array([2., 3.]))
    """
    t, load = np.asarray(number(times, "times [s]")), np.asarray(number(loads, "loads"))
    if t.ndim != 1 or t.shape != load.shape or not len(t):
        raise InputError(f"a history needs one time for each load, not {t.shape} and {load.shape}")
    for name, values in (("times", t), ("loads", load)):
        if (wrong := values[~np.isfinite(values)]).size:
            raise InputError(f"{name} must be finite, not {wrong[0]}", place=name)
    if (back := np.nonzero(np.diff(t) < 0)[0]).size:
        raise about("times", f"must not decrease, as from {t[back[0]]:g} to {t[back[0] + 1]:g} s")
    return t, load


def checked_band(material: Viscoelastic, times: Array, loads: Array) -> None:
    """Refuse a history that depends on the material at times outside the band of its data.

    Parameters
    ----------
    material : Viscoelastic
    times, loads : array, shape (n,)
        A history of `checked_history`; the load is 0 before.

    Raises
    ------
    ValueError
        If the history lasts longer than the band, or a time follows sooner than its shortest time on a jump or on a
        change of the rate.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact import viscoelastic
    >>> gel = viscoelastic.power_law(1e5, 1.0, 0.3, band=(1e-2, 1e3))
    >>> checked_band(gel, np.array([0.0, 1.0, 900.0]), np.array([0.0, 1.0, 1.0]))
    """
    if material.band is None:
        return
    shortest, longest = material.band
    remedy = "change the times, measure in a wider band, or extrapolate with dataclasses.replace(material, band=None)"
    if (duration := times[-1] - times[0]) > longest * (1 + 1e-9):
        raise InputError(
            f"the history lasts {duration:g} s, and the data of the material end at {longest:g} s",
            remedy,
            "times",
        )
    if loads[0] or ((np.diff(times) == 0) & (np.diff(loads) != 0)).any():
        raise InputError(
            f"a sudden load needs the material before {shortest:g} s, where its data begin", remedy, "times"
        )
    start, rate = times[0], 0.0
    for i in range(1, len(times)):
        if (h := times[i] - times[i - 1]) == 0:
            continue
        new = (loads[i] - loads[i - 1]) / h
        if abs(new - rate) > 1e-6 * max(abs(new), abs(rate)):
            start, rate = times[i - 1], new
        if times[i] - start < shortest * (1 - 1e-9):
            raise InputError(
                f"the time {times[i]:g} s follows {times[i] - start:g} s after a change of the rate of the load, "
                f"and the data of the material begin at {shortest:g} s",
                remedy,
                "times",
            )
