"""The table of a viscoelastic contact in time."""

from __future__ import annotations

from roughcontact.labels.column import Column, Table, columns
from roughcontact.labels.contact_columns import CERTIFICATES, POINTS, STATUS

__all__ = ["TIME", "VISCOELASTIC_CURVE"]

TIME = Column("time", "s", "time since the start of the clock of the history")
_OF_POINTS = {column.name: column for column in POINTS}

VISCOELASTIC_CURVE: Table = {
    (TIME.name,): (
        TIME,
        *(
            _OF_POINTS[name]
            for name in ("force", "nominal_pressure", "depth", "mean_gap", "contact_area", "contact_fraction")
        ),
        _OF_POINTS["max_pressure"],
        _OF_POINTS["stiffness"],
        *columns("""
            relaxed_stiffness | N m-1 | normal stiffness dF/dd after a long time, contact region held fixed
            work | J | work of the load since the start
            stored_energy | J | energy of the springs of the material
            dissipated_energy | J | energy that the dashpots of the material have dissipated since the start
            energy_leak | J | work less stored and dissipated energy: an error of time
        """),
        CERTIFICATES[0],
        *columns("""
            time_residual | 1 | largest pressure of an open cell in the middle of the step, relative
            time_error | 1 | error of time so far, estimated by step doubling
            products | 1 | products with the operator
            prescribed | | whether the time is one of those that were given
        """),
        STATUS,
    ),
}
