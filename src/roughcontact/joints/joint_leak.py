"""What leaks through the face of a joint, from rim to rim: Reynolds' equation with the transmissivity of the interface.

The transmissivity of each cell follows from its pressure. It is known between the loads of the law only, so the leak
rate has two bounds.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.ndimage import label

from roughcontact.errors import InputError, about
from roughcontact.fluid.fluids import Liquid
from roughcontact.fluid.network import flow_network
from roughcontact.fluid.solve import solve
from roughcontact.grid import Grid
from roughcontact.joints.whole_joint import Joint
from roughcontact.validation import Array, numeric, positive_scalar, shown

__all__ = ["joint_leak"]

_OPEN = 1e6  # conductance of a cell without contact, over the largest one in contact
_ROUNDED = 1e-12  # a pressure of a law is the sum over its cells: the load that it was asked for, rounded
_TOLERANCE = 1e-6


@numeric(drop="Pa")
def joint_leak(joint: Joint, fluid: Liquid, *, drop: float) -> tuple[float, float]:
    """Return bounds of the leak rate of a liquid from the holes of the face to its outside, or back [m^3/s].

    The holes are all cells without contact pressure that the loaded area separates from the border of the map.

    Parameters
    ----------
    joint : Joint
        Its laws have the column ``transmissivity``, of a curve with the measure `Transmissivity`.
    fluid : Liquid
    drop : float
        Drop of pressure [Pa].

    Returns
    -------
    tuple of float
        Lower and upper bound. They differ where the transmissivity is not known:

        * Below the lowest load of the law, it is that of this load, or the gap is wide open.
        * Where the contact pressure is less than the drop, the fluid may separate the bodies: as above.
        * Between the last load with an open path through the gap and the first without one, there is none, or it is
          that of the former.

    Raises
    ------
    ValueError
        If the field has no hole, or the laws have no transmissivity.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> field = rc.bolt_pressure(force=100, head=13e-3, hole=9e-3, thickness=2e-3, grid=rc.Grid((64, 64), size=2e-2))
    >>> curve = rc.loading_curve(surface, 1e9, pressures=field.loads, measures=[rc.Transmissivity(axis=0)])
    >>> low, high = rc.joint_leak(rc.joint(rc.normal_law(curve), field), rc.Liquid(1e-3), drop=1e4)
    >>> f"{low * 6e16:.0f} to {high * 6e16:.0f} pl/min"
    '798 to 798 pl/min'
    """
    if not isinstance(fluid, Liquid):
        raise about("fluid", f"must be an rc.Liquid, whose transmissivity the laws have, not {shown(fluid)}")
    drop = positive_scalar(drop, "drop [Pa]")
    pressure = np.pad(np.nan_to_num(joint.field.pressure), 1)
    contact = pressure > 0
    regions, _ = label(~contact)
    outside = regions == regions[0, 0]
    inside = ~contact & ~outside
    if not inside.any():
        words = "the loaded area of the face encloses no hole, from which the fluid could leak"
        raise InputError(words, "give NaN or 0 in the cells of the hole", "field")
    grid, rates = Grid(pressure.shape, joint.field.grid.spacing), []
    bounds = _transmissivities(joint, pressure[contact], drop)
    for kappa, bound in zip(bounds, ("lower", "upper"), strict=True):
        cells = np.full(pressure.shape, math.inf)
        cells[contact] = kappa
        wide = np.isinf(cells)
        joined, _ = label(wide)
        if (joined[inside] == joined[0, 0]).any():
            rates.append(math.inf)
            continue
        scale = float(cells[~wide].max()) or 1.0
        network, _ = flow_network(np.where(wide, _OPEN, cells / scale), grid, None, (inside, outside))
        flow = 0.0 if network is None else float(getattr(solve(network, _TOLERANCE), bound)[0, 0])
        rates.append(flow * scale * drop / (12 * fluid.viscosity))
    return rates[0], rates[1]


def _transmissivities(joint: Joint, pressure: Array, drop: float) -> Array:
    """Return bounds of the transmissivity at pressures, shape (2, n) [m^3]; infinite where the gap may be open."""
    found = np.zeros((2, pressure.size))
    for law in joint.normal:
        p, kappa = law.pressure, law.columns.get("transmissivity")
        if kappa is None:
            remedy = "give measures=[rc.Transmissivity(axis=0)] to the loading_curve of each law"
            raise InputError("the laws have no transmissivity", remedy, "joint")
        count = int(np.argmin(np.append(kappa, 0.0) > 0))  # loads before the first at which no path is open
        if count:
            between = np.exp(np.interp(np.log(pressure), np.log(p[:count]), np.log(kappa[:count])))
            found[0] += np.where(pressure <= p[count - 1] * (1 + _ROUNDED), between, 0.0)
            found[1] += np.where(pressure < np.append(p, math.inf)[count], between, 0.0)
        found[1][pressure < max(p[0], drop)] = math.inf
    return found / len(joint.normal)
