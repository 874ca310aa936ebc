"""Stresses and displacements below a solved contact, and the place where a metal would flow first."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar

from roughcontact.contact.solution import Solution
from roughcontact.contact.stiffness import cell_stiffness
from roughcontact.errors import InputError
from roughcontact.grid import Grid
from roughcontact.halfspace.operators.build import half_space
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.subsurface import fields_below as subsurface
from roughcontact.halfspace.subsurface.fields_below import Displacement, Stress
from roughcontact.material import Solid
from roughcontact.progress.events import tracked
from roughcontact.solver.subdomain import bounding_box
from roughcontact.validation import Array, numeric, require, scalar

__all__ = [
    "StressPeak",
    "below",
    "displacement_below",
    "half_space_grid",
    "is_half_space",
    "largest_von_mises",
    "loaded_part",
    "ratio_of",
]


ALIKE = 1e-3  # relative difference beyond which a displacement is not that of a half-space
ROUNDING = (
    1e-9  # of the displacement of a cell by the largest pressure: all that remains of a constant pressure
)
STEP = 1.4  # ratio of successive depths in the search for the largest stress
PRECISION = 1e-3  # of the depth of the largest stress


@dataclass(frozen=True, slots=True)
class StressPeak:
    """The largest equivalent stress below a contact.

    Attributes
    ----------
    von_mises : float
        Equivalent stress of von Mises [Pa].
    depth : float
        Depth below the surface [m].
    position : tuple of float
        Middle of the cell above this point, ``(y, x)`` [m].
    resolved : bool
        Whether the point lies at least two cells below the surface. Nearer to the surface the stress is that of
        uniformly loaded cells and depends on the grid.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> peak = rc.largest_von_mises(rc.press(ball, 1e9, force=5e-3), 0.3)
    >>> f"{peak.von_mises / 1e6:.0f} MPa, {peak.depth * 1e6:.1f} um deep", peak.resolved
    ('28 MPa, 3.5 um deep', True)
    """

    von_mises: float
    depth: float
    position: tuple[float, float]
    resolved: bool


@numeric(depth="m")
def below(solution: Solution, depth: float | Array, solid: Solid | float) -> Stress:
    """Return the stresses at a depth, or at several, below a solved contact.

    Parameters
    ----------
    solution : Solution
        The solution for a half-space under a surface, free or periodic.
    depth : float or array, shape (nz,)
        Depth below the surface [m], 0 or more.
    solid : Solid or float
        The body below the surface, or its Poisson's ratio; both bodies of a contact carry the same pressure.

    Returns
    -------
    Stress
        Arrays of shape ``(ny, nx)``, or ``(nz, ny, nx)`` [Pa], positive in tension; `von_mises`, `principal`,
        `largest_shear`.

    Raises
    ------
    ValueError
        If the solution is not that of a half-space under a surface, or the depth or Poisson's ratio makes no sense.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> solution = rc.press(ball, 1e9, force=1e-3)
    >>> stress = rc.below(solution, 2e-6, rc.Solid(1e9, 0.3))
    >>> f"{stress.von_mises.max() / 1e6:.1f} MPa"
    '16.5 MPa'
    """
    solution = solution.on_host()
    return subsurface.stress(solution.pressure, half_space_grid(solution), depth, ratio_of(solid))


@numeric(depth="m")
def displacement_below(solution: Solution, depth: float | Array, solid: Solid) -> Displacement:
    """Return the displacements at a depth, or at several, below a solved contact.

    They are those of the given body; the displacements of both bodies add up to that of the surface.

    Parameters
    ----------
    solution : Solution
        The solution for a half-space under a surface, free or periodic along both axes.
    depth : float or array, shape (nz,)
        Depth below the surface [m], 0 or more.
    solid : Solid
        The body whose displacements are computed, not rigid.

    Returns
    -------
    Displacement
        Arrays of shape ``(ny, nx)``, or ``(nz, ny, nx)`` [m].

    Raises
    ------
    ValueError
        As for `below`, if the solid is rigid, or the solution periodic along one axis only.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> solution = rc.press(ball, 1e9, force=1e-3)
    >>> rc.displacement_below(solution, [0.0, 3e-6], rc.Solid(1e9, 0.3)).z.shape
    (2, 32, 32)
    """
    solution = solution.on_host()
    return subsurface.displacement(solution.pressure, half_space_grid(solution), depth, solid)


@numeric
def largest_von_mises(solution: Solution, solid: Solid | float) -> StressPeak:
    """Return the largest equivalent stress of von Mises below a solved contact, and where it is.

    Depths from half a cell to the extent of the contact are searched in steps, then refined near the best depth to a
    thousandth of it. The lateral resolution is a cell.

    Parameters
    ----------
    solution : Solution
        The solution for a half-space under a surface, free or periodic.
    solid : Solid or float
        The body whose stresses are computed, or its Poisson's ratio.

    Returns
    -------
    StressPeak
        The stress [Pa], its depth and its position.

    Raises
    ------
    ValueError
        As for `below`, or if nothing is in contact.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> solution = rc.press(ball, 1e9, force=1e-3)
    >>> peak = rc.largest_von_mises(solution, 0.3)
    >>> f"{peak.depth * 1e6:.1f} um below the surface"
    '2.0 um below the surface'
    """
    solution = solution.on_host()
    grid, nu = half_space_grid(solution), ratio_of(solid)
    pressure, part, first = loaded_part(solution.pressure, grid)

    def strongest(depth: float) -> tuple[float, int]:
        field = subsurface.stress(pressure, part, depth, nu).von_mises
        return float(field.max()), int(field.argmax())

    shallow, deep = min(grid.spacing) / 2, max(part.lengths)
    depths = np.geomspace(shallow, deep, 2 + int(np.log(deep / shallow) / np.log(STEP)))
    tried = tracked(depths.tolist(), "Looking for the largest stress", "depths")
    best = int(np.argmax([strongest(depth)[0] for depth in tried]))
    ends = depths[max(0, best - 1)], depths[min(len(depths) - 1, best + 1)]
    found = minimize_scalar(
        lambda z: -strongest(float(np.exp(z)))[0],
        bounds=tuple(np.log(ends)),
        method="bounded",
        options={"xatol": PRECISION},
    )
    depth = max(float(np.exp(found.x)), float(depths[best]), key=lambda z: strongest(z)[0])
    value, cell = strongest(depth)
    row, column = np.unravel_index(cell, part.shape)
    (dy, dx) = grid.spacing
    position = (float(first[0] + row + 0.5) * dy, float(first[1] + column + 0.5) * dx)
    return StressPeak(value, depth, position, bool(depth >= 2 * max(grid.spacing)))


def half_space_grid(solution: Solution) -> Grid:
    """Return the grid of a solution; raise an error if the field below it is unknown."""
    problem = solution.problem
    grid = problem.grid
    if problem.geometry is not Geometry.SURFACE or not isinstance(grid, Grid):
        raise InputError(
            f"fields below the surface are those of a surface of two axes, not of a {problem.geometry.value}",
            "press a map of heights",
        )
    if not is_half_space(solution):
        raise InputError(
            "only the field below a half-space is known, and this is the solution of another body"
        )
    return grid


def is_half_space(solution: Solution) -> bool:
    """Return whether the body is a half-space under a map of heights, whatever its modulus."""
    grid = solution.problem.grid
    if solution.problem.geometry is not Geometry.SURFACE or not isinstance(grid, Grid):
        return False
    own = solution.displacement
    alike = half_space(grid, 1.0).apply(solution.pressure)
    if sum(grid.periodic) == 1:  # whose constant is arbitrary
        own, alike = own - own.mean(), alike - alike.mean()
    size = float(np.vdot(alike, alike))
    factor = float(np.vdot(alike, own)) / size if size else 0.0  # the modulus
    in_own_cell = float(solution.pressure.max()) * grid.cell_area / cell_stiffness(solution.problem.operator)
    allowed = ALIKE * np.abs(own).max() + ROUNDING * in_own_cell
    return bool(np.abs(own - factor * alike).max() <= allowed)


def ratio_of(solid: Solid | float) -> float:
    """Return the Poisson's ratio of a solid, or the ratio that was given."""
    if isinstance(solid, Solid):
        return solid.poisson_ratio
    require(
        not isinstance(solid, Sequence),
        "the two bodies carry the same pressure, but their stresses differ",
        "give one of the two bodies",
        place="solid",
    )
    return scalar(solid, "Poisson's ratio")


def loaded_part(pressure: Array, grid: Grid) -> tuple[Array, Grid, tuple[int, int]]:
    """Return the part of the pressure below which the stress can be largest, its grid, and its first cell.

    Farther from all loads than their extent, the stress is smaller than below them.
    """
    box = bounding_box(pressure != 0)
    if box is None:
        raise InputError("nothing is in contact: there is no stress below it", "press harder")
    sides = [
        slice(0, n) if periodic else slice(max(0, s.start - (s.stop - s.start)), min(n, 2 * s.stop - s.start))
        for s, n, periodic in zip(box, grid.shape, grid.periodic, strict=True)
    ]
    part = tuple(sides)
    cut = Grid(grid.window(part).shape, grid.spacing, grid.periodic)
    return pressure[part], cut, (sides[0].start, sides[1].start)
