"""Checks of a load that varies in time."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.validation import Array, number
from roughcontact.viscoelastic.prony_series import Viscoelastic, checked_material

__all__ = ["checked_history"]


def checked_history(
    material: Viscoelastic, times: Sequence[float] | Array, loads: Sequence[float] | Array
) -> tuple[Array, Array]:
    """Return a history as arrays, or refuse numbers that are not finite and times that decrease.

    Parameters
    ----------
    material : Viscoelastic
    times : array, shape (n,)
        Times [s].
    loads : array, shape (n,)
        Loads at these times; the load is 0 before.

    Returns
    -------
    times, loads : array, shape (n,)
        The same as float64.

    Raises
    ------
    ValueError
        If the numbers of loads and times differ, a number is not finite, the times decrease, the history lasts longer
        than the data of the material, or a time follows sooner than their shortest time on a jump or on a change of the
        rate.

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> checked_history(viscoelastic.power_law(1e5, 1.0, 0.3, band=(1e-2, 1e3)), [0, 1], [2, 3])
    (array([0., 1.]), array([2., 3.]))
    """
    checked_material(material)
    t, load = np.asarray(number(times, "times [s]")), np.asarray(number(loads, "loads"))
    if t.ndim != 1 or t.shape != load.shape or not len(t):
        raise InputError(f"a history needs one time for each load, not {t.shape} and {load.shape}")
    for name, values in (("times", t), ("loads", load)):
        if (wrong := values[~np.isfinite(values)]).size:
            raise InputError(f"{name} must be finite, not {wrong[0]}", place=name)
    if (back := np.nonzero(np.diff(t) < 0)[0]).size:
        raise about("times", f"must not decrease, as from {t[back[0]]:g} to {t[back[0] + 1]:g} s")
    if material.band is not None:
        _require_band(material.band, t, load)
    return t, load


def _require_band(band: tuple[float, float], t: Array, load: Array) -> None:
    """Refuse a history that depends on the material at other times than those of its data."""
    remedy = "change the times, measure in a wider band, or extrapolate with dataclasses.replace(material, band=None)"
    if (duration := t[-1] - t[0]) > band[1] * (1 + 1e-9):
        raise InputError(
            f"the history lasts {duration:g} s, and the data of the material end at {band[1]:g} s",
            remedy,
            "times",
        )
    start, rate = t[0], 0.0
    for i in range(1, len(t)):
        if t[i] == t[i - 1]:
            start = t[i]
            continue
        new = (load[i] - load[i - 1]) / (t[i] - t[i - 1])
        if abs(new - rate) > 1e-6 * max(abs(new), abs(rate)):
            start, rate = t[i - 1], new
        if t[i] - start < band[0] * (1 - 1e-9):
            raise InputError(
                f"the time {t[i]:g} s follows {t[i] - start:g} s after a change of the rate of the load, and the data "
                f"of the material begin at {band[0]:g} s",
                remedy,
                "times",
            )
