"""Loading curves: a sequence of loads on one surface."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from roughcontact.contact.continuation import follow
from roughcontact.contact.curve import Curve, collect
from roughcontact.contact.flow import FlowModel, flow_reading
from roughcontact.contact.load_history import follow_history
from roughcontact.contact.loads.load_range import load_range
from roughcontact.contact.measures import StateMeasure
from roughcontact.contact.press import grid_of, make_problem
from roughcontact.contact.problem import Body
from roughcontact.contact.size_law import Hardness
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.labels.variables import force_unit
from roughcontact.materials import Modulus
from roughcontact.progress.events import tracked
from roughcontact.solver.active_set import ActiveSet
from roughcontact.solver.control import Solver
from roughcontact.solver.loads import Loads
from roughcontact.validation import Array, numeric

__all__ = ["loading_curve", "loading_path", "solutions_along", "suitable"]


@numeric(modulus="Pa", forces=force_unit, depths="m", pressures="Pa", hardness="Pa")
def loading_path(
    surface: Body,
    modulus: Modulus,
    *,
    forces: Sequence[float] | Array | None = None,
    depths: Sequence[float] | Array | None = None,
    pressures: Sequence[float] | Array | None = None,
    operator: Operator | None = None,
    solver: Solver | None = None,
    tolerance: float = 1e-8,
    hardness: Hardness | None = None,
    flow: FlowModel = "removed",
) -> Iterator[Solution]:
    """Yield the solution at each load, in order; each solve starts from the load before, if that met its tolerance.

    For surfaces that attract each other, see `adhesive_path`.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `press`.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    forces, depths, pressures : array, shape (n,)
        At most one: strictly increasing forces [N], depths [m] or nominal pressures [Pa]; under a hardness in any
        order. Without any, 24 forces that suit the surface, see `load_range`.
    operator : Operator, optional
        A body other than the half-space on the surface's grid, see `press`.
    solver : Solver, optional
        Settings of the method: `ActiveSet` (default) or `PolonskyKeer`.
    tolerance : float
        Largest residual of each load.
    hardness : float, array, function, Material or str, optional
        Pressure that no cell exceeds [Pa], see `press`. Flow is kept: up to the largest load so far, the contact is the
        elastic contact of the flattened surface.
    flow : {"removed", "raised"}
        What happens to material that flows: it vanishes, or raises the whole surface evenly over all measured cells,
        its volume conserved (Pullen and Williamson 1972), which changes only the depth.

    Yields
    ------
    Solution
        With its stiffness computed. Check `status`: a load may miss its tolerance. Under a hardness, the smaller loads
        after it have the status ``Status.AFTER_MISSED``: the flow is kept, and is not accurate to the tolerance until a
        larger load follows.

    Raises
    ------
    ValueError
        If the input makes no sense; raised by the call, before the first load.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> path = rc.loading_path(ball, 1e9, forces=[1e-3, 2e-3])
    >>> [f"{solution.force:.0e} N" for solution in path]
    ['1e-03 N', '2e-03 N']
    """
    loads = Loads.given(forces=forces, depths=depths, pressures=pressures)
    return solutions_along(surface, modulus, loads, operator, solver, tolerance, hardness, flow)


@numeric(modulus="Pa", forces=force_unit, depths="m", pressures="Pa", hardness="Pa")
def loading_curve(
    surface: Body,
    modulus: Modulus,
    *,
    forces: Sequence[float] | Array | None = None,
    depths: Sequence[float] | Array | None = None,
    pressures: Sequence[float] | Array | None = None,
    operator: Operator | None = None,
    solver: Solver | None = None,
    tolerance: float = 1e-8,
    hardness: Hardness | None = None,
    flow: FlowModel = "removed",
    measures: Sequence[StateMeasure] = (),
) -> Curve:
    """Return stiffness, contact area, depth and more as functions of load.

    For surfaces that attract each other, see `adhesive_curve`.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `press`.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    forces, depths, pressures : array, shape (n,)
        At most one: strictly increasing forces [N], depths [m] or nominal pressures [Pa]; under a hardness in any
        order. Without any, 24 forces that suit the surface, see `load_range`.
    operator : Operator, optional
        A body other than the half-space on the surface's grid, see `press`.
    solver : Solver, optional
        Settings of the method: `ActiveSet` (default) or `PolonskyKeer`.
    tolerance : float
        Largest residual of each load.
    hardness : float, array, function, Material or str, optional
        Pressure that no cell exceeds [Pa], see `press`. Flow is kept: up to the largest load so far, the contact is the
        elastic contact of the flattened surface.
    flow : {"removed", "raised"}
        What happens to material that flows: it vanishes, or raises the whole surface evenly over all measured cells,
        its volume conserved (Pullen and Williamson 1972), which changes only the depth.
    measures : sequence of functions
        Each returns numbers of a `Solution` by name, which become columns of the curve (``Curve.measured``): such as
        ``lambda solution: {"largest_spot": solution.spots.areas.max()}``, or `Transmissivity`.

    Returns
    -------
    Curve
        One point for each load, with its status; fields are not kept, see `loading_path`.

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
    loads = Loads.given(forces=forces, depths=depths, pressures=pressures)
    path = solutions_along(surface, modulus, loads, operator, solver, tolerance, hardness, flow)
    return collect(path, measures)


def solutions_along(
    surface: Body,
    modulus: Modulus,
    loads: Loads | None,
    operator: Operator | None = None,
    solver: Solver | None = None,
    tolerance: float = 1e-8,
    hardness: Hardness | None = None,
    flow: FlowModel = "removed",
) -> Iterator[Solution]:
    """Yield the solution at each load, see `loading_path`; without loads, at 24 forces that suit the surface.

    Raises
    ------
    ValueError
        If the input makes no sense; raised by the call, before the first load.
    """
    raises, keeps = flow_reading(flow), hardness is not None
    if raises and loads is not None and loads.kind == "depth":
        raise InputError(
            "depths cannot be prescribed if the surface rises as it flows", "give forces or pressures"
        )
    loads = loads or suitable(surface, modulus, operator, hardness)
    if not keeps:
        loads.rising("only under a hardness and in adhesive_path do loads go up and down")
    controls = loads.controls(grid_of(surface))
    problem = make_problem(
        surface, modulus, controls[0], operator, tolerance=tolerance, hardness=hardness, curve=True
    )
    for control in controls[1:]:
        problem.under(control)  # an impossible load raises an error before the first one is solved
    method = solver or ActiveSet()
    path = follow(problem, controls, method)
    if keeps:
        path = follow_history(problem, controls, method, raises=raises)
    return tracked(path, "Pressing", "loads", len(controls))


def suitable(
    surface: Body,
    modulus: Modulus,
    operator: Operator | None,
    hardness: Hardness | None,
) -> Loads:
    """Return 24 forces that suit a surface, see `load_range`."""
    return Loads("force", load_range(surface, modulus, operator=operator, hardness=hardness).forces)
