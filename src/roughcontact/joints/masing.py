"""A steady cycle of shear at constant normal pressure, from the backbone by Masing's rule."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughcontact.guesses import hinted
from roughcontact.validation import Array

__all__ = ["ROUNDING", "ShearCycle", "distance_slid", "masing_cycle"]

ROUNDING = 1e-12  # of a traction
_POINTS = 101  # of a branch of a cycle


@hinted
@dataclass(frozen=True, slots=True, eq=False)
class ShearCycle:
    """A steady cycle of tangential loading at constant nominal pressure, per nominal area.

    Attributes
    ----------
    displacement, traction : array, shape (n,)
        The closed loop [m], [Pa]: from the largest displacement to its opposite and back.
    loss : float
        Energy dissipated per cycle [J/m^2].
    damping : float
        Loss over 4 pi times the energy tau s/2 at the reversal: the equivalent damping ratio of only the interface.
        The modal damping of a structure is the loss over 4 pi times the energy of the whole structure.

    Examples
    --------
    >>> import roughcontact as rc
    >>> steel = rc.Solid(210e9, 0.3)
    >>> curve = rc.loading_curve(rc.examples.surface("ground"), (steel, steel), pressures=[1e6, 1e7, 3e7, 1e8])
    >>> cycle = rc.shear_law(curve, (steel, steel), friction=0.2).cycle(5e7, traction=5e6)
    >>> f"{cycle.loss:.2g} J/m^2, damping {cycle.damping:.3f}"
    '0.088 J/m^2, damping 0.063'
    """

    displacement: Array
    traction: Array
    loss: float
    damping: float


def distance_slid(displacement: Array, stuck: Array) -> Array:
    """Return how far surfaces slide beyond the displacement at which they still stick [m]; zero if it is but rounding.

    Where the traction is mu p to rounding, the difference of both is not zero.
    """
    slid = displacement - stuck
    return np.where(abs(slid) > ROUNDING * displacement, slid, 0.0)


def masing_cycle(rise: Callable[[Array], Array], tau: float, slid: float, loss: float) -> ShearCycle:
    """Return the cycle whose branches are the backbone at twice the scale.

    Parameters
    ----------
    rise : callable
        Displacement [m] as the traction [Pa] rises from zero.
    tau, slid : float
        Traction at the reversal [Pa], and the distance that the surfaces slide before it [m].
    loss : float
        Energy dissipated per cycle [J/m^2].
    """
    fall = tau * np.linspace(0, 1, _POINTS) ** 2  # finer steps at the reversal, where the branch is steep
    moved = rise(fall)
    s, q = moved[-1] + slid - 2 * moved, tau - 2 * fall
    if slid:
        s, q = np.append(s, s[-1] - 2 * slid), np.append(q, -tau)
    energy = tau * float(s[0]) / 2
    damping = loss / (4 * math.pi * energy) if energy else 0.0
    return ShearCycle(np.concatenate([s, -s[1:]]), np.concatenate([q, -q[1:]]), loss, damping)
