"""The tables of a loaded state, a loading curve, a loop, the law of an interface, and of what a contact conducts.

A new column is one line here. Files, records, tables on a screen and on the page, and the labels of pictures follow.
"""

from __future__ import annotations

from types import MappingProxyType

from roughcontact.labels.column import CELLS, Column, Table

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
    *("HARDNESS", "HEIGHTS", "INTERFACE", "LOOP", "MAPS", "POINTS", "RMS", "SCALES", "SIZES", "SPOTS"),
    *("SPOT_LABEL", "STATE", "STATE_NAMES", "STATUS"),
]

POINTS = (
    Column("force", "N", "normal force", shown="patch page facts"),
    Column("nominal_pressure", "Pa", "force over the nominal area", shown="joint page facts"),
    Column("depth", "m", "approach of the bodies since first touch", shown="patch page facts"),
    Column(
        "stiffness",
        "N m-1",
        "normal stiffness dF/dd of the contact region held fixed",
        shown="patch page facts",
    ),
    Column(
        "interfacial_stiffness",
        "N m-1",
        "normal stiffness against the mean gap, contact region held fixed",
        shown="page facts",
    ),
    Column("contact_area", "m2", "real contact area", shown="patch page facts"),
    Column(
        "contact_fraction",
        "1",
        "relative real contact area, real over nominal",
        "relative real contact area A/A0",
        shown="joint page facts",
    ),
    Column(
        "interfacial_stiffness_per_area",
        "Pa m-1",
        "interfacial stiffness over the nominal area",
        "interfacial stiffness per area K/A0",
        shown="joint page",
    ),
    Column(
        "spots",
        "1",
        "number of connected contact spots",
        "contact spots",
        shown="patch joint page facts",
        digits="d",
    ),
    Column("mean_gap", "m", "gap averaged over the measured cells", shown="patch joint page facts"),
    Column("elastic_energy", "J", "elastic energy of the bodies", shown="page facts"),
)
"""What a loaded state has, and a curve at each load."""
CERTIFICATES = (
    Column(
        "residual",
        "1",
        "violation of the contact conditions, recomputed on the answer",
        shown="patch joint page",
        digits=".1e",
    ),
    Column("stiffness_residual", "1", "residual of the linear problem of the stiffness"),
)
STATUS = Column("status", "", "how the solver ended")
MODULUS = Column(
    "modulus", "Pa", "reduced modulus E* of the pair of solids", "reduced modulus E*", shown="facts"
)
RMS = Column("rms", "m", "root mean square height about the mean", "rms height")
HARDNESS = Column("hardness", "Pa", "pressure that no cell exceeds")
SCALES = (
    MODULUS,
    RMS,
    Column(
        "full_contact_stiffness",
        "N m-1",
        "stiffness with every measured cell in contact",
        "full-contact stiffness",
    ),
    Column("cell_stiffness", "N m-1", "stiffness with one cell in contact", "one cell"),
    Column("nominal_area", "m2", "area of all cells"),
)
"""What a curve is measured by."""
SIZES = (
    Column("lengths", "m", "side lengths of the map, cells times spacing", "length"),
    Column("spacing", "m", "size of a cell"),
    Column("periodic", "", "whether the surface repeats itself"),
)
SHAPE = Column("shape", "1", "number of cells", "cells")

FLOW = (
    Column("plastic_area", "m2", "area of the cells whose pressure is the hardness"),
    Column("flow_volume", "m3", "volume that has flowed", "volume of flow"),
    Column("flow_energy", "J", "work that first loading spent on flow", "energy of flow"),
    Column(
        "unloading_stiffness",
        "N m-1",
        "normal stiffness dF/dd as the load is reduced, contact region held fixed",
    ),
    Column(
        "unloading_interfacial_stiffness",
        "N m-1",
        "normal stiffness against the mean gap as the load is reduced, contact region held fixed",
    ),
)
"""What a state and a curve have besides where a hardness limits the pressure."""
FLOW_DEPTH = Column("flow_depth", "m", "depth by which the surface has flowed", "depth of flow")
FLOW_RISE = Column("flow_rise", "m", "rise of the whole surface by what has flowed", "rise")

CURVE: Table = {
    ("load",): (
        *POINTS,
        Column("dimensionless_force", "1", "force over modulus, length and rms height", "force / (E* L h)"),
        Column("dimensionless_stiffness", "1", "stiffness over modulus and length", "stiffness / (E* L)"),
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

HEIGHTS = Column("heights", "m", "height of the surface, positive toward the other body", "height")
CONTACT = Column("contact", "", "whether the cell is in contact")
PRESSURE = Column("pressure", "Pa", "contact pressure")
STEPS = Column("steps", "1", "steps of the solver")
LARGEST_PRESSURE = Column("largest_pressure", "Pa", "largest contact pressure of a cell", shown="facts")
MAPS = (
    PRESSURE,
    Column("displacement", "m", "normal displacement of the half-space"),
    Column("gap", "m", "gap between the bodies"),
    CONTACT,
)
SPOT_LABEL = Column(
    "spot_label", "1", "number of the contact spot a cell belongs to, 0 outside contact", "spot"
)
SPOTS: Table = {
    ("spot",): (
        Column("spot_area", "m2", "area of a contact spot"),
        Column("spot_load", "N", "force carried by a contact spot"),
    )
}
STATE: Table = {
    (): (
        MODULUS,
        *POINTS[:2],
        LARGEST_PRESSURE,
        *POINTS[2:],
        *CERTIFICATES,
        STATUS,
        STEPS,
        Column("missing", "1", "number of cells without a height; they never touch", "missing cells"),
        Column("touches_edge", "", "contact reaches the edge of the map", "contact at the edge"),
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
"""Attributes of a state that have not the name of their column."""

LOOP: Table = {
    (CELLS,): (
        HEIGHTS,
        Column("flattened_heights", "m", "height of the surface after flow, positive toward the other body"),
        FLOW_DEPTH,
    ),
    (): (
        Column("residual_depth", "m", "approach at which the flattened surface is touched without force"),
        Column("residual_gap", "m", "mean gap of the flattened surface that is touched without force"),
        Column("work", "J", "work of first loading up to the largest load"),
        Column("dissipated_work", "J", "work of loading that unloading does not give back"),
        FLOW_RISE,
    ),
}
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

CONDUCTION = (
    Column("electrical_conductance", "S", "electrical conductance of the contact"),
    Column("electrical_resistance", "ohm", "electrical resistance of the contact"),
    Column("thermal_conductance", "W K-1", "thermal conductance of the contact"),
    Column("thermal_resistance", "K W-1", "thermal resistance of the contact"),
)
CONDUCTION_PER_AREA = (
    Column(
        "electrical_conductance_per_area",
        "S m-2",
        "electrical conductance over the nominal area",
        shown="page",
    ),
    Column("electrical_resistance_per_area", "m2 ohm", "electrical resistance times the nominal area"),
    Column(
        "thermal_conductance_per_area",
        "W m-2 K-1",
        "thermal conductance over the nominal area",
        "thermal conductance per area h_c",
        shown="page",
    ),
    Column("thermal_resistance_per_area", "m2 K W-1", "thermal resistance times the nominal area"),
)
ERRORS = (
    Column(
        "corrected_contact_area",
        "m2",
        "real contact area, corrected for the perimeter of its cells",
        "contact area, corrected",
    ),
    Column(
        "corrected_contact_fraction",
        "1",
        "relative real contact area, corrected for the perimeter of its cells",
        "A/A0, corrected",
    ),
)
"""What is quoted with its error besides the columns of a state."""
PLACES = (
    Column("x", "m", "position along the rows of the picture, centre of the cell"),
    Column("y", "m", "position down the picture from its top, centre of the cell"),
    Column("r", "m", "distance from the axis, mean radius of the ring"),
)
