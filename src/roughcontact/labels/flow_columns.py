"""The tables of the flow through a gap, and of a leak."""

from __future__ import annotations

from roughcontact.labels.column import Table, columns
from roughcontact.labels.contact_columns import POINTS

__all__ = [
    *("CONSTRICTION", "FLOW_MAPS", "FLOW_NAMES", "GAP_FLOW", "LEAK"),
    *("FLOW_OF_CURVE", "PRESSED"),
]

PRESSED = tuple(each for each in POINTS if each.name in ("nominal_pressure", "contact_fraction", "mean_gap"))
"""Columns of the contact."""
GAP_FLOW: Table = {
    ("principal",): columns(
        "eigenvalues | m3 | eigenvalues of the transmissivity | facts | transmissivity, principal"
    ),
    ("row", "column"): columns("""
        transmissivity | m3 | cubed hydraulic gap of the flow, its upper bound | joint page
        lower_transmissivity | m3 | lower bound of the transmissivity
    """),
    (): columns("""
        flow_residual | 1 | difference of both bounds of the transmissivity, relative | facts | certificate of the flow
        hydraulic_gap | m | uniform gap with the same transmissivity | facts joint page
        percolates | | whether an open path leads through the gap | joint page | open path | .0f
    """),
}
FLOW_OF_CURVE = (
    *GAP_FLOW[()][1:2],
    *GAP_FLOW[("row", "column")][:1],
    *columns("""
        flow_factor | 1 | transmissivity over the cubed mean gap | joint page
        transmissivity_bruggeman | m3 | transmissivity of an effective medium of the same gaps (Bruggeman)
    """),
    *GAP_FLOW[()][2:],
)
"""Columns of a curve with the measure of the flow."""
FLOW_MAPS = columns("""
    fluid_pressure | 1 | pressure of the fluid for a unit drop
    flux_y | m2 | flux down the map for a unit drop and a viscosity of 1/12
    flux_x | m2 | flux along the rows for a unit drop and a viscosity of 1/12
""")
CONSTRICTION: Table = {
    (): columns("""
        constriction_cells | 1 | open cells across the critical constriction | facts | constriction, open cells across
        constriction_width | m | width of the critical constriction | facts | constriction, width
        constriction_gap | m | largest gap in the critical constriction | facts | constriction, largest gap
        constriction_share | 1 | part of the dissipation in the critical constriction | facts | constriction, share
    """),
    ("axis",): columns(
        "constriction_place | m | place of the critical constriction | facts | constriction, place (y, x)"
    ),
}
LEAK = columns("""
    upstream | Pa | pressure before the seal
    downstream | Pa | pressure behind the seal
    leak_rate | m3 s-1 | volume flow of the leak, of a gas at the mean pressure
    throughput | Pa m3 s-1 | pressure times volume flow of a gas
    mass_rate | kg s-1 | mass flow of the leak
    film_reynolds | 1 | reduced Reynolds number in the critical constriction | facts | Reynolds number
    rarefaction | 1 | rarefaction parameter of a gas in the critical constriction | facts
""")
FLOW_NAMES = {
    "leak_rate": "volume",
    "mass_rate": "mass",
    "film_reynolds": "reynolds",
    "flow_residual": "residual",
    **{each.name: each.name.replace("_", ".", 1) for table in CONSTRICTION.values() for each in table},
}
"""Attributes of a `GapFlow` and of a `Leak`, by columns."""
