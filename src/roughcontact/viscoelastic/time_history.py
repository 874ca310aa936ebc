"""Checks of a load that varies in time."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.validation import Array, number

__all__ = ["checked_history"]


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
