"""Every quantity of the tables of answers, by its name.

Datasets, files and pictures take units and names only from these tables.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Any

from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import geometry_of
from roughcontact.labels import (
    adhesive_columns,
    contact_columns,
    cycle_columns,
    flow_columns,
    flux_columns,
    joint_columns,
    shear_columns,
    sliding_columns,
    slip_columns,
    viscoelastic_columns,
)
from roughcontact.labels.column import Column

__all__ = ["VARIABLES", "force_unit", "unit_of"]


def _columns(value: Any) -> Iterator[Column]:
    """Yield the columns of a table, of a tuple of columns, or of a single column."""
    if isinstance(value, Column):
        yield value
    elif isinstance(value, tuple | dict):
        for part in value.values() if isinstance(value, dict) else value:
            yield from _columns(part)


# For quantities of several answers, the words of non-adhesive contact apply: its tables come last.
VARIABLES: Mapping[str, Column] = MappingProxyType(
    {
        column.name: column
        for tables in (
            *(
                flow_columns,
                viscoelastic_columns,
                sliding_columns,
                cycle_columns,
                shear_columns,
                slip_columns,
                adhesive_columns,
                flux_columns,
                joint_columns,
            ),
            contact_columns,
        )
        for value in vars(tables).values()
        for column in _columns(value)
    }
)


def unit_of(name: str, geometry: Geometry = Geometry.SURFACE) -> str:
    """Return the unit of a quantity in a geometry."""
    return VARIABLES[name].unit_on(geometry)


def force_unit(arguments: Mapping[str, Any]) -> str:
    """Return the unit of the forces among the arguments of a function or method: per length along a line."""
    operator = arguments.get("operator")
    geometry = Geometry.SURFACE if operator is None else geometry_of(operator)
    return unit_of("force", getattr(arguments.get("self"), "geometry", geometry))
