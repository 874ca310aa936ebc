"""The numbers of one load that can stand on a curve: their names, units and values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.labels.column import Column, shown_in
from roughcontact.labels.contact_columns import CERTIFICATES, CONDUCTION_PER_AREA, POINTS, STATE_NAMES
from roughcontact.labels.labelled import plain_values, values_of

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution
    from roughcontact.evaluation.conduction import Conductors

__all__ = ["columns", "point_of"]

_SHOWN = shown_in("page", (*POINTS, *CERTIFICATES))
_CONDUCTED = shown_in("page", CONDUCTION_PER_AREA)


def columns(conductors: Conductors | None) -> list[dict[str, str]]:
    """Return the quantities of a point, with the words and units of pictures."""
    from roughcontact.plot.drawing.engineering_units import pretty

    shown = _SHOWN if conductors is None else (*_SHOWN, *_CONDUCTED)
    return [{"name": each.name, "label": each.label, "unit": pretty(each.unit)} for each in shown]


def point_of(solution: Solution, conductors: Conductors | None) -> dict[str, Any]:
    """Return the quantities of a loaded state in SI units; None where one is infinite."""
    from roughcontact.evaluation.conduction import conductance

    point: dict[Column, Any] = values_of(solution, _SHOWN, STATE_NAMES)
    if conductors is not None:
        conducted = conductance(
            solution,
            resistivities=conductors.resistivities,
            conductivities=conductors.conductivities,
        )
        point |= {each: float(conducted[each.name]) for each in _CONDUCTED}
    return {each.name: plain_values(value) for each, value in point.items()}
