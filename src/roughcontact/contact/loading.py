"""A sequence of loads, each solved from what the tangent of the one before predicts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
import numpy.typing as npt

from roughcontact.contact.curve import SUGGESTED, SUGGESTED_ON_LINES, Curve, collect, length_scale
from roughcontact.contact.press import control_of, grid_of, lock, make_problem, solve_state
from roughcontact.contact.problem import Body, ContactProblem
from roughcontact.contact.solution import Solution
from roughcontact.contact.stiffness import FrozenContact, elastic_contact, frozen_contact
from roughcontact.grid import AnyGrid
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import Operator, geometry_of
from roughcontact.material import Solid, as_modulus
from roughcontact.solver.active_set import ActiveSet
from roughcontact.solver.control import Control, Force, Solver, Tangent
from roughcontact.solver.subdomain import SubdomainSolver, prolong, restrict
from roughcontact.validation import exactly_one, number, numeric

__all__ = ["loading_curve", "loading_path", "suggested_forces"]

Array = npt.NDArray[np.float64]
Loads = Sequence[float] | Array


@numeric
def loading_path(
    surface: Body,
    modulus: float | Solid | tuple[Solid, Solid],
    *,
    forces: Loads | None = None,
    depths: Loads | None = None,
    pressures: Loads | None = None,
    operator: Operator | None = None,
    solver: Solver | None = None,
    tolerance: float = 1e-8,
    hardness: float | None = None,
) -> Iterator[Solution]:
    """Yield the solution of every load, in order; each starts from the one before.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `press`.
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa], or what it follows from.
    forces, depths, pressures : array, shape (n,)
        At most one: strictly increasing forces [N], depths [m] or nominal pressures [Pa]. Without any, 30
        forces from the first cells to the end of the power law, see `suggested_forces`.
    operator : Operator, optional
        Another body than the half-space on the surface's grid, see `press`.
    solver : Solver, optional
        Settings of the method: `ActiveSet` (default) or `PolonskyKeer`.
    tolerance : float
        Largest residual of each load.
    hardness : float, optional
        Pressure that no cell exceeds [Pa].

    Yields
    ------
    Solution
        With its stiffness computed. A load that missed its tolerance says so in its `status`.

    Raises
    ------
    ValueError
        If the input makes no sense, at once and not at the first load.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> path = rc.loading_path(ball, 1e9, forces=[1e-3, 2e-3])
    >>> [f"{solution.force:.0e} N" for solution in path]
    ['1e-03 N', '2e-03 N']
    """
    if forces is None and depths is None and pressures is None:
        forces = suggested_forces(surface, modulus, operator=operator)
    controls = _controls(grid_of(surface), forces=forces, depths=depths, pressures=pressures)
    problem = make_problem(surface, modulus, controls[0], operator, tolerance=tolerance, hardness=hardness)
    for control in controls[1:]:
        problem.under(control)  # what cannot be asked for is refused before the first load is solved
    return _follow(problem, controls, solver or ActiveSet())


def loading_curve(
    surface: Body,
    modulus: float | Solid | tuple[Solid, Solid],
    *,
    forces: Loads | None = None,
    depths: Loads | None = None,
    pressures: Loads | None = None,
    operator: Operator | None = None,
    solver: Solver | None = None,
    tolerance: float = 1e-8,
    hardness: float | None = None,
) -> Curve:
    """Return stiffness, contact area, depth and more as functions of load.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `press`.
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa], or what it follows from.
    forces, depths, pressures : array, shape (n,)
        At most one: strictly increasing forces [N], depths [m] or nominal pressures [Pa]. Without any, 30
        forces from the first cells to the end of the power law, see `suggested_forces`.
    operator : Operator, optional
        Another body than the half-space on the surface's grid, see `press`.
    solver : Solver, optional
        Settings of the method: `ActiveSet` (default) or `PolonskyKeer`.
    tolerance : float
        Largest residual of each load.
    hardness : float, optional
        Pressure that no cell exceeds [Pa].

    Returns
    -------
    Curve
        One point for each load, marked where a load missed its tolerance; fields are not kept, see `loading_path`.

    Raises
    ------
    ValueError
        If the input makes no sense.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> curve = rc.loading_curve(ball, 1e9, forces=[1e-3, 4e-3])
    >>> f"{curve.contact_area[1] / curve.contact_area[0]:.1f}"  # about 4^(2/3)
    '2.5'
    """
    path = loading_path(
        surface,
        modulus,
        forces=forces,
        depths=depths,
        pressures=pressures,
        operator=operator,
        solver=solver,
        tolerance=tolerance,
        hardness=hardness,
    )
    return collect(path)


@numeric
def suggested_forces(
    surface: Body,
    modulus: float | Solid | tuple[Solid, Solid],
    *,
    count: int = 30,
    operator: Operator | None = None,
) -> Array:
    """Return forces over the range in which a rough surface is worth a curve.

    From 1e-4 to 0.07 of E* h L in equal ratios: from the first cells in contact to where the thesis ends its
    fits of the power law (section 4.5). On a line contact from 0.03 to 3 of E* h.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `press`.
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa], or what it follows from.
    count : int
        Number of forces.
    operator : Operator, optional
        Another body than the half-space on the surface's grid; it says whether the contact is that of a line.

    Returns
    -------
    array, shape (count,)
        Forces [N], on a line per unit length [N/m], increasing.

    Raises
    ------
    ValueError
        If the surface is flat, so that its rms height h gives no scale, or `count` is below 1.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((32, 32), 1e-6)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    >>> forces = rc.suggested_forces(surface, 1e9, count=3)
    >>> (forces / (1e9 * 1e-7 * 32e-6)).round(6).tolist()
    [0.0001, 0.002646, 0.07]
    """
    grid = grid_of(surface)
    if not surface.rms > 0:
        raise ValueError("a flat surface gives forces no scale: name the forces, depths or pressures")
    geometry = Geometry.of(grid) if operator is None else geometry_of(operator)
    line = geometry is Geometry.LINE
    length = 1.0 if line else length_scale(geometry, grid.lengths)
    scale = as_modulus(modulus) * surface.rms * length
    low, high = SUGGESTED_ON_LINES if line else SUGGESTED
    if count < 1:
        raise ValueError(f"count must be at least 1, not {count}")
    return np.geomspace(low * scale, high * scale, int(count))


def _follow(problem: ContactProblem, controls: list[Control], solver: Solver) -> Iterator[Solution]:
    subdomains = SubdomainSolver(problem.operator)
    guess: tuple[Array, float] | None = None
    last: Tangent | None = None
    for control, following in zip(controls, [*controls[1:], None], strict=True):
        here = problem.under(control)
        state, subdomain = solve_state(here, solver, guess, subdomains)
        shape = problem.grid.shape
        frozen = frozen_contact(
            subdomains.operator_on(subdomain),
            elastic_contact(state.pressure, problem.hardness),
            tangent=state.tangent or (last and Tangent(restrict(last.pressure, subdomain), math.inf)),
        )
        pressure = prolong(state.pressure, subdomain, shape)
        lock(pressure)
        solution = Solution(
            here,
            pressure,
            state.depth,
            state.status,
            state.residual,
            state.steps,
            FrozenContact(frozen.stiffness, frozen.residual, prolong(frozen.tangent, subdomain, shape)),
        )
        # That of another region: where to start. That of a whole period is infinite.
        last = Tangent(solution.frozen.tangent, math.inf) if solution.stiffness < math.inf else None
        yield solution
        if following is not None:
            advance = _advance(solution, following)
            if advance is None:
                guess = None
            elif not advance:
                guess = pressure, state.depth
            else:  # on the window alone: the plane is large
                moved = state.pressure + advance * frozen.tangent
                guess = prolong(moved, subdomain, shape), state.depth + advance


def _advance(solution: Solution, following: Control) -> float | None:
    """Return by how much the depth grows to the next load if the contact region stays as it is [m]; None without one.

    The force is convex in the depth, so this overestimates the depth at a given force: the window found
    from it is safe.
    """
    k = solution.stiffness
    if k == 0:  # no contact yet
        return None
    if not np.isfinite(k):  # full contact of a periodic surface: only the mean pressure grows
        return 0.0
    forced = isinstance(following, Force)
    return (following.value - solution.force) / k if forced else following.value - solution.depth


def _controls(
    grid: AnyGrid, *, forces: Loads | None, depths: Loads | None, pressures: Loads | None
) -> list[Control]:
    """Return the controls that exactly one of the three lists states."""
    name, loads = exactly_one(force=forces, depth=depths, pressure=pressures)
    values = np.atleast_1d(number(loads, f"the list of {name}s"))
    if values.ndim != 1 or not len(values):
        raise ValueError(
            f"the list of {name}s must hold at least one number in one row, not shape {values.shape}"
        )
    if not (np.diff(values) > 0).all():
        at = int(np.argmin(np.diff(values) > 0))
        raise ValueError(
            f"the {name}s must increase strictly, but {values[at + 1]:g} follows {values[at]:g} at place {at + 1}"
        )
    return [control_of(grid, **{name: float(v)}) for v in values]
