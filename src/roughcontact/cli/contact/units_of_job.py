"""The units of numbers per area that a job names."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughcontact.recipe.recipe_fields import value_of

if TYPE_CHECKING:
    from roughcontact.labels.engineering_units import Scale
    from roughcontact.recipe.outputs import Units

__all__ = ["units_of_job"]

_UNITS = {
    "interfacial_stiffness_per_area": "unit_stiffness",
    "unloaded_interfacial_stiffness_per_area": "unit_stiffness",
    "nominal_pressure": "unit_pressure",
}


def units_of_job(units: Units) -> dict[str, Scale]:
    """Return the units that the job names, by column."""
    from roughcontact.labels.engineering_units import Scale

    return {
        column: Scale(1 / value_of(units, name), text.strip())
        for column, name in _UNITS.items()
        if (text := getattr(units, name)) is not None
    }
