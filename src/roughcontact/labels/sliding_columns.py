"""The tables of steady sliding over a viscoelastic plane."""

from __future__ import annotations

from roughcontact.labels.column import CELLS, Table, columns
from roughcontact.labels.contact_columns import CERTIFICATES, HEIGHTS, MAPS, POINTS, STATUS

__all__ = ["BY_PERSSON", "FRICTION_CURVE", "SLIDING", "SLIDING_NAMES"]

SPEED, TRACTION, DIRECTION = columns("""
    sliding_speed | m s-1 | speed of the surface over the plane
    friction_traction | Pa | mean traction by which the surface drags the plane
    sliding_direction | 1 | unit vector along which the surface slides
""")
_NUMBERS = (
    *columns("""
        friction_coefficient | 1 | hysteretic friction along the direction over the nominal pressure
        friction_across | 1 | hysteretic friction across the direction, to the left, over the nominal pressure
        friction_error | 1 | estimate of the error of the friction coefficient by the grid
        dissipation | W m-2 | power that the plane dissipates per nominal area
    """),
    *(each for each in POINTS if each.name in ("contact_fraction", "max_pressure", "mean_gap", "depth")),
    CERTIFICATES[0],
    *columns("solves | 1 | linear solves and symmetric contact problems"),
    STATUS,
)
_NOMINAL = tuple(each for each in POINTS if each.name == "nominal_pressure")
BY_PERSSON = columns("""
    persson_friction_coefficient | 1 | friction coefficient by Persson's theory, gamma 1 | | Persson, gamma 1
    persson_friction_coefficient_half | 1 | the same with gamma 1/2 | | Persson, gamma 1/2
    persson_contact_fraction | 1 | relative real contact area by Persson's theory | | Persson A/A0
""")
SLIDING: Table = {
    (): (SPEED, *_NUMBERS, *_NOMINAL),
    ("component",): (TRACTION, DIRECTION),
    (CELLS,): (HEIGHTS, *MAPS),
}
FRICTION_CURVE: Table = {
    ("sliding_speed",): _NUMBERS,
    ("sliding_speed", "component"): (TRACTION,),
    ("component",): (DIRECTION,),
    (): _NOMINAL,
}
SLIDING_NAMES = {
    "sliding_speed": "speed",
    "friction_traction": "friction",
    "sliding_direction": "direction",
    "heights": "problem.surface.heights",
}
"""Attributes of a `SlidingContact` and of a `FrictionCurve`, by columns."""
