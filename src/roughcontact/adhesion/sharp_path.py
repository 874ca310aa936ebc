"""The states of a body that is stuck, drawn back along falling depths or forces."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from roughcontact.adhesion.adhesive_state import AdhesiveState, Blank
from roughcontact.adhesion.control_form import ForceControl
from roughcontact.adhesion.detachment import Detachment, StuckContact, mean_compliance
from roughcontact.adhesion.quasi_static import Jump
from roughcontact.adhesion.truncated_newton import Counter, minimise
from roughcontact.halfspace.operators.operator import exact_of
from roughcontact.threads import one_blas_thread
from roughcontact.validation import Array

__all__ = ["sharp_states"]


def _require_drawn_back(goals: list[float]) -> None:
    """Refuse a path that is not one of detachment."""
    if len(goals) < 2 or not goals[0] > 0 or any(b > a for a, b in pairwise(goals)):
        raise ValueError(
            "the sharp law says when stuck cells let go, not how they come to be stuck: give at least two falling "
            "depths or forces (loading_path), the first, above zero, being where the surfaces have been pressed "
            "without attraction; an approach needs the exponential law or Dugdale's"
        )


def sharp_states(blank: Blank, goals: list[float]) -> Iterator[AdhesiveState]:
    """Return the states at falling depths or forces, the first pressed without attraction, and then stuck.

    Parameters
    ----------
    blank : Blank
    goals : list of float
        Depths [m] or forces [N], as the blank is controlled.

    Raises
    ------
    ValueError
        If there is one value alone, the first is not positive, or one is above that before.
    """
    _require_drawn_back(goals)
    return _drawn_back(blank, goals)


def _drawn_back(blank: Blank, goals: list[float]) -> Iterator[AdhesiveState]:
    control, by_force = blank.control, isinstance(blank.control, ForceControl)
    inside, counter = blank.form.inside, Counter()
    with one_blas_thread():
        pressed = minimise(control.energy_at(goals[0]), np.zeros(blank.form.shape), counter).point
        law = control.attraction.on(inside)
        work = np.broadcast_to(np.asarray(law.work), blank.separation.shape)
        stuck = StuckContact(
            blank.operator,
            blank.separation,
            pressed.gap[inside] <= 0,
            work,
            mean_compliance(blank.operator.grid, blank.modulus),
        )
    here, lowest = goals[0], math.inf
    for goal in goals:
        with one_blas_thread():
            events = tuple(stuck.drawn_back(here, goal, by_force))
            depth = stuck.depth(goal) if by_force else goal
            # Between events the force is linear in the depth and falls with it: it is lowest before one, or at the end.
            lowest = min(lowest, *(event.force_before for event in events), stuck.force(depth))
            state = _state(blank, stuck, depth, goal if by_force else None, events, counter.products, lowest)
        here = goal
        counter = Counter()
        yield state


def _state(
    blank: Blank,
    stuck: StuckContact,
    depth: float,
    force: float | None,
    events: tuple[Detachment, ...],
    products: int,
    lowest: float,
) -> AdhesiveState:
    pressure, contact = stuck.pressure(depth)
    for array in (pressure, contact):
        array.flags.writeable = False
    residual = 0.0
    if contact.any():
        # Stuck cells have no gap, and the others no overlap.
        gap = exact_of(blank.operator).apply(pressure) + blank.separation - depth
        wrong = np.where(contact, np.abs(gap), np.maximum(-gap, 0.0))
        residual = _relative(float(wrong.max()) / blank.form.reference, pressure)
        if force is not None:
            weighted = pressure * blank.operator.weights
            residual = max(residual, abs(float(weighted.sum()) - force) / float(np.abs(weighted).sum()))
    law = blank.control.attraction.on(blank.form.inside)
    off = [events[-1]] if events and not contact.any() else []
    jumps = tuple(
        Jump(e.depth, e.depth_after, e.force_before, e.force_after, 0.0, e.lost, False, False) for e in off
    )
    return AdhesiveState(blank, law, depth, pressure, contact, residual, jumps, products, lowest, events)


def _relative(traction: float, pressure: Array) -> float:
    largest = float(np.abs(pressure).max())
    return traction / largest if largest > 0 else math.inf
