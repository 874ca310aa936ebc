"""Derivatives of a load with respect to parameters: of the heights, of the load, of the material."""

from __future__ import annotations

import math

import numpy as np

from roughcontact.arrays import as_like
from roughcontact.errors import InputError, about
from roughcontact.gradients.derivatives import Sensitivity
from roughcontact.grid import RadialGrid
from roughcontact.halfspace.operators.operator import exact_of
from roughcontact.validation import Array, lengths_method, positive_scalar

__all__ = ["to_hardness", "to_load", "to_modulus", "to_radius", "to_rms_height", "to_tilt"]


def to_rms_height(derivatives: Sensitivity) -> dict[str, float]:
    """Return the derivatives with respect to the rms height [m], as all heights over their mean are scaled.

    Parameters
    ----------
    derivatives : Sensitivity

    Returns
    -------
    dict of str to float
        See `Sensitivity.along`.

    Examples
    --------
    >>> import roughcontact as rc
    >>> surface = rc.self_affine(rc.Grid((32, 32), 1e-6, periodic=True), hurst=0.8, rms=1e-7, rng=1)
    >>> derivatives = rc.sensitivity(rc.press(surface, 1e9, pressure=1e7))
    >>> derivatives.to_rms_height()["force_at_depth"] < 0  # of a rougher surface fewer cells touch
    True
    """
    problem = derivatives.solution.problem
    heights = _below_highest(derivatives)
    heights = heights - problem.measure.mean(heights, problem.measured)
    return derivatives.along(heights / math.sqrt(problem.measure.mean(heights * heights, problem.measured)))


@lengths_method
def to_radius(derivatives: Sensitivity, radius: float) -> dict[str, float]:
    """Return the derivatives with respect to the radius of a paraboloid, whose highest cell stays where it is.

    On a grid the derivatives vary by some per cent as the contact grows by whole cells: refine the grid for more.

    Parameters
    ----------
    derivatives : Sensitivity
    radius : float
        Present radius [m].

    Returns
    -------
    dict of str to float
        See `Sensitivity.along`.

    Raises
    ------
    ValueError
        If the radius is not positive.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> derivatives = rc.sensitivity(rc.press(ball, 1e9, force=1e-3))
    >>> f"{derivatives.to_radius(1e-4)['depth_at_force'] * 1e6:.0f} nm/mm"  # Hertz: -d/(3 R), here -590
    '-613 nm/mm'
    """
    return derivatives.along(-_below_highest(derivatives) / positive_scalar(radius, "radius [m]"))


def to_tilt(derivatives: Sensitivity, axis: int = 0) -> dict[str, float]:
    """Return the derivatives with respect to the slope of the surface along an axis [1].

    Parameters
    ----------
    derivatives : Sensitivity
    axis : int
        The heights rise along it, about the middle of the map.

    Returns
    -------
    dict of str to float
        See `Sensitivity.along`.

    Raises
    ------
    ValueError
        If there is no such axis, or the surface is periodic along it, or rings.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> tilt = rc.sensitivity(rc.press(ball, 1e9, force=1e-3)).to_tilt(axis=1)
    >>> abs(tilt["force_at_depth"]) < 1e-15  # by symmetry
    True
    """
    grid = derivatives.solution.problem.grid
    if axis not in range(grid.ndim):
        raise about("the axis", f"must be one of {tuple(range(grid.ndim))}, not {axis!r}")
    if isinstance(grid, RadialGrid) or grid.periodic[axis]:
        raise InputError(
            "a periodic or axisymmetric surface cannot be tilted",
            "give the change of its heights to along",
            "axis",
        )
    x = grid.coordinates[axis]
    shape = [-1 if each == axis else 1 for each in range(grid.ndim)]
    field = np.broadcast_to((x - 0.5 * (x[0] + x[-1])).reshape(shape), grid.shape)
    return derivatives.along(as_like(np.ascontiguousarray(field), derivatives.solution.pressure))


def to_load(derivatives: Sensitivity) -> dict[str, float]:
    """Return the derivatives with respect to the load: those at given force [per N], those at given depth [per m].

    Parameters
    ----------
    derivatives : Sensitivity

    Returns
    -------
    dict of str to float
        See `Sensitivity.along`. ``force_at_depth`` is the stiffness, ``depth_at_force`` its inverse.

    Raises
    ------
    ValueError
        In full contact of a periodic surface.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> derivatives = rc.sensitivity(rc.press(ball, 1e9, force=1e-3))
    >>> derivatives.to_load()["energy_at_depth"]  # the work of the force
    0.001
    """
    k, opening, force = (
        derivatives.linearised.finite_stiffness,
        derivatives.linearised.closing - 1,
        derivatives.solution.force,
    )
    found = {
        "force_at_depth": k,
        "depth_at_force": 1 / k,
        "mean_gap_at_force": opening / k,
        "mean_gap_at_depth": opening,
    }
    if derivatives.solution.problem.plastic:
        return found
    return found | {"energy_at_force": force / k, "energy_at_depth": force}


def to_modulus(derivatives: Sensitivity) -> dict[str, float]:
    """Return the derivatives with respect to the reduced modulus [Pa], with which all moduli of a body grow.

    Parameters
    ----------
    derivatives : Sensitivity

    Returns
    -------
    dict of str to float
        See `Sensitivity.along`.

    Raises
    ------
    ValueError
        Under a hardness, in full contact of a periodic surface, or if the problem does not state its modulus.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> derivatives = rc.sensitivity(rc.press(ball, 1e9, force=1e-3))
    >>> f"{derivatives.to_modulus()['force_at_depth'] * 1e9 / 1e-3:.12g}"  # the force is proportional to it
    '1'
    """
    modulus, force = derivatives.solution.problem.modulus, derivatives.solution.force
    if not math.isfinite(modulus):
        raise InputError("the problem does not state a reduced modulus", "give modulus= to ContactProblem")
    if derivatives.solution.problem.plastic:
        raise InputError(
            "under a hardness the pressure is not proportional to the modulus",
            "take the difference of two loads at two moduli",
        )
    load, energy = derivatives.to_load(), derivatives.solution.elastic_energy
    return {
        "force_at_depth": force / modulus,
        "depth_at_force": -force * load["depth_at_force"] / modulus,
        "mean_gap_at_force": -force * load["mean_gap_at_force"] / modulus,
        "mean_gap_at_depth": 0.0,
        "energy_at_force": (energy - force * load["energy_at_force"]) / modulus,
        "energy_at_depth": energy / modulus,
    }


def to_hardness(derivatives: Sensitivity) -> dict[str, float]:
    """Return the derivatives with respect to the hardness [Pa]; that of a map grows by as much on all cells.

    Parameters
    ----------
    derivatives : Sensitivity

    Returns
    -------
    dict of str to float
        Those of ``force_at_depth`` and ``depth_at_force``.

    Raises
    ------
    ValueError
        If the load has no hardness.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> derivatives = rc.sensitivity(rc.press(ball, 1e11, force=0.2, hardness=2e9))
    >>> derivatives.to_hardness()["depth_at_force"] < 0  # a harder body is indented less
    True
    """
    problem, measure = derivatives.solution.problem, derivatives.solution.problem.measure
    if not problem.plastic:
        raise InputError("the load has no hardness", "press with hardness=")
    flowing = measure.xp.astype(derivatives.solution.plastic, derivatives.solution.pressure.dtype)
    displacement = exact_of(problem.operator).apply(flowing)
    force = measure.total(flowing) - measure.dot(derivatives.linearised.frozen.tangent, displacement)  # G11
    return {"force_at_depth": force, "depth_at_force": -force / derivatives.linearised.finite_stiffness}


def _below_highest(derivatives: Sensitivity) -> Array:
    """Return the heights over the highest cell [m], none of them positive; zero for missing cells."""
    problem = derivatives.solution.problem
    return problem.measure.xp.where(problem.measured, -problem.separation, 0.0)  # type: ignore[no-any-return]
