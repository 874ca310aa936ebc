"""The table of a whole joint."""

from __future__ import annotations

from roughcontact.labels.column import CELLS, Table, columns
from roughcontact.labels.contact_columns import POINTS

__all__ = ["JOINT", "JOINT_LOSS", "JOINT_NAMES"]

_SHARED = {each.name: each for each in POINTS}

JOINT: Table = {
    (CELLS,): (_SHARED["nominal_pressure"], _SHARED["interfacial_stiffness_per_area"]),
    ("component",): columns(
        "centre_of_stiffness | m | place where a force closes the interface evenly | | centre of stiffness (x, y)"
    ),
    ("component", "direction"): columns(
        "tilting_stiffness | N m rad-1 | moment about the centre of stiffness over the slope of the closing"
    ),
    (): (
        _SHARED["force"],
        *columns("""
            face_area | m2 | area of the face, open cells included
            loaded_area | m2 | area of the face whose pressure lies within the law | | area in contact
            left_out_area | m2 | area of the face without pressure or below the law | | area left out
            left_out_force | N | normal force on the area that is left out | | force left out
            normal_stiffness | N m-1 | normal force over the closing of the interface
            shear_stiffness | N m-1 | tangential force over displacement while nothing slips
            torsional_stiffness | N m rad-1 | torque about the centre of stiffness over angle while nothing slips
            gross_slip_force | N | tangential force at which the whole joint slides | | force of gross slip
            longest_wave | m | length of the longest waves of the roughness
            steep_share | 1 | part of the area in contact where the pressure changes by its own value over three \
                longest waves | | area where the pressure is steep
        """),
    ),
}
"""Columns of a joint; those of shear are NaN without friction."""
JOINT_LOSS = columns("joint_loss | J | energy that friction dissipates in a cycle | | loss per cycle")
JOINT_NAMES = {
    "force": "field.force",
    "nominal_pressure": "field.pressure",
    "interfacial_stiffness_per_area": "stiffness_per_area",
    "face_area": "field.face_area",
    "centre_of_stiffness": "centre",
    "tilting_stiffness": "tilting",
}
"""Attributes of a `Joint`, by columns."""
