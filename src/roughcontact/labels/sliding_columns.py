"""The tables of steady sliding over a viscoelastic plane."""

from __future__ import annotations

from roughcontact.labels.column import CELLS, Table, columns
from roughcontact.labels.contact_columns import CERTIFICATES, HEIGHTS, MAPS, POINTS, STATUS

__all__ = ["FRICTION_CURVE", "SLIDING", "SLIDING_NAMES"]

SPEED, TRACTION, DIRECTION = columns("""
    sliding_speed | m s-1 | speed of the surface over the plane
    friction_traction | Pa | mean traction by which the surface drags the plane
    sliding_direction | 1 | unit vector along which the surface slides
""")
_NUMBERS = (
    *columns("""
        friction_coefficient | 1 | hysteretic friction along the direction over the nominal pressure
        friction_error | 1 | estimate of the error of the friction coefficient by the grid
        dissipation | W m-2 | power that the plane dissipates per nominal area
    """),
    *(each for each in POINTS if each.name in ("contact_fraction", "max_pressure", "mean_gap", "depth")),
    CERTIFICATES[0],
    *columns("solves | 1 | linear solves and symmetric contact problems"),
    STATUS,
)
_NOMINAL = tuple(each for each in POINTS if each.name == "nominal_pressure")
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
