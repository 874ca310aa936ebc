"""The feasible set: pressures between zero and the hardness under the given force, and the multiplier of the force.

The projection onto the simplex of given force is that of Michelot (J. Optim. Theory Appl. 50, 195, 1986).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from roughcontact.halfspace.operators.operator import Operator, is_semidefinite
from roughcontact.solver.control import Control, Depth, Force, Specification
from roughcontact.solver.inner_product import Measure
from roughcontact.validation import Array, Mask

__all__ = [
    "bearing_force",
    "bearing_level",
    "elastic_control",
    "force_multiplier",
    "project",
]


PASSES = 50  # in which a force is redistributed; what is left then is left to the next iteration
ROUNDING = 1e-14  # of a force: a sum over many cells is no better


def force_multiplier(measure: Measure, level: Array, pressure: Array, free: Mask) -> float:
    """Return the multiplier of the force, the depth: with it the mean gap of the cells between the bounds is zero (A3).

    That is the mean of the `level` u + f over them (Polonsky and Keer 1999). Without any it is the smallest depth at
    which the gap is not positive under the hardness.
    """
    xp = measure.xp
    if bool(xp.any(free)):
        return measure.mean(level, free)  # A3
    return float(xp.max(xp.where(pressure > 0, level, -np.inf)))


def elastic_control(operator: Operator, separation: Array, control: Control, xp: Any) -> Control:
    """Return what is prescribed, or the largest depth of an elastic body if that is less.

    A periodic one without missing cells goes no deeper than its mean separation, where contact is full.
    """
    if isinstance(control, Force) or not is_semidefinite(operator):
        return control
    mean = float(xp.mean(separation))  # infinite with missing cells, which may bulge
    return control if control.value <= mean else Depth(mean)


def project(measure: Measure, pressure: Array, gap: Array, spec: Specification) -> Array:
    """Return the pressure projected onto the bounds, and onto the force where one is prescribed.

    Where cells without pressure have to carry some, those of the smallest `gap` do.
    """
    hardness, xp = spec.hardness, measure.xp
    if not isinstance(spec.control, Force):
        return xp.clip(pressure, 0.0, hardness)  # type: ignore[no-any-return]
    force = spec.control.value
    if not spec.plastic:
        return _project_onto_simplex(measure, pressure, force)
    pressure = xp.clip(pressure, 0.0, hardness)
    # The missing force is distributed over the cells between the bounds. Each pass takes at least one cell to a bound,
    # or is the last, up to rounding.
    for _ in range(PASSES):
        missing = force - measure.total(pressure)
        if abs(missing) <= ROUNDING * force:
            break
        free = (pressure > 0) & (pressure < hardness)
        if not bool(xp.any(free)):  # all at their bounds: the next cells to touch take it, or all give some
            free = _nearest(measure, gap, pressure, spec, missing) if missing > 0 else pressure > 0
        pressure = xp.where(free, xp.clip(pressure + missing / measure.total(free), 0.0, hardness), pressure)
    return pressure


def bearing_force(measure: Measure, cells: Mask, spec: Specification) -> float:
    """Return the force that cells bear at their hardness [N]."""
    if isinstance(spec.hardness, int | float):
        return spec.hardness * measure.total(cells)
    return measure.total(measure.xp.where(cells, spec.hardness, 0.0))


def bearing_level(measure: Measure, level: Array, cells: Mask, spec: Specification, force: float) -> float:
    """Return the smallest value such that the cells of no larger `level` bear a force at their hardness."""
    xp = measure.xp
    high, level = float(xp.max(xp.where(cells, level, -np.inf))), xp.where(cells, level, np.inf)
    low = float(xp.min(level))
    for _ in range(60):  # by bisection: cells are many, bisections are few
        middle = (low + high) / 2
        if bearing_force(measure, level <= middle, spec) < force:
            low = middle
        else:
            high = middle
    return high


def _nearest(measure: Measure, gap: Array, pressure: Array, spec: Specification, force: float) -> Mask:
    """Return the cells without pressure of the smallest gap, enough to bear twice a `force` at the hardness."""
    free = (pressure == 0) & measure.xp.isfinite(gap)
    return free & (gap <= bearing_level(measure, gap, free, spec, 2 * force))  # type: ignore[no-any-return]


def _project_onto_simplex(measure: Measure, pressure: Array, force: float) -> Array:
    """Return the nearest pressure on the simplex of given force where it is too large, otherwise the same scaled up.

    The nearest is ``max(pressure - shift, 0)``; each pass finds the shift for the cells that are left.
    """
    if measure.total(pressure) > force:
        xp = measure.xp
        left = pressure > 0
        while True:
            shift = (measure.total(xp.where(left, pressure, 0.0)) - force) / measure.total(left)
            fewer = left & (pressure > shift)
            if bool(xp.all(fewer == left)):
                break
            left = fewer
        pressure = xp.where(left, pressure - shift, 0.0)
    return pressure * (force / measure.total(pressure))
