"""Surfaces that stick, from what a user gives to states along prescribed depths or forces."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from roughcontact.adhesion.adhesive_state import AdhesiveState
from roughcontact.adhesion.attraction import Adhesion
from roughcontact.adhesion.path_states import states_along
from roughcontact.contact.problem import Body, separation_of
from roughcontact.halfspace.operators.build import body_on
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.material import Solid, as_modulus
from roughcontact.solver.control import checked_tolerance
from roughcontact.validation import Array, exactly_one, number, require, shown

__all__ = ["sticking_states"]


def sticking_states(
    surface: Body,
    modulus: float | Solid | tuple[Solid, Solid],
    adhesion: Adhesion,
    depths: float | Sequence[float] | Array | None,
    forces: float | Sequence[float] | Array | None,
    operator: Operator | None,
    tolerance: float,
    **others: Any,
) -> Iterator[AdhesiveState]:
    """Yield the state of a surface at each depth or under each force, in order.

    What a contact that sticks cannot take is refused at once.

    Raises
    ------
    ValueError
        If not one of depths and forces is given, or something among `others` is.
    """
    require(isinstance(adhesion, Adhesion), f"an Adhesion is wanted, not {shown(adhesion)}")
    given = [name for name, value in others.items() if value is not None]
    if given:
        raise ValueError(f"a contact that sticks takes no {' or '.join(given)}: give depths or forces")
    name, loads = exactly_one(depths=depths, forces=forces)
    goals = np.atleast_1d(number(loads, f"the list of {name}"))
    if goals.ndim != 1 or not len(goals) or not np.isfinite(goals).all():
        raise ValueError(f"the list of {name} must hold finite numbers in one row, not {shown(loads)}")
    value = as_modulus(modulus)
    body = body_on(surface.grid, value, operator)
    allowed = checked_tolerance(tolerance)
    return states_along(
        body,
        separation_of(surface),
        adhesion,
        modulus=value,
        depths=goals if name == "depths" else None,
        forces=goals if name == "forces" else None,
        tolerance=allowed,
    )
