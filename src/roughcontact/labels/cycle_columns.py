"""The table of a cycle of shear that is computed by partial slip, and of the law from the normal curve beside it."""

from __future__ import annotations

from types import MappingProxyType

from roughcontact.labels.column import CELLS, Table, columns
from roughcontact.labels.contact_columns import CERTIFICATES, POINTS, STATUS, TANGENTIAL

__all__ = ["CYCLE", "CYCLE_NAMES", "ESTIMATE"]

CYCLE: Table = {
    ("loop",): columns("""
        loop_displacement | m | tangential displacement of the surfaces in the cycle | | tangential displacement
        loop_traction | Pa | nominal tangential traction in the cycle | | nominal tangential traction
        bodies_displacement | m | tangential displacement of the bodies in the cycle
    """),
    ("first",): columns("""
        first_displacement | m | tangential displacement of the surfaces during first loading
        first_traction | Pa | nominal tangential traction during first loading
    """),
    (CELLS,): columns("heat | J m-2 | energy that friction dissipates in the cycle, per area of the cell"),
    (): (
        *(column for column in POINTS if column.name == "nominal_pressure"),
        TANGENTIAL,
        *columns("""
            stiffness_ratio | 1 | normal over tangential interfacial stiffness | | K/K_t
            cycle_loss | J m-2 | energy that friction dissipates in a cycle, over the nominal area \
                | | loss per cycle
            damping | 1 | equivalent damping ratio of only the interface
            slip_fraction | 1 | part of the contact that slips at the reversal | | slipping part
            stick_fraction | 1 | part of the contact that sticks at the reversal
            closure | 1 | distance between the ends of the loop over its amplitude
            balance | 1 | imbalance of energy over the loss
        """),
        CERTIFICATES[0],
        STATUS,
    ),
}
ESTIMATE: Table = {
    ("estimate",): columns("""
        estimated_displacement | m | tangential displacement in the cycle, from the normal curve
        estimated_traction | Pa | nominal tangential traction in the cycle, from the normal curve
    """),
    (): columns("""
        estimated_loss | J m-2 | energy that friction dissipates in a cycle, from the normal curve
        estimated_damping | 1 | equivalent damping ratio of only the interface, from the normal curve
    """),
}
CYCLE_NAMES = MappingProxyType(
    {
        "loop_displacement": "loop.displacement",
        "loop_traction": "loop.traction",
        "cycle_loss": "loop.loss",
        "damping": "loop.damping",
        "nominal_pressure": "pressure",
        **{
            f"estimated_{name}": f"estimate.{name}"
            for name in ("displacement", "traction", "loss", "damping")
        },
    }
)
"""Attributes of a `SlipCycle` whose name differs from that of the column."""
