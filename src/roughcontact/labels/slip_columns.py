"""The tables of a state and of a path under tangential loads."""

from __future__ import annotations

from roughcontact.labels.column import CELLS, Column, Table, columns
from roughcontact.labels.contact_columns import (
    CERTIFICATES,
    CONTACT,
    HEIGHTS,
    POINTS,
    PRESSURE,
    STATUS,
    STEPS,
)

__all__ = ["DIRECTION", "SLIP_CURVE", "SLIP_STATE"]

FORCE, DISPLACEMENT = columns("""
    tangential_force | N | tangential force that body 2 exerts upon body 1
    tangential_displacement | m | tangential displacement of body 2 against body 1 since the start
""")
AREAS = columns("""
    stick_area | m2 | area of the cells in contact that hold
    slip_area | m2 | area of the cells in contact that slip
    dissipated | J | energy that friction took in the step | | dissipated in a step
""")
ENERGY = Column("tangential_elastic_energy", "J", "elastic energy of the tangential displacement")
CAPACITY = Column("capacity", "N", "largest tangential force that friction holds")
DIRECTION = "direction"
"""The component of the displacement, beside that of the force."""

SLIP_CURVE: Table = {
    ("load", "component"): (FORCE, DISPLACEMENT),
    ("load",): (
        *AREAS,
        Column("dissipated_energy", "J", "energy that friction has taken since the start"),
        ENERGY,
        CERTIFICATES[0],
        STATUS,
    ),
    (): (CAPACITY,),
}
SLIP_STATE: Table = {
    ("component", CELLS): columns("""
        traction | Pa | tangential traction upon body 1
        slip | m | slip of surface 1 over surface 2 since the start
    """),
    (CELLS,): (
        HEIGHTS,
        PRESSURE,
        CONTACT,
        Column("slipping", "", "whether the cell bears all the traction that friction holds"),
    ),
    ("component",): (FORCE, DISPLACEMENT),
    ("component", DIRECTION): (
        Column(
            "tangential_stiffness",
            "N m-1",
            "tangential force per displacement of the cells that hold, moved as one",
        ),
    ),
    (): (
        POINTS[0],
        Column("friction", "1", "coefficient of friction", "", "friction coefficient"),
        CAPACITY,
        *AREAS,
        ENERGY,
        CERTIFICATES[0],
        STEPS,
        STATUS,
    ),
}
