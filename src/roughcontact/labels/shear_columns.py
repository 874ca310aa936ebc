"""The table of cycles of an interface under shear, per nominal area."""

from __future__ import annotations

from roughcontact.labels.column import columns
from roughcontact.labels.contact_columns import POINTS
from roughcontact.labels.cycle_columns import CYCLE
from roughcontact.labels.slip_columns import SLIP_STATE

__all__ = ["BY_SLIP", "SHEAR", "SHEAR_SCALES"]

_KNOWN = {column.name: column for column in (*POINTS, *CYCLE[()], *SLIP_STATE[()])}
SHEAR = (
    _KNOWN["nominal_pressure"],
    _KNOWN["interfacial_stiffness_per_area"],
    _KNOWN["tangential_stiffness_per_area"],
    *columns("""
        gross_slip | m | tangential displacement at which the whole contact begins to slide
        traction_share | 1 | amplitude of the tangential traction over mu p | | tau/(mu p)
        displacement_amplitude | m | amplitude of the tangential displacement of the surfaces
    """),
    _KNOWN["cycle_loss"],
    _KNOWN["damping"],
)
"""By the law from the normal curve."""
BY_SLIP = (
    *columns("""
        computed_stiffness | Pa m-1 | tangential stiffness per area by partial slip | | K_t/A0
        computed_displacement | m | displacement amplitude by partial slip | | displacement
        computed_loss | J m-2 | loss per cycle by partial slip | | loss per cycle
        stiffness_difference | 1 | stiffness by the law less that by partial slip, relative | | law: K_t/A0 | +.2%
        displacement_difference | 1 | the same of the displacement amplitude | | law: displacement | +.2%
        loss_difference | 1 | the same of the loss per cycle | | law: loss | +.2%
    """),
    _KNOWN["slip_fraction"],
)
"""Of cycles that are computed beside."""
SHEAR_SCALES = (
    _KNOWN["friction"],
    *columns("modulus_ratio | 1 | E* over G* of the pair of solids | | E*/G*"),
)
