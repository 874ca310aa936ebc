"""One load: from a surface to a problem, and from a problem to its solution."""

from __future__ import annotations

from dataclasses import replace

from roughcontact.arrays import is_numpy
from roughcontact.contact.convergence import ConvergenceError
from roughcontact.contact.memory_needed import require_memory_for
from roughcontact.contact.problem import Body, ContactProblem, separation_of
from roughcontact.contact.size_law import Hardness, as_hardness
from roughcontact.contact.solution import Solution
from roughcontact.contact.spot_hardness import settle, without_spots
from roughcontact.errors import InputError
from roughcontact.grid import AnyGrid
from roughcontact.halfspace.operators.build import body_on
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.labels.variables import force_unit
from roughcontact.materials import Modulus, as_modulus, softer_of
from roughcontact.progress.events import task
from roughcontact.solver.active_set import ActiveSet
from roughcontact.solver.control import Control, Depth, Solver, Start, State, Status
from roughcontact.solver.loads import control_of
from roughcontact.solver.nested_iteration import nested_start
from roughcontact.solver.subdomain import Subdomain, SubdomainSolver, prolong
from roughcontact.surface.radial import RadialProfile
from roughcontact.surface.surface import Surface
from roughcontact.threads import one_blas_thread
from roughcontact.validation import Array, exactly_one, numeric, scalar

__all__ = ["grid_of", "lock", "make_problem", "press", "solve", "solve_state"]


_DEFAULT = ActiveSet()


@numeric(modulus="Pa", force=force_unit, depth="m", pressure="Pa", hardness="Pa")
def press(
    surface: Body,
    modulus: Modulus,
    *,
    force: float | None = None,
    depth: float | None = None,
    pressure: float | None = None,
    operator: Operator | None = None,
    solver: Solver | None = None,
    tolerance: float = 1e-8,
    hardness: Hardness | None = None,
) -> Solution:
    """Press a rough surface against a flat and return the solution with its certificate.

    For surfaces that attract each other, see `adhesive_state`.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], positive toward the flat. Its grid is free or periodic.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    force, depth, pressure : float
        Exactly one: normal force [N], indentation depth [m] (the approach since first touch), or nominal pressure [Pa]
        (force over the area of all cells). On a line, forces are per unit length [N/m].
    operator : Operator, optional
        A body other than the half-space on the surface's grid. A surface of one axis needs one: `line`, or the
        `foundation` of the method of dimensionality reduction.
    solver : Solver, optional
        Settings of the method: `ActiveSet` (default) or `PolonskyKeer`.
    tolerance : float
        Largest residual; see docs/concepts/results.md.
    hardness : float, array, function, Material or str, optional
        Pressure that no cell exceeds [Pa]: the perfectly plastic limit of the softer body. It is a number, an array
        with a value for each cell, a function of the radii of the contact spots [m] such as `NixGao`, or a material of
        the `handbook` or its name.

    Returns
    -------
    Solution
        Pressure, depth and certificate; area, stiffness and more follow from them.

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
    control = control_of(*exactly_one(force=force, depth=depth, pressure=pressure), grid_of(surface))
    with task("Pressing", shape=surface.grid.shape):
        solution = solve(
            make_problem(surface, modulus, control, operator, tolerance=tolerance, hardness=hardness),
            solver=solver,
        )
    if not solution.status.converged:
        raise ConvergenceError(solution)
    return solution


def grid_of(surface: Body) -> AnyGrid:
    """Return the grid of a surface; raise an error if it is not a surface."""
    if not isinstance(surface, Surface | RadialProfile):
        raise InputError(
            f"a Surface is wanted (heights and a grid), not {type(surface).__name__}", place="surface"
        )
    return surface.grid


def make_problem(
    surface: Body,
    modulus: Modulus,
    control: Control,
    operator: Operator | None,
    *,
    tolerance: float,
    hardness: Hardness | None = None,
    curve: bool = False,
) -> ContactProblem:
    """Return the problem of a surface against a flat; raise an error if it cannot fit into memory."""
    value = as_modulus(modulus)
    require_memory_for(surface, operator, curve=curve)
    body = body_on(surface.grid, value, operator)
    separation, allowed = separation_of(surface), scalar(tolerance, "tolerance")
    strength, law = as_hardness(hardness, separation)
    softer = softer_of(modulus)
    return ContactProblem(separation, body, control, allowed, surface, value, strength, law, softer=softer)


def solve(
    problem: ContactProblem,
    *,
    solver: Solver | None = None,
    initial: tuple[Array, float] | None = None,
    subdomains: SubdomainSolver | None = None,
) -> Solution:
    """Return the solution of a contact problem; check its status, the tolerance may be missed.

    Parameters
    ----------
    problem : ContactProblem
    solver : Solver, optional
        Settings of the method; `ActiveSet` by default.
    initial : tuple of array and float, optional
        Pressure [Pa] on the whole grid and depth [m] to start from; by default coarser grids are solved first.
    subdomains : SubdomainSolver, optional
        Keeps restricted operators from one load to the next.
    """
    problem, state, subdomain = solve_state(
        problem,
        solver or _DEFAULT,
        None if initial is None else Start(*initial),
        subdomains or SubdomainSolver(problem.operator),
    )
    pressure = prolong(state.pressure, subdomain, problem.grid.shape)
    lock(pressure)
    return Solution(problem, pressure, state.depth, state.status, state.residual, state.steps)


def solve_state(
    problem: ContactProblem, solver: Solver, initial: Start | None, subdomains: SubdomainSolver
) -> tuple[ContactProblem, State, Subdomain]:
    """Return the problem with the hardness of its spots, the last state on its window, and the window."""
    if isinstance(solver, type) or not hasattr(solver, "run"):
        raise InputError(
            f"a solver is wanted, such as ActiveSet() or PolonskyKeer(), not {solver!r}", place="solver"
        )
    if isinstance(problem.control, Depth) and problem.control.value <= max(0.0, problem.first_touch):
        if problem.size_law is not None:
            problem = without_spots(problem, problem.size_law)
        return problem, *_untouched(problem, problem.control.value)
    with one_blas_thread():
        start = initial or Start(*nested_start(problem.operator, problem.separation, problem.control, solver))
        if problem.size_law is not None:
            return settle(problem, problem.size_law, solver, (start.move(), start.depth), subdomains)
        if problem.flow is not None:
            return problem, *_from_touch(problem, solver, start, subdomains)
        return problem, *subdomains.solve(solver, problem.separation, problem.spec, start)


def lock(pressure: Array) -> None:
    """Make an array read-only, if its library supports that."""
    if is_numpy(pressure):
        pressure.flags.writeable = False


def _from_touch(
    problem: ContactProblem, solver: Solver, start: Start, subdomains: SubdomainSolver
) -> tuple[State, Subdomain]:
    """Solve with depths that count from the touch of the flattened bodies; larger ones cost digits of the pressure."""
    touch = problem.first_touch
    separation = problem.once("separation_at_touch", lambda: problem.separation - touch)
    control = problem.control
    nearer = Depth(control.value - touch) if isinstance(control, Depth) else control
    spec = replace(problem.spec, control=nearer)
    state, subdomain = subdomains.solve(solver, separation, spec, Start(start.move(), start.depth - touch))
    return replace(state, depth=state.depth + touch), subdomain


def _untouched(problem: ContactProblem, depth: float) -> tuple[State, Subdomain]:
    """Return the state up to the depth of first touch, without pressure."""
    shape = problem.grid.shape
    zero = problem.measure.xp.zeros_like(problem.separation)
    whole = tuple(slice(0, n) for n in shape)
    return State(zero, depth, 0.0, 0, Status.NO_CONTACT), whole
