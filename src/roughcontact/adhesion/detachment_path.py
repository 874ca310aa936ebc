"""States of stuck surfaces along falling depths or forces, from a pressed contact and a work of adhesion."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from roughcontact.adhesion.attraction import require_areas
from roughcontact.adhesion.detachment import Detachment, StuckContact, mean_compliance
from roughcontact.adhesion.detachment_state import DetachmentState
from roughcontact.contact.problem import ContactProblem
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError
from roughcontact.halfspace.operators.operator import exact_of
from roughcontact.labels.variables import unit_of
from roughcontact.progress.events import task, tracked
from roughcontact.solver.loads import Loads
from roughcontact.threads import one_blas_thread
from roughcontact.validation import Array, numeric, positive, require

__all__ = ["detachment_path", "force_unit_of", "states_drawn_back"]


def force_unit_of(arguments: Mapping[str, Any]) -> str:
    """Return the unit of forces for the solution among the arguments."""
    return unit_of("force", arguments["solution"].problem.geometry)


@numeric(work="J/m^2", depths="m", forces=force_unit_of, pressures="Pa")
def detachment_path(
    solution: Solution,
    work: float | Array,
    *,
    depths: Sequence[float] | Array | None = None,
    forces: Sequence[float] | Array | None = None,
    pressures: Sequence[float] | Array | None = None,
) -> Iterator[DetachmentState]:
    """Yield the state at each depth or force on the retreat of surfaces that stick where they were pressed.

    This is the limit of Johnson, Kendall and Roberts: an attraction of zero range, for bodies whose Irwin length no
    grid resolves. Cells in contact under the preload are stuck. They let go one by one, each when its tension is too
    large (Pohrt and Popov 2015), and none comes back. The states do not depend on the steps. For an approach, or an
    attraction with a range, see `Adhesion`.

    Parameters
    ----------
    solution : Solution
        The preload: an elastic contact that is larger than the contact at the pull-off.
    work : float or array, shape of the grid
        Work of adhesion w [J/m^2]: the work to separate a unit area.
    depths, forces, pressures : array, shape (n,)
        At most one: falling depths [m], forces [N] or nominal pressures [Pa], the first at most that of the solution.
        Without any, three states: the preload, the state under the largest tension, and the state in which the last
        cell has let go.

    Yields
    ------
    DetachmentState
        With the cells that let go since the state before, and the largest tension so far.

    Raises
    ------
    ValueError
        If nothing is in contact, if too many cells are, or if some flow at a hardness; if the body consists of springs;
        or if the loads do not fall, or a number makes no sense.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> pressed = rc.press(ball, 1e8, depth=2e-8)
    >>> states = rc.detachment_path(pressed, 10e-3, depths=[1e-8, 0.0, -1e-8])
    >>> [f"{state.force * 1e9:.0f} nN on {state.contact.sum()} rings" for state in states]
    ['295 nN on 45 rings', '-423 nN on 40 rings', '0 nN on 0 rings']
    >>> start, pull_off, off = rc.detachment_path(pressed, 10e-3)
    >>> f"{off.pull_off_force * 1e9:.0f} nN at {pull_off.depth * 1e9:.0f} nm, on {pull_off.contact.sum()} rings"
    '487 nN at -3 nm, on 34 rings'
    """
    return states_drawn_back(solution, work, Loads.given(depths=depths, forces=forces, pressures=pressures))


def states_drawn_back(
    solution: Solution, work: float | Array, loads: Loads | None
) -> Iterator[DetachmentState]:
    """Yield the state at each load, see `detachment_path`; without loads, those of start, pull-off and end.

    Raises
    ------
    ValueError
        If the input makes no sense; raised by the call, before the first load.
    """
    preload = solution.on_host()
    problem = preload.problem
    require_areas(problem.operator)
    if preload.plastic.any():
        raise InputError(
            f"{int(np.count_nonzero(preload.plastic))} cells of this solution are at the hardness, and detachment is "
            "elastic",
            "give solution.flattened, the elastic contact after flow, or press without a hardness",
        )
    require(
        preload.contact.any(),
        "nothing is in contact in this solution",
        "press to a force or a depth above zero",
    )
    energy = positive(work, "work of adhesion [J/m^2]", zero=True)
    require(
        np.any(energy > 0),
        "the work of adhesion is zero everywhere",
        "give a number above zero",
        place="work",
    )
    require(
        energy.shape in ((), problem.grid.shape),
        f"the work of adhesion has shape {energy.shape}, and the grid {problem.grid.shape}",
        "give one number, or one for each cell",
        place="work",
    )
    if loads is not None:
        loads = _falling(loads.as_forces(problem.grid), preload)
    with one_blas_thread(), task("Inverting the influence matrix of", shape=(int(preload.contact.sum()),)):
        stuck = StuckContact(
            problem.operator,
            problem.separation,
            preload.contact,
            np.broadcast_to(energy, problem.grid.shape),
            mean_compliance(problem.grid, problem.modulus),
        )
    states = _drawn_back(preload, float(energy) if energy.ndim == 0 else energy, stuck, loads)
    return states if loads is None else tracked(states, "Drawing back", "loads", len(loads.values))


def _falling(loads: Loads, preload: Solution) -> Loads:
    """Return the loads, which must fall from that of the preload."""
    name, values = loads.kind, loads.values
    here = preload.force if name == "force" else preload.depth
    # The force of a solution is accurate to its tolerance.
    if values[0] > here + preload.problem.tolerance * abs(here) * (name == "force"):
        raise InputError(
            f"surfaces are drawn back from the {name} of the solution, {here:.6g}, and {values[0]:.6g} is above it",
            f"press to that {name}, or begin with {here:.6g} or less",
        )
    if (np.diff(values) > 0).any():
        at = int(np.argmax(np.diff(values) > 0))
        raise InputError(
            f"the {name}s of a detachment must fall, but {values[at + 1]:g} follows {values[at]:g} at place {at + 1}",
            "leave it out, or give adhesive_path an Adhesion with a range, with which surfaces come together again",
        )
    return loads


def _drawn_back(
    preload: Solution, work: float | Array, stuck: StuckContact, loads: Loads | None
) -> Iterator[DetachmentState]:
    by_force = loads is not None and loads.kind == "force"
    here = preload.force if by_force else preload.depth
    lowest, held = math.inf, stuck.snapshot()
    if loads is None:
        yield _state(preload, work, held, here, (), held.force(here), held)
    for goal in [-math.inf] if loads is None else loads.values.tolist():
        events: list[Detachment] = []
        deepest, before = 0, stuck.snapshot()
        with one_blas_thread():
            for event in stuck.drawn_back(here, goal, by_force):
                if event.force_before < lowest:
                    lowest, held, deepest = event.force_before, before, len(events)
                events.append(event)
                before = stuck.snapshot()
        if loads is None:
            here = events[deepest].depth
            yield _state(preload, work, held, here, events[:deepest], lowest, held)
            events = events[deepest:]
            here = events[-1].depth_after
        else:
            here = goal
        depth = stuck.depth(here) if by_force else here
        # Between events the force is linear in the depth and falls with it: it is lowest before one, or at the end.
        if (force := stuck.force(depth)) < lowest:
            lowest, held = force, before
        yield _state(preload, work, before, depth, events, lowest, held, goal if by_force else None)


@one_blas_thread()
def _state(
    preload: Solution,
    work: float | Array,
    stuck: StuckContact,
    depth: float,
    events: Sequence[Detachment],
    lowest: float,
    held: StuckContact,
    force: float | None = None,
) -> DetachmentState:
    """Return the state of a stuck contact, `held` being the contact under the lowest force."""
    pressure, contact = stuck.pressure(depth)
    for array in (pressure, contact):
        array.flags.writeable = False
    residual = _residual(preload.problem, stuck, pressure, depth, force)
    return DetachmentState(
        preload,
        work,
        depth,
        pressure,
        contact,
        stuck.stiffness,
        residual,
        tuple(events),
        lowest,
        held.area,
    )


def _residual(
    problem: ContactProblem, stuck: StuckContact, pressure: Array, depth: float, force: float | None
) -> float:
    """Return the residual: gaps of stuck cells, overlaps of others, and the error of a prescribed force."""
    if not len(stuck.cells):
        return 0.0
    body, held = exact_of(problem.operator), np.zeros(pressure.size, bool)
    held[stuck.cells] = True
    gap = body.apply(pressure) + problem.separation - depth
    wrong = np.where(held.reshape(gap.shape), np.abs(gap), np.maximum(-gap, 0.0))
    own = float(body.as_matrix(np.zeros(1, np.intp))[0, 0])
    strength = stuck.strength
    residual = float(wrong.max()) / own / max(strength, float(np.abs(pressure).max()))
    if force is None:
        return residual
    weighted = pressure * problem.operator.weights
    scale = max(strength * float(stuck.areas.min()), float(np.abs(weighted).sum()))
    return max(residual, abs(float(weighted.sum()) - force) / scale)
