"""Adhesive contact under prescribed loads: one state, a path of states, and a curve."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from roughcontact.adhesion.adhesive_curve import AdhesiveCurve, collect_states
from roughcontact.adhesion.adhesive_state import AdhesiveState
from roughcontact.adhesion.attraction import Adhesion, require_areas
from roughcontact.adhesion.path_states import states_along
from roughcontact.contact.convergence import ConvergenceError
from roughcontact.contact.memory_needed import require_memory_for
from roughcontact.contact.problem import Body, separation_of
from roughcontact.halfspace.operators.build import body_on
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.labels.variables import force_unit
from roughcontact.materials import Modulus, as_modulus
from roughcontact.progress.events import task, tracked
from roughcontact.solver.control import checked_tolerance
from roughcontact.solver.loads import Loads
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.validation import Array, numeric

__all__ = ["adhesive_curve", "adhesive_path", "adhesive_state", "followed", "states_under"]


@numeric(modulus="Pa", depth="m", force=force_unit, pressure="Pa", mean_gap="m")
def adhesive_state(
    surface: Body,
    modulus: Modulus,
    adhesion: Adhesion,
    *,
    depth: float | None = None,
    force: float | None = None,
    pressure: float | None = None,
    mean_gap: float | None = None,
    operator: Operator | None = None,
    tolerance: float = 1e-8,
) -> AdhesiveState:
    """Return the state of an adhesive contact at the end of an approach from beyond the range of the attraction.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], positive toward the flat. Its grid is free or periodic.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    adhesion : Adhesion
        Work, range and law of the attraction.
    depth, force, pressure, mean_gap : float
        Exactly one: indentation depth [m] of either sign, normal force [N] of at least 0 ([N/m] on a line), nominal
        pressure [Pa] of at least 0 (force over the area of all cells), or mean gap [m] of a whole periodic surface,
        above 0: the mean separation minus the depth.
    operator : Operator, optional
        A body other than the half-space on the surface's grid, see `press`; not a foundation.
    tolerance : float
        Largest residual, see `AdhesiveState`.

    Returns
    -------
    AdhesiveState
        Pressure, contact, depth and certificate; energies, stiffness and stability follow from it.

    Raises
    ------
    ValueError
        If the input makes no sense, or the cells do not resolve the attraction; the message names the value and the
        remedy.
    ConvergenceError
        If the tolerance was missed. It carries the state.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-rings.radii**2 / 2e-5, rings)
    >>> state = rc.adhesive_state(ball, 1e8, rc.Adhesion(work=10e-3, range=4e-9), force=0.0)
    >>> f"{state.depth * 1e9:.1f} nm deep without a force, {state.status.value}"
    '8.5 nm deep without a force, converged'
    """
    loads = Loads.of(depth=depth, force=force, pressure=pressure, mean_gap=mean_gap)
    with task("Pressing", shape=surface.grid.shape):
        state = next(states_under(surface, modulus, adhesion, loads, operator, tolerance))
    if not state.status.converged:
        raise ConvergenceError(state)
    return state


@numeric(modulus="Pa", depths="m", forces=force_unit, pressures="Pa", mean_gaps="m")
def adhesive_path(
    surface: Body,
    modulus: Modulus,
    adhesion: Adhesion,
    *,
    depths: Sequence[float] | Array | None = None,
    forces: Sequence[float] | Array | None = None,
    pressures: Sequence[float] | Array | None = None,
    mean_gaps: Sequence[float] | Array | None = None,
    operator: Operator | None = None,
    tolerance: float = 1e-8,
) -> Iterator[AdhesiveState]:
    """Yield the state of an adhesive contact at each load, in order, with the jumps on the way to it.

    The bodies approach from beyond the range of the attraction. They stay in one basin of their energy until it ends,
    and then jump. States do not depend on the steps of the loads.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `adhesive_state`.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    adhesion : Adhesion
        Work, range and law of the attraction.
    depths, forces, pressures, mean_gaps : array, shape (n,)
        Exactly one, up and down: depths [m], forces [N] ([N/m] on a line) or nominal pressures [Pa] of either sign, or
        mean gaps [m] above 0 of a whole periodic surface, see `adhesive_state`. The first force or pressure must be at
        least 0; a force that pulls the bodies off ends the contact.
    operator : Operator, optional
        A body other than the half-space on the surface's grid, see `press`; not a foundation.
    tolerance : float
        Largest residual of each state, see `AdhesiveState`.

    Yields
    ------
    AdhesiveState
        Check its `status`: a state may miss the tolerance.

    Raises
    ------
    ValueError
        If the input makes no sense or the cells do not resolve the attraction; raised by the call, before the first
        load.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-rings.radii**2 / 2e-5, rings)
    >>> adhesion = rc.Adhesion(work=10e-3, range=4e-9)
    >>> there, back = rc.adhesive_path(ball, 1e8, adhesion, depths=[20e-9, 0.0])
    >>> f"{there.force * 1e6:.2f} uN, {back.force * 1e6:.2f} uN, {back.status.value}"
    '1.03 uN, -0.44 uN, converged'
    """
    loads = Loads.of(depths=depths, forces=forces, pressures=pressures, mean_gaps=mean_gaps)
    return followed(states_under(surface, modulus, adhesion, loads, operator, tolerance), loads)


@numeric(modulus="Pa", depths="m", forces=force_unit, pressures="Pa", mean_gaps="m")
def adhesive_curve(
    surface: Body,
    modulus: Modulus,
    adhesion: Adhesion,
    *,
    depths: Sequence[float] | Array | None = None,
    forces: Sequence[float] | Array | None = None,
    pressures: Sequence[float] | Array | None = None,
    mean_gaps: Sequence[float] | Array | None = None,
    operator: Operator | None = None,
    tolerance: float = 1e-8,
) -> AdhesiveCurve:
    """Return force, contact area, energy and more of an adhesive contact at each load, and its jumps.

    For an approach to a depth with the whole retreat, see `adhesive_loop`.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `adhesive_state`.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    adhesion : Adhesion
        Work, range and law of the attraction.
    depths, forces, pressures, mean_gaps : array, shape (n,)
        Exactly one, up and down, see `adhesive_path`.
    operator : Operator, optional
        A body other than the half-space on the surface's grid, see `press`; not a foundation.
    tolerance : float
        Largest residual of each state, see `AdhesiveState`.

    Returns
    -------
    AdhesiveCurve
        One point for each load with its branch and status, and the jumps; fields are not kept, see `adhesive_path`.

    Raises
    ------
    ValueError
        If the input makes no sense, or the cells do not resolve the attraction.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-rings.radii**2 / 2e-5, rings)
    >>> adhesion = rc.Adhesion(work=10e-3, range=4e-9)
    >>> curve = rc.adhesive_curve(ball, 1e8, adhesion, depths=[0.0, 20e-9, 0.0, -5e-9])
    >>> curve.approach.tolist(), f"{curve.pull_off_force * 1e9:.0f} nN"
    ([True, True, False, False], '511 nN')
    """
    loads = Loads.of(depths=depths, forces=forces, pressures=pressures, mean_gaps=mean_gaps)
    states = states_under(surface, modulus, adhesion, loads, operator, tolerance)
    return collect_states(followed(states, loads), loads)


def followed(states: Iterator[AdhesiveState], loads: Loads) -> Iterator[AdhesiveState]:
    """Yield the states at the loads, and report the progress."""
    return tracked(states, "Approach and retreat", "loads", len(loads.values))


@analysed_on_host
def states_under(
    surface: Body,
    modulus: Modulus,
    adhesion: Adhesion,
    loads: Loads,
    operator: Operator | None,
    tolerance: float,
) -> Iterator[AdhesiveState]:
    """Yield the state at each load, see `adhesive_path`.

    Raises
    ------
    ValueError
        If the input makes no sense; raised by the call, before the first load.
    """
    require_memory_for(surface, operator)
    value = as_modulus(modulus)
    body = body_on(surface.grid, value, operator)
    require_areas(body)
    return states_along(
        body,
        separation_of(surface),
        adhesion,
        loads.as_forces(surface.grid),
        modulus=value,
        surface=surface,
        tolerance=checked_tolerance(tolerance),
    )
