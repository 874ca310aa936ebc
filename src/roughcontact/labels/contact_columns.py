"""The tables of a loaded state, a loading curve, a loop, the law of an interface, and of what a contact conducts.

A new column is one line here: files, records, tables on a screen and on the page, and labels of pictures use it.
"""

from __future__ import annotations

from dataclasses import replace
from types import MappingProxyType

from roughcontact.labels.column import CELLS, Column, Table, columns

__all__ = [
    *(
        "CERTIFICATES",
        "CONDUCTION",
        "CONDUCTION_PER_AREA",
        "CURVE",
        "ERRORS",
        "FLOW",
        "FLOW_DEPTH",
        "FLOW_RISE",
    ),
    *("HARDNESS", "HEIGHTS", "INTERFACE", "LOOP", "MAPS", "POINTS", "REFLECTION", "RMS", "SCALES", "SIZES"),
    "SPOTS",
    *("SPOT_LABEL", "STATE", "STATE_NAMES", "STATUS", "UNLOADED"),
]

POINTS = columns("""
    force | N | normal force | patch page facts
    nominal_pressure | Pa | force over the nominal area | joint page facts
    max_pressure | Pa | largest contact pressure of a cell | page facts | largest pressure
    mean_pressure | Pa | force over the real contact area | page facts | mean pressure in contact
    depth | m | approach of the bodies since first touch | patch page facts
    stiffness | N m-1 | normal stiffness dF/dd of the contact region held fixed | patch page facts
    interfacial_stiffness | N m-1 | normal stiffness against the mean gap, contact region held fixed | page facts
    contact_area | m2 | real contact area | patch page facts
    contact_fraction | 1 | relative real contact area, real over nominal | joint page facts | \
        relative real contact area A/A0
    interfacial_stiffness_per_area | Pa m-1 | interfacial stiffness over the nominal area | joint page facts | \
        interfacial stiffness per area K/A0
    spots | 1 | number of connected contact spots | patch joint page facts | contact spots | d
    mean_gap | m | gap averaged over the measured cells | patch joint page facts
    elastic_energy | J | elastic energy of the bodies | page facts
""")
"""Columns of a loaded state, and of a curve at each load."""
CERTIFICATES = columns("""
    residual | 1 | violation of the contact conditions, recomputed on the answer | patch joint page | | .1e
    stiffness_residual | 1 | residual of the linear problem of the stiffness
""")
STATUS = Column("status", "", "how the solver ended")
MODULUS = Column("modulus", "Pa", "reduced modulus E* of the pair of solids", "facts", "reduced modulus E*")
RMS = Column("rms", "m", "root mean square height about the mean", "", "rms height")
HARDNESS = Column("hardness", "Pa", "pressure that no cell exceeds")
SCALES = (
    MODULUS,
    RMS,
    *columns("""
        full_contact_stiffness | N m-1 | stiffness with every measured cell in contact | | full-contact stiffness
        cell_stiffness | N m-1 | stiffness with one cell in contact | | one cell
        nominal_area | m2 | area of all cells
    """),
)
"""Scales of a curve."""
SIZES = columns("""
    lengths | m | side lengths of the map, cells times spacing | | length
    spacing | m | size of a cell
    periodic | | whether the surface repeats itself
""")
SHAPE = Column("shape", "1", "number of cells", "", "cells")

FLOW = columns("""
    plastic_area | m2 | area of the cells whose pressure is the hardness
    flow_volume | m3 | volume that has flowed | | volume of flow
    flow_energy | J | work that first loading spent on flow | | energy of flow
    unloading_stiffness | N m-1 | normal stiffness dF/dd as the load is reduced, contact region held fixed
    unloading_interfacial_stiffness | N m-1 | \
        normal stiffness against the mean gap as the load is reduced, contact region held fixed
""")
"""Further columns of a state and of a curve where a hardness limits the pressure."""
FLOW_DEPTH = Column("flow_depth", "m", "depth by which the surface has flowed", "", "depth of flow")
FLOW_RISE = Column("flow_rise", "m", "rise of the whole surface by what has flowed", "", "rise")

CURVE: Table = {
    ("load",): (
        *POINTS,
        *columns("""
            dimensionless_force | 1 | force over modulus, length and rms height | | force / (E* L h)
            dimensionless_stiffness | 1 | stiffness over modulus and length | | stiffness / (E* L)
        """),
        *CERTIFICATES,
        Column("resolved", "", "contact stands above twenty cells and below the full-contact stiffness"),
        STATUS,
    ),
    ("interval",): (
        Column(
            "secant_stiffness",
            "N m-1",
            "difference of force over difference of depth between one load and the next",
        ),
    ),
    (): SCALES,
    ("axis",): SIZES,
}

HEIGHTS = Column("heights", "m", "height of the surface, positive toward the other body", "", "height")
CONTACT = Column("contact", "", "whether the cell is in contact")
PRESSURE = Column("pressure", "Pa", "contact pressure")
STEPS = Column("steps", "1", "steps of the solver")
MAPS = (
    PRESSURE,
    *columns("""
        displacement | m | normal displacement of the half-space
        gap | m | gap between the bodies
    """),
    CONTACT,
)
SPOT_LABEL = Column(
    "spot_label", "1", "number of the contact spot a cell belongs to, 0 outside contact", "", "spot"
)
SPOTS: Table = {
    ("spot",): columns("""
        spot_area | m2 | area of a contact spot
        spot_load | N | force carried by a contact spot
    """)
}
STATE: Table = {
    (): (
        MODULUS,
        *POINTS,
        SCALES[-1],
        *CERTIFICATES,
        STATUS,
        STEPS,
        *columns("""
            missing | 1 | number of cells without a height; they never touch | | missing cells
            touches_edge | | contact reaches the edge of the map | | contact at the edge
        """),
    ),
    ("axis",): SIZES,
}

STATE_NAMES = MappingProxyType(
    {
        "spots": "spot_count",
        "modulus": "problem.modulus",
        **{name: f"problem.grid.{name}" for name in ("lengths", "spacing", "periodic")},
    }
)
"""Attributes of a state whose name differs from that of the column."""

LOOP: Table = {
    (CELLS,): (
        HEIGHTS,
        Column("flattened_heights", "m", "height of the surface after flow, positive toward the other body"),
        FLOW_DEPTH,
    ),
    (): (
        *columns("""
            residual_depth | m | approach at which the flattened surface is touched without force
            residual_gap | m | mean gap of the flattened surface that is touched without force
            work | J | work of first loading up to the largest load
            dissipated_work | J | work of loading that unloading does not give back
        """),
        FLOW_RISE,
    ),
}
UNLOADED = tuple(
    replace(
        column,
        name=f"unloaded_{column.name}",
        long_name=f"{column.long_name}, on unloading",
        shown=column.shown if "stiffness" in column.name else "",
        label=f"{column.label} on unloading",
    )
    for column in POINTS
    if column.name not in ("force", "nominal_pressure")
)
"""Columns of unloading, interpolated at the loads of first loading, in tables with a row for each of these loads."""
BRANCH = Column("branch", "", "branch of the loop: first loading, unloading or reloading")

_OF_POINTS = {column.name: column for column in POINTS}
INTERFACE: Table = {
    ("load",): (
        _OF_POINTS["nominal_pressure"],
        _OF_POINTS["mean_gap"],
        Column("overclosure", "m", "closing of the mean gap from where the pressure of the table begins"),
        _OF_POINTS["interfacial_stiffness_per_area"],
        _OF_POINTS["contact_fraction"],
    ),
    (): (Column("zero_gap", "m", "mean gap at which the pressure of the table begins"),),
}
TANGENTIAL = Column(
    "tangential_stiffness_per_area",
    "Pa m-1",
    "tangential stiffness over the nominal area while nothing slips",
    label="tangential stiffness per area K_t/A0",
)

CONDUCTION = columns("""
    electrical_conductance | S | electrical conductance of the contact
    electrical_resistance | ohm | electrical resistance of the contact
    thermal_conductance | W K-1 | thermal conductance of the contact
    thermal_resistance | K W-1 | thermal resistance of the contact
""")
CONDUCTION_PER_AREA = columns("""
    electrical_conductance_per_area | S m-2 | electrical conductance over the nominal area | page
    electrical_resistance_per_area | m2 ohm | electrical resistance times the nominal area
    thermal_conductance_per_area | W m-2 K-1 | thermal conductance over the nominal area | page | \
        thermal conductance per area h_c
    thermal_resistance_per_area | m2 K W-1 | thermal resistance times the nominal area
""")
REFLECTION = columns("""
    reflecting_stiffness_per_area | Pa m-1 | \
        interfacial stiffness per area of a small oscillation, under a hardness that of unloading | joint | \
        K/A0 on unloading
    reflection | 1 | size of the reflection of a normal longitudinal wave | joint patch page
    transmission | 1 | displacement of the transmitted wave over that of the incident wave | page
    error_amplification | 1 | relative error of an inferred K/A0 over that of the reflection | joint patch page
    best_frequency | Hz | frequency at which an error of the reflection changes K/A0 least | joint patch page
    wavelength_over_spot_distance | 1 | shorter wavelength of both bodies over the mean distance of the spots
    measurable | | whether the relative error of an inferred K/A0 is at most 20 times that of the reflection | \
        joint patch | K/A0 measurable
""")
ERRORS = columns("""
    corrected_contact_area | m2 | real contact area, corrected for the perimeter of its cells | | \
        contact area, corrected
    corrected_contact_fraction | 1 | relative real contact area, corrected for the perimeter of its cells | | \
        A/A0, corrected
""")
"""Quantities that are quoted with an error, in addition to the columns of a state."""
PLACES = columns("""
    x | m | position along the rows of the picture, centre of the cell
    y | m | position down the picture from its top, centre of the cell
    r | m | distance from the axis, mean radius of the ring
""")
