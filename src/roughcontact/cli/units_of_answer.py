"""Units of an answer, as the user named them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from roughcontact.cli.option_groups import option
from roughcontact.cli.unit_options import PRESSURE, STIFFNESS_PER_AREA, parse_unit

if TYPE_CHECKING:
    from roughcontact.plot.drawing.engineering_units import Scale

__all__ = ["Units"]


@dataclass(frozen=True, slots=True)
class Units:
    """Units of the numbers per area in table, CSV, NetCDF and picture."""

    PANEL: ClassVar = "Answer"
    unit_stiffness: str | None = option(
        "Unit of the interfacial stiffness per area K/A0 in table, picture, CSV and NetCDF (default: N/um/mm^2, "
        "in CSV and NetCDF Pa/m).",
        "N/um/mm^2",
    )
    unit_pressure: str | None = option(
        "Unit of the nominal pressure, likewise (default: one that suits, in CSV and NetCDF Pa).", "MPa"
    )

    def chosen(self) -> dict[str, Scale]:
        """Return the units that were named, by the column that is given in them."""
        from roughcontact.plot.drawing.engineering_units import Scale

        given = (
            ("interfacial_stiffness_per_area", self.unit_stiffness, STIFFNESS_PER_AREA, "--unit-stiffness"),
            ("nominal_pressure", self.unit_pressure, PRESSURE, "--unit-pressure"),
        )
        return {
            name: Scale(1 / parse_unit(text, kind, words), text.strip())
            for name, text, kind, words in given
            if text is not None
        }
