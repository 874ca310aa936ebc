"""Pressures between zero and the hardness, and the depth that they mean."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.halfspace.operators.operator import Operator, is_semidefinite
from roughcontact.solver.control import Control, Depth, Force, Terms
from roughcontact.solver.inner_product import Measure

__all__ = ["depth_of", "elastic_control", "within"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

PASSES = (
    50  # in which a force is shared out between cells; what is left then is shared out in the next iteration
)
ROUNDING = 1e-14  # of a force: a sum over many cells is no better


def depth_of(measure: Measure, level: Array, pressure: Array, inside: Mask) -> float:
    """Return the depth that leaves no gap on the mean of the cells between the bounds.

    Without any it is the least at which no cell under the hardness would be pulled.
    """
    xp = namespace(level)
    if bool(xp.any(inside)):
        return measure.mean(level, inside)
    return float(xp.max(xp.where(pressure > 0, level, -np.inf)))


def elastic_control(operator: Operator, separation: Array, control: Control) -> Control:
    """Return what is prescribed, or the largest depth of an elastic body if that is less.

    A periodic one without missing cells goes no deeper than its mean separation, where contact is full.
    """
    if isinstance(control, Force) or not is_semidefinite(operator):
        return control
    xp = namespace(separation)
    mean = float(xp.mean(separation))  # infinite with missing cells, which may bulge
    return control if control.value <= mean else Depth(mean)


def within(measure: Measure, pressure: Array, gap: Array, terms: Terms) -> Array:
    """Return the pressure between zero and the hardness, under the force that is prescribed, if one is.

    Where cells that carry nothing have to help, those of the smallest `gap` do.
    """
    hardness, xp = terms.hardness, namespace(pressure)
    if not isinstance(terms.control, Force):
        return xp.clip(pressure, 0.0, hardness)  # type: ignore[no-any-return]
    force = terms.control.value
    if hardness == np.inf:
        return _under_force(measure, pressure, force)
    pressure = xp.clip(pressure, 0.0, hardness)
    # What exceeds the hardness, or lacks, is shared by the cells that can take it. Each pass takes at least one cell
    # to a bound, or is the last but for rounding.
    for _ in range(PASSES):
        lacking = force - measure.total(pressure)
        if abs(lacking) <= ROUNDING * force:
            break
        free = (pressure > 0) & (pressure < hardness)
        if not bool(xp.any(free)):  # all at the bounds: the next cells to touch help, or all give
            free = _nearest(measure, gap, pressure, lacking / hardness) if lacking > 0 else pressure > 0
        pressure = xp.where(free, xp.clip(pressure + lacking / measure.total(free), 0.0, hardness), pressure)
    return pressure


def _nearest(measure: Measure, gap: Array, pressure: Array, area: float) -> Mask:
    """Return the cells without pressure that stand nearest, as many as have twice the `area`."""
    xp = namespace(gap)
    free = (pressure == 0) & xp.isfinite(gap)
    # The gap up to which the cells are enough, by halving: cells are many, halvings are few.
    low, high = float(xp.min(xp.where(free, gap, np.inf))), float(xp.max(xp.where(free, gap, -np.inf)))
    for _ in range(60):
        middle = (low + high) / 2
        if measure.total(free & (gap <= middle)) < 2 * area:
            low = middle
        else:
            high = middle
    return free & (gap <= high)  # type: ignore[no-any-return]


def _under_force(measure: Measure, pressure: Array, force: float) -> Array:
    """Return the pressure under the right force: the nearest one below, or the same enlarged.

    The nearest is ``max(pressure - shift, 0)``; each pass finds the shift for the cells that are left.
    """
    if measure.total(pressure) > force:
        xp = namespace(pressure)
        left = pressure > 0
        while True:
            shift = (measure.total(xp.where(left, pressure, 0.0)) - force) / measure.total(left)
            fewer = left & (pressure > shift)
            if bool(xp.all(fewer == left)):
                break
            left = fewer
        pressure = xp.where(left, pressure - shift, 0.0)
    return pressure * (force / measure.total(pressure))
