"""Loading curves: a sequence of loads on one surface."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from roughcontact.contact.continuation import follow
from roughcontact.contact.curve import Curve, collect
from roughcontact.contact.flow import FlowReading, flow_reading
from roughcontact.contact.load_history import follow_history
from roughcontact.contact.load_range import load_range
from roughcontact.contact.mean_gaps import refuse_gaps
from roughcontact.contact.press import control_of, grid_of, make_problem
from roughcontact.contact.problem import Body
from roughcontact.contact.size_law import Hardness
from roughcontact.contact.solution import Solution
from roughcontact.grid import AnyGrid
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.labels.variables import force_unit
from roughcontact.material import Solid
from roughcontact.solver.active_set import ActiveSet
from roughcontact.solver.control import Control, Solver
from roughcontact.validation import Array, exactly_one, number, numeric, require

if TYPE_CHECKING:
    from roughcontact.adhesion.adhesive_state import AdhesiveState
    from roughcontact.adhesion.attraction import Adhesion
    from roughcontact.contact.adhesive_branches import AdhesiveLoop

__all__ = ["loading_curve", "loading_path"]

Loads = Sequence[float] | Array


@overload
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
    hardness: Hardness | None = None,
    flow: FlowReading = "removed",
    adhesion: None = None,
    mean_gaps: None = None,
) -> Iterator[Solution]: ...


@overload
def loading_path(
    surface: Body,
    modulus: float | Solid | tuple[Solid, Solid],
    *,
    forces: Loads | None = None,
    depths: Loads | None = None,
    operator: Operator | None = None,
    tolerance: float = 1e-8,
    adhesion: Adhesion,
    mean_gaps: Loads | None = None,
) -> Iterator[AdhesiveState]: ...


@numeric(modulus="Pa", forces=force_unit, depths="m", pressures="Pa", hardness="Pa", mean_gaps="m")
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
    hardness: Hardness | None = None,
    flow: FlowReading = "removed",
    adhesion: Adhesion | None = None,
    mean_gaps: Loads | None = None,
) -> Iterator[Solution] | Iterator[AdhesiveState]:
    """Yield the solution of every load, in order; each starts from the one before, if that met its tolerance.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `press`.
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa], or what it follows from.
    forces, depths, pressures : array, shape (n,)
        At most one: strictly increasing forces [N], depths [m] or nominal pressures [Pa]; under a hardness in any
        order. Without any, 24 forces that suit the surface, see `load_range`.
    operator : Operator, optional
        Another body than the half-space on the surface's grid, see `press`.
    solver : Solver, optional
        Settings of the method: `ActiveSet` (default) or `PolonskyKeer`.
    tolerance : float
        Largest residual of each load.
    hardness : float, array or function, optional
        Pressure that no cell exceeds [Pa], see `press`. What flows is kept: up to the largest load so far the contact
        is the elastic one of the flattened surface.
    flow : {"removed", "raised"}
        Where material that flows goes: it vanishes, or raises the whole surface evenly over all measured cells, its
        volume conserved (Pullen and Williamson 1972), which changes the depth alone.
    adhesion : Adhesion, optional
        What holds the bodies together. They come from beyond its reach, and `depths` or `forces` of either sign may go
        up and down: the bodies stay in the basin of their energy, and jump where it ends. States do not depend on the
        steps. The first force must be at least 0; one that pulls the bodies off ends the contact.
    mean_gaps : array, shape (n,), optional
        With adhesion, on a whole periodic grid, instead of depths: mean gaps [m], up and down. There the mean
        displacement is zero, and a mean gap is the mean separation less the depth.

    Yields
    ------
    Solution or AdhesiveState
        With its stiffness computed; with adhesion an `AdhesiveState` with the jumps on the way to it. A load that
        missed its tolerance says so in its `status`. Under a hardness so do the loads below it, by
        ``Status.AFTER_MISSED``: what flowed is kept, and is not known to the tolerance until a larger load follows.

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
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> soft = rc.RadialProfile(-rings.radii**2 / 2e-5, rings)
    >>> adhesion = rc.Adhesion(work=10e-3, range=4e-9)
    >>> there, back = rc.loading_path(soft, 1e8, depths=[20e-9, 0.0], adhesion=adhesion)
    >>> f"{there.force * 1e6:.2f} uN, {back.force * 1e6:.2f} uN, {back.status.value}"
    '1.03 uN, -0.44 uN, converged'
    """
    if adhesion is not None:
        from roughcontact.contact.sticking import sticking_states

        raised = None if flow == "removed" else flow
        refused = {"pressures": pressures, "solver": solver, "hardness": hardness, "flow": raised}
        grid_of(surface)
        loads = depths, forces, mean_gaps
        return sticking_states(surface, modulus, adhesion, loads, operator, tolerance, **refused)
    refuse_gaps(mean_gaps)
    raises, keeps = flow_reading(flow), hardness is not None
    if raises and depths is not None:
        raise ValueError(
            "depths cannot be named where the surface rises as it flows: give forces or pressures"
        )
    if forces is None and depths is None and pressures is None:
        forces = load_range(surface, modulus, operator=operator, hardness=hardness).forces
    controls = _controls(
        grid_of(surface), rising=not keeps, forces=forces, depths=depths, pressures=pressures
    )
    problem = make_problem(
        surface, modulus, controls[0], operator, tolerance=tolerance, hardness=hardness, curve=True
    )
    for control in controls[1:]:
        problem.under(control)  # what cannot be asked for is refused before the first load is solved
    if keeps:
        return follow_history(problem, controls, solver or ActiveSet(), raises=raises)
    return follow(problem, controls, solver or ActiveSet())


@overload
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
    hardness: Hardness | None = None,
    flow: FlowReading = "removed",
    adhesion: None = None,
    mean_gaps: None = None,
) -> Curve: ...


@overload
def loading_curve(
    surface: Body,
    modulus: float | Solid | tuple[Solid, Solid],
    *,
    forces: Loads | None = None,
    depths: Loads | None = None,
    operator: Operator | None = None,
    tolerance: float = 1e-8,
    adhesion: Adhesion,
    mean_gaps: Loads | None = None,
) -> AdhesiveLoop: ...


@numeric(modulus="Pa", forces=force_unit, depths="m", pressures="Pa", hardness="Pa", mean_gaps="m")
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
    hardness: Hardness | None = None,
    flow: FlowReading = "removed",
    adhesion: Adhesion | None = None,
    mean_gaps: Loads | None = None,
) -> Curve | AdhesiveLoop:
    """Return stiffness, contact area, depth and more as functions of load.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `press`.
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa], or what it follows from.
    forces, depths, pressures : array, shape (n,)
        At most one: strictly increasing forces [N], depths [m] or nominal pressures [Pa]; under a hardness in any
        order. Without any, 24 forces that suit the surface, see `load_range`.
    operator : Operator, optional
        Another body than the half-space on the surface's grid, see `press`.
    solver : Solver, optional
        Settings of the method: `ActiveSet` (default) or `PolonskyKeer`.
    tolerance : float
        Largest residual of each load.
    hardness : float, array or function, optional
        Pressure that no cell exceeds [Pa], see `press`. What flows is kept: up to the largest load so far the contact
        is the elastic one of the flattened surface.
    flow : {"removed", "raised"}
        Where material that flows goes: it vanishes, or raises the whole surface evenly over all measured cells, its
        volume conserved (Pullen and Williamson 1972), which changes the depth alone.
    adhesion : Adhesion, optional
        What holds the bodies together, see `loading_path`: loads of either sign go up and down.
    mean_gaps : array, shape (n,), optional
        With adhesion, see `loading_path`.

    Returns
    -------
    Curve or AdhesiveLoop
        One point for each load, marked where a load missed its tolerance; fields are not kept, see `loading_path`.
        With adhesion an `AdhesiveLoop`, with the branch of each point and the jumps.

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
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> soft = rc.RadialProfile(-rings.radii**2 / 2e-5, rings)
    >>> adhesion = rc.Adhesion(work=10e-3, range=4e-9)
    >>> curve = rc.loading_curve(soft, 1e8, depths=[0.0, 20e-9, 0.0, -5e-9], adhesion=adhesion)
    >>> curve.approach.tolist(), f"{curve.pull_off_force * 1e9:.0f} nN"
    ([True, True, False, False], '511 nN')
    """
    given: dict[str, Any] = {"forces": forces, "depths": depths, "pressures": pressures}
    given |= {"operator": operator, "solver": solver, "tolerance": tolerance, "hardness": hardness}
    given |= {"flow": flow, "adhesion": adhesion, "mean_gaps": mean_gaps}
    path: Iterator[Any] = loading_path(surface, modulus, **given)
    if adhesion is None:
        return collect(path)
    from roughcontact.contact.adhesive_branches import collect_states

    loads = np.negative(mean_gaps) if mean_gaps is not None else forces if depths is None else depths
    return collect_states(path, np.atleast_1d(np.asarray(loads, np.float64)))


def _controls(
    grid: AnyGrid, *, rising: bool, forces: Loads | None, depths: Loads | None, pressures: Loads | None
) -> list[Control]:
    """Return the controls that exactly one of the three lists states, which must be `rising` or may be in any order."""
    name, loads = exactly_one(force=forces, depth=depths, pressure=pressures)
    values = np.atleast_1d(number(loads, f"the list of {name}s"))
    if values.ndim != 1 or not len(values):
        raise ValueError(
            f"the list of {name}s must hold at least one number in one row, not shape {values.shape}"
        )
    require(np.isfinite(values), f"the {name}s must be finite", values)
    if rising and not (np.diff(values) > 0).all():
        at = int(np.argmin(np.diff(values) > 0))
        raise ValueError(
            f"the {name}s must increase strictly, but {values[at + 1]:g} follows {values[at]:g} at place {at + 1}; "
            "only under a hardness or with an adhesion do loads go up and down"
        )
    return [control_of(grid, **{name: float(v)}) for v in values]
