"""The tables of surfaces that stick: states and paths, jumps, and detachments of stuck surfaces."""

from __future__ import annotations

from dataclasses import replace

from roughcontact.labels.column import CELLS, Column, Table, columns
from roughcontact.labels.contact_columns import (
    CERTIFICATES,
    MAPS,
    MODULUS,
    POINTS,
    RMS,
    SCALES,
    SIZES,
    STATUS,
)

__all__ = [
    *("ADHESION", "ADHESIVE_CURVE", "ADHESIVE_STATE", "BRACKETS", "DETACHMENTS", "DETACHMENT_CURVE"),
    *("DETACHMENT_MAPS", "DETACHMENT_STATE", "JUMPS", "WORK_OF_ADHESION"),
]

_OF = {column.name: column for column in (*POINTS, *MAPS, *SCALES)}
FORCE = replace(_OF["force"], long_name="normal force, tension negative", shown="path")
DEPTH = replace(_OF["depth"], shown="path")
AREA = replace(_OF["contact_area"], long_name="area of the cells that the wall holds", shown="")
FRACTION = replace(_OF["contact_fraction"], shown="path")
STIFFNESS = replace(
    _OF["stiffness"],
    long_name="slope of the force with the depth along the branch, the attraction taking part",
    shown="path",
)
MEAN_GAP = replace(_OF["mean_gap"], shown="path")
RESIDUAL = replace(CERTIFICATES[0], shown="path")
ADHESIVE_ENERGY = Column("adhesive_energy", "J", "energy of the adhesion")
ENERGY = Column("energy", "J", "elastic and adhesive energy; its slope with the depth is the force")
CONTACT_STIFFNESS = Column(
    "contact_stiffness", "N m-1", "slope of the force with the depth, contact and attraction held fixed"
)
LOWEST_FORCE = Column(
    "lowest_force", "N", "lowest force since the body is drawn back, between the loads and in jumps"
)
LOWEST_FORCE_DEPTH = Column("lowest_force_depth", "m", "depth at the lowest force")
PULL_OFF = Column(
    "pull_off_force", "N", "largest tension of the retreat, positive, between the loads and in jumps"
)
LOST = Column("lost_energy", "J", "energy lost in all jumps", "", "energy lost")
MAX_TENSION = Column("max_tension", "Pa", "largest tension of a cell", "", "largest tension")
UNRESOLVED = Column("unresolved", "", "attraction varies from cell to cell: states are those of the lattice")
SUMMIT_RADIUS = Column(
    "summit_radius",
    "m",
    "radius of the paraboloid fitted to the highest summit, over the contact without load",
)
WORK_OF_ADHESION = Column(
    "work_of_adhesion", "J m-2", "work of adhesion, to part a unit area", "", "work of adhesion w"
)
ADHESION = columns("""
    adhesion_range | m | length over which the attraction falls | | range of the attraction
    allow_unresolved | | whether an attraction that varies from cell to cell was allowed
""")
"""Columns of a law in addition to its work of adhesion, which may be a map."""

_POINTS = (DEPTH, FORCE, AREA, FRACTION, STIFFNESS, CONTACT_STIFFNESS, MEAN_GAP)
_ENERGIES = (_OF["elastic_energy"], ADHESIVE_ENERGY, ENERGY)
ADHESIVE_CURVE: Table = {
    ("load",): (
        Column("branch", "", "branch of the path: approach or retreat", "path"),
        _OF["nominal_pressure"],
        *_POINTS,
        *_ENERGIES,
        LOWEST_FORCE,
        LOWEST_FORCE_DEPTH,
        RESIDUAL,
        STATUS,
    ),
    (): (
        PULL_OFF,
        Column(
            "jump_in_force",
            "N",
            "tension from which the body first jumped on the approach, positive; negative where it was pressed",
        ),
        LOST,
        UNRESOLVED,
        MODULUS,
        _OF["nominal_area"],
        RMS,
        SUMMIT_RADIUS,
    ),
    ("jump",): (Column("jumped", "1", "load, counted from 0, that the jump came on the way to"),),
    ("axis",): SIZES,
}
ADHESIVE_STATE: Table = {
    (CELLS,): (
        replace(_OF["pressure"], long_name="reaction of the wall less the attraction, tension negative"),
        *MAPS[1:3],
        replace(_OF["contact"], long_name="whether the wall holds the cell"),
        Column("attracted", "", "whether the cell is apart from the wall by no more than the range"),
    ),
    (): (
        MODULUS,
        _OF["nominal_area"],
        _OF["nominal_pressure"],
        _OF["max_pressure"],
        MAX_TENSION,
        *_POINTS,
        *_ENERGIES,
        *columns("""
            stability | 1 | smallest eigenvalue found of the Hessian over that without attraction, as it is controlled
            stability_residual | 1 | \
                residual of the eigenvector of the stability: some eigenvalue lies within it of the stability
        """),
        RESIDUAL,
        UNRESOLVED,
        SUMMIT_RADIUS,
        STATUS,
    ),
    ("axis",): SIZES,
}
JUMPS = columns("""
    jump_depth | m | last depth of the branch that ends
    jump_depth_after | m | depth after the jump
    jump_force_before | N | force before the jump
    jump_force_after | N | force after the jump
    jump_lost | J | energy lost in the jump
    jump_approach | | whether the depth or the force was growing
    jump_ambiguous | | whether two integrations of the flow after the jump end apart
""")
BRACKETS = {
    "depth": Column(
        "jump_depth_bracket", "m", "depth between the last state of the branch and the first beyond it"
    ),
    "force": Column(
        "jump_force_bracket", "N", "force between the last state of the branch and the first beyond it"
    ),
}
"""A further column of jumps, under given depths and under given forces."""

_PRELOAD = Column("preload_too_small", "", "whether a larger preload may raise the pull-off force")
_STUCK = (DEPTH, FORCE, AREA, FRACTION, STIFFNESS, MEAN_GAP, *_ENERGIES, LOWEST_FORCE)
DETACHMENT_CURVE: Table = {
    ("load",): (_OF["nominal_pressure"], *_STUCK, RESIDUAL, STATUS),
    ("detachment",): (
        Column("detached_at", "1", "load, counted from 0, that the detachment came on the way to"),
    ),
    (): (MODULUS, _OF["nominal_area"], RMS, _PRELOAD, PULL_OFF, LOST),
    ("axis",): SIZES,
}
DETACHMENT_MAPS = ADHESIVE_STATE[(CELLS,)][:4]
DETACHMENT_STATE: Table = {
    (): (
        MODULUS,
        _OF["nominal_area"],
        _OF["nominal_pressure"],
        _OF["max_pressure"],
        MAX_TENSION,
        *_STUCK,
        Column("lowest_force_area", "m2", "area in contact under the lowest force"),
        PULL_OFF,
        LOST,
        _PRELOAD,
        RESIDUAL,
        STATUS,
    ),
    ("axis",): SIZES,
}
DETACHMENTS = columns("""
    detachment_depth | m | depth at which cells let go
    detachment_depth_after | m | depth after cells let go
    detachment_force_before | N | force before cells let go
    detachment_force_after | N | force after cells let go
    detachment_cells | 1 | number of cells that let go
    detachment_lost | J | elastic energy set free less the work of adhesion
""")
