"""The front door: press a surface at one load."""

from __future__ import annotations

import math

from roughcontact.contact.convergence import ConvergenceError
from roughcontact.contact.problem import Body, ContactProblem, require_memory_for, separation_of
from roughcontact.contact.solution import Solution
from roughcontact.contact.solve import solve
from roughcontact.grid import AnyGrid
from roughcontact.halfspace.operators.build import body_on
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.material import Solid, as_modulus
from roughcontact.solver.control import Control, Depth, Force, Solver
from roughcontact.surface.radial import RadialProfile
from roughcontact.surface.surface import Surface
from roughcontact.validation import exactly_one, scalar

__all__ = ["press"]


def press(
    surface: Body,
    modulus: float | Solid | tuple[Solid, Solid],
    *,
    force: float | None = None,
    depth: float | None = None,
    pressure: float | None = None,
    operator: Operator | None = None,
    solver: Solver | None = None,
    tolerance: float = 1e-8,
    hardness: float | None = None,
) -> Solution:
    """Press a rough surface against a flat and return the contact, with a certificate.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], positive toward the flat. Its grid says whether it is free or periodic.
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa], or what it follows from.
    force, depth, pressure : float
        Exactly one: normal force [N], indentation depth, the approach since first touch [m], or nominal pressure [Pa]
        (force over the area of all cells). On a line, forces are per unit length [N/m].
    operator : Operator, optional
        Another body than the half-space on the surface's grid. A surface of one axis needs one: `line`, or the
        `foundation` of the method of dimensionality reduction.
    solver : Solver, optional
        Settings of the method: `ActiveSet` (default) or `PolonskyKeer`.
    tolerance : float
        Largest residual; see docs/conventions.md.
    hardness : float, optional
        Pressure that no cell exceeds [Pa]: a perfectly plastic limit of the softer body.

    Returns
    -------
    Solution
        Pressure, depth and certificate; area, stiffness and more follow from it.

    Raises
    ------
    ValueError
        If the input makes no sense; the message names the value and the remedy.
    ConvergenceError
        If the tolerance was missed. It carries the solution.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> solution = rc.press(ball, 1e9, force=1e-3)
    >>> f"{solution.depth * 1e9:.0f} nm, Hertz: {(0.75 * 1e-3 / 1e9) ** (2 / 3) / 1e-4 ** (1 / 3) * 1e9:.0f} nm"
    '177 nm, Hertz: 178 nm'
    >>> solution.status.value
    'converged'
    """
    control = control_of(grid_of(surface), force=force, depth=depth, pressure=pressure)
    solution = solve(
        make_problem(surface, modulus, control, operator, tolerance=tolerance, hardness=hardness),
        solver=solver,
    )
    if not solution.status.converged:
        raise ConvergenceError(solution)
    return solution


def grid_of(surface: Body) -> AnyGrid:
    """Return the grid of a surface; refuse what is not a surface."""
    if not isinstance(surface, Surface | RadialProfile):
        raise ValueError(f"a Surface is wanted (heights and a grid), not {type(surface).__name__}")
    return surface.grid


def make_problem(
    surface: Body,
    modulus: float | Solid | tuple[Solid, Solid],
    control: Control,
    operator: Operator | None,
    *,
    tolerance: float,
    hardness: float | None = None,
) -> ContactProblem:
    """Return the problem of a surface against a flat."""
    value = as_modulus(modulus)
    require_memory_for(surface)
    body = body_on(surface.grid, value, operator)
    strength = math.inf if hardness is None else scalar(hardness, "hardness")
    allowed = scalar(tolerance, "tolerance")
    return ContactProblem(separation_of(surface), body, control, allowed, surface, value, strength)


def control_of(
    grid: AnyGrid, *, force: float | None = None, depth: float | None = None, pressure: float | None = None
) -> Control:
    """Return the control that exactly one of the three numbers states."""
    exactly_one(force=force, depth=depth, pressure=pressure)
    if force is not None:
        return Force(scalar(force, "force"))
    if depth is not None:
        return Depth(scalar(depth, "depth"))
    pressure = scalar(pressure, "pressure")
    if not (math.isfinite(pressure) and pressure > 0):
        raise ValueError(f"the pressure must be positive and finite [Pa], not {pressure}")
    return Force(pressure * grid.area)
