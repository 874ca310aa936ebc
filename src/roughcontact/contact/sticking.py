"""Surfaces that stick, from what a user gives to states along prescribed depths, forces or mean gaps."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from roughcontact.adhesion.adhesive_state import AdhesiveState
from roughcontact.adhesion.attraction import Adhesion
from roughcontact.adhesion.path_states import states_along
from roughcontact.contact.memory_needed import require_memory_for
from roughcontact.contact.problem import Body, separation_of
from roughcontact.halfspace.operators.build import body_on
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import Operator, geometry_of
from roughcontact.material import Solid, as_modulus
from roughcontact.solver.control import checked_tolerance
from roughcontact.validation import Array, exactly_one, number, require, shown

__all__ = ["sticking_states"]

Given = float | Sequence[float] | Array | None


def sticking_states(
    surface: Body,
    modulus: float | Solid | tuple[Solid, Solid],
    adhesion: Adhesion,
    loads: tuple[Given, Given, Given],
    operator: Operator | None,
    tolerance: float,
    **others: Any,
) -> Iterator[AdhesiveState]:
    """Yield the state of a surface at each depth, under each force or at each mean gap, in order.

    The `loads` are depths, forces and mean gaps, of which one is given. What a contact that sticks cannot take is
    refused at once.

    Raises
    ------
    ValueError
        If not one of depths, forces and mean gaps is given, or something among `others` is.
    """
    wanted = f"an Adhesion is wanted, such as Adhesion(0.05, 2e-9), not {shown(adhesion)}"
    require(isinstance(adhesion, Adhesion), wanted)
    given = [name for name, value in others.items() if value is not None]
    if given:
        raise ValueError(f"a contact that sticks takes no {' or '.join(given)}: give depths or forces alone")
    name, values = exactly_one(**dict(zip(("depths", "forces", "mean_gaps"), loads, strict=True)))
    words = name.replace("_", " ")
    goals = np.atleast_1d(number(values, f"the list of {words}"))
    if goals.ndim != 1 or not len(goals) or not np.isfinite(goals).all():
        raise ValueError(f"the list of {words} must hold finite numbers in one row, not {shown(values)}")
    require_memory_for(surface, operator)
    value = as_modulus(modulus)
    body = body_on(surface.grid, value, operator)
    if geometry_of(body) is Geometry.FOUNDATION:
        raise ValueError(
            "springs bear forces per length, and no work of adhesion per area: take a half-space, a line or rings; "
            "for bodies of revolution see mdr.adhesion"
        )
    allowed = checked_tolerance(tolerance)
    return states_along(
        body,
        separation_of(surface),
        adhesion,
        modulus=value,
        **{name: goals},
        surface=surface,
        tolerance=allowed,
    )
