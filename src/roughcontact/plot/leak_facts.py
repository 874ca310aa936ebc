"""The numbers of a leak, line by line and in suitable units."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.labels.column import shown_in
from roughcontact.labels.engineering_units import written
from roughcontact.labels.flow_columns import CONSTRICTION, GAP_FLOW, LEAK, PRESSED
from roughcontact.plot.facts import size_of

if TYPE_CHECKING:
    from roughcontact.fluid.leak import Leak

__all__ = ["leak_facts", "rate_words"]

_RATES = (
    *(("volume", 1.0, "m³/s"), ("volume", 6e7, "ml/min")),
    *(("throughput", 1.0, "Pa m³/s"), ("throughput", 10.0, "mbar l/s"), ("mass", 1e6, "mg/s")),
)
_COLUMNS = (
    *PRESSED,
    *(each for table in (GAP_FLOW, CONSTRICTION, {(): LEAK}) for of in table.values() for each in of),
)


def leak_facts(leak: Leak) -> list[tuple[str, str]]:
    """Return the contact, the flow and the leak rate, line by line; numbers that are not finite are left out."""
    record, solution, windings = leak.to_record(), leak.flow.solution, leak.flow.windings.tolist()
    path = f"along {' and '.join(map(str, windings))} periods (y, x)" if windings else "from side to side"
    met = "met" if solution.status.converged else "MISSED"
    numbers = [
        (column.label, ", ".join(written(each, column.unit, 4) for each in np.ravel(record[column.name])))
        for column in shown_in("facts", _COLUMNS)
        if record.get(column.name) is not None
    ]
    return [
        ("surface", size_of(solution.problem.grid)),
        ("certificate", f"{solution.residual:.1e} (tolerance {solution.problem.tolerance:.0e}: {met})"),
        ("an open path leads", path if leak.flow.percolates else "nowhere"),
        *numbers,
        ("leak rate", rate_words(leak)),
    ]


def rate_words(leak: Leak) -> str:
    """Return the leak rate in the units in use: volume, of a gas at the mean pressure, throughput of a gas, mass."""
    values = [(getattr(leak, name), factor, unit) for name, factor, unit in _RATES]
    return ", ".join(f"{value * factor:.4g} {unit}" for value, factor, unit in values if math.isfinite(value))
