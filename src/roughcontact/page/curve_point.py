"""The numbers of one load that can stand on a curve: their names, units and values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.labels.labelled import plain_values
from roughcontact.labels.variables import CURVE_POINTS, VARIABLES

if TYPE_CHECKING:
    from roughcontact.contact.conduction import Conductors
    from roughcontact.contact.solution import Solution

__all__ = ["columns", "point_of"]

_SHOWN = (
    *("force", "nominal_pressure", "depth", "stiffness", "interfacial_stiffness"),
    *("interfacial_stiffness_per_area", "contact_area", "contact_fraction", "mean_gap", "spots"),
    *("elastic_energy", "residual"),
)
_CONDUCTED = ("thermal_conductance_per_area", "electrical_conductance_per_area")


def columns(conductors: Conductors | None) -> list[dict[str, str]]:
    """Return the quantities of a point, with the words and units of pictures."""
    from roughcontact.plot.engineering_units import pretty

    return [
        {
            "name": name,
            "label": "certificate" if name == "residual" else VARIABLES[name].label,
            "unit": pretty(VARIABLES[name].unit),
        }
        for name in (_SHOWN if conductors is None else (*_SHOWN, *_CONDUCTED))
    ]


def point_of(solution: Solution, conductors: Conductors | None) -> dict[str, Any]:
    """Return the quantities of a loaded state in SI units; None where one is infinite."""
    from roughcontact.contact.conduction import conductance

    area = solution.problem.grid.area
    point: dict[str, Any] = {name: getattr(solution, name) for name in CURVE_POINTS}
    point |= {
        "nominal_pressure": solution.force / area,
        "contact_fraction": solution.contact_fraction,
        "interfacial_stiffness_per_area": solution.interfacial_stiffness / area,
        "spots": solution.spot_count,
        "residual": solution.residual,
    }
    if conductors is not None:
        conducted = conductance(
            solution,
            resistivities=conductors.resistivities,
            conductivities=conductors.conductivities,
        )
        point |= {name: float(conducted[name]) for name in _CONDUCTED}
    return {name: plain_values(value) for name, value in point.items()}
