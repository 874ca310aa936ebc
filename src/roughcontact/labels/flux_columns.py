"""The tables of the current or heat through a contact: in all, of each cell and of each spot."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from roughcontact.labels.column import CELLS, Column, Table, columns
from roughcontact.labels.contact_columns import CONDUCTION, CONTACT, SPOT_LABEL, SPOTS

__all__ = ["FLUX", "FLUX_NAMES", "HEAT_PARTS", "HEAT_PARTS_NAMES"]

_SHARE = Column(
    "spot_share",
    "1",
    "part of the current or heat that flows through a contact spot",
    "",
    "share of the spot",
)


def _table(density: Column, of_spot: tuple[Column, ...], numbers: tuple[Column, ...]) -> Table:
    """Return the columns of one kind of flux."""
    return {
        (CELLS,): (density, CONTACT, SPOT_LABEL),
        ("spot",): (*SPOTS[("spot",)], _SHARE, *of_spot),
        (): numbers,
    }


FLUX: Mapping[str, Table] = {
    "electrical": _table(
        Column("current_density", "A m-2", "electrical current density in the plane of contact"),
        columns("""
            spot_current | A | current through a contact spot
            spot_resistance | ohm | resistance of a contact spot among the others
            spot_resistance_alone | ohm | resistance of a contact spot between half-spaces that touch only there
            spot_resistance_holm | ohm | Holm's resistance of a round contact spot of equal area
        """),
        (*columns("current | A | current \n voltage | V | voltage across the contact"), *CONDUCTION[:2]),
    ),
    "thermal": _table(
        Column("heat_flux", "W m-2", "heat flux in the plane of contact"),
        columns("""
            spot_heat_flow | W | heat flow through a contact spot
            spot_thermal_resistance | K W-1 | thermal resistance of a contact spot among the others
            spot_thermal_resistance_alone | K W-1 | \
                thermal resistance of a contact spot between half-spaces that touch only there
            spot_thermal_resistance_holm | K W-1 | Holm's thermal resistance of a round contact spot of equal area
        """),
        (
            *columns(
                "heat_flow | W | heat flow \n temperature_difference | K | difference across the contact"
            ),
            *CONDUCTION[2:],
        ),
    ),
}
"""By the kind of the flux."""

# The attributes in the order of the columns, the same for both kinds.
_ATTRIBUTES: Mapping[tuple[str, ...], tuple[str, ...]] = {
    (CELLS,): ("density", "solution.contact", "spots.labels"),
    ("spot",): (
        *("spots.areas", "spots.loads", "shares"),
        *("fluxes", "resistances", "resistances_alone", "resistances_holm"),
    ),
    (): ("total", "drop", "conductance", "resistance"),
}
FLUX_NAMES: Mapping[str, str] = MappingProxyType(
    {
        column.name: attribute
        for table in FLUX.values()
        for along, of in table.items()
        for column, attribute in zip(of, _ATTRIBUTES[along], strict=True)
    }
)
"""The attributes that hold the columns."""
HEAT_PARTS = columns("""
    spots_conductance_per_area | W m-2 K-1 | thermal conductance of the spots with their film over the nominal area | \
        joint page | h of the spots
    gas_conductance_per_area | W m-2 K-1 | thermal conductance of the gas in the gap over the nominal area | \
        joint page | h of the gas
    radiation_conductance_per_area | W m-2 K-1 | thermal conductance of radiation over the nominal area | \
        joint page | h of radiation
    joint_conductance_per_area | W m-2 K-1 | \
        thermal conductance of spots, gas and radiation together over the nominal area | joint page | h of the joint
    conductance_interaction | 1 | conductance of gas and radiation over that of a layer of the bodies, as thick as the \
        longer side of the map; up to 0.2 the parts add
    conductance_residual | 1 | error of the unit drop where the parts do not add, root mean square
""")
"""The thermal conductance of a joint by its parts."""
HEAT_PARTS_NAMES: Mapping[str, str] = MappingProxyType(
    dict(
        zip(
            (each.name for each in HEAT_PARTS),
            ("spots", "gas", "radiation", "total", "interaction", "residual_of_total"),
            strict=True,
        )
    )
)
"""Attributes of a `JointConductance`, by columns."""
