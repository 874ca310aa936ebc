"""The numbers of a leak, line by line and in suitable units."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from roughcontact.labels.engineering_units import written
from roughcontact.labels.flow_columns import UNITS
from roughcontact.plot.facts import quantity, size_of

if TYPE_CHECKING:
    from roughcontact.fluid.gap_flow import GapFlow
    from roughcontact.fluid.leak import Leak

__all__ = ["leak_facts", "rate_words"]


def leak_facts(leak: Leak) -> list[tuple[str, str]]:
    """Return the contact, the flow and the leak rate, line by line."""
    flow, solution = leak.flow, leak.flow.solution
    problem, met = solution.problem, "met" if solution.status.converged else "MISSED"
    facts = [
        ("surface", size_of(problem.grid)),
        ("nominal pressure", quantity("nominal_pressure", solution.nominal_pressure)),
        ("relative real contact area A/A0", f"{solution.contact_fraction:.4g}"),
        ("mean gap", quantity("mean_gap", solution.mean_gap)),
        ("certificate of the contact", f"{solution.residual:.1e} (tolerance {problem.tolerance:.0e}: {met})"),
        ("an open path leads", _path(flow)),
    ]
    if flow.percolates:
        facts += _flow_facts(leak)
    facts.append(("leak rate", rate_words(leak)))
    if flow.percolates and math.isfinite(leak.reynolds):
        facts.append(("Reynolds number of the film", f"{leak.reynolds:.2g}"))
    if math.isfinite(leak.rarefaction):
        facts.append(("rarefaction parameter", f"{leak.rarefaction:.3g} in the critical constriction"))
    return facts


def rate_words(leak: Leak) -> str:
    """Return the leak rate in the units in use: volume, throughput of a gas, mass."""
    values = {"leak_rate": leak.volume, "throughput": leak.throughput, "mass_rate": leak.mass}
    gas = math.isfinite(leak.throughput)
    shown = ("throughput", "mass_rate", "leak_rate") if gas else ("leak_rate", "mass_rate")
    words = [
        f"{values[name] * unit.factor:.4g} {unit.unit}"
        for name in shown
        if math.isfinite(values[name])
        for unit in (UNITS[name][:1] if gas and name == "leak_rate" else UNITS[name])
    ]
    return ", ".join(words) + (" at the mean pressure" if gas else "")


def _path(flow: GapFlow) -> str:
    if not flow.percolates:
        return "nowhere: the open cells do not percolate"
    if flow.axis is not None:
        return f"from side to side, along {'yx'[flow.axis]}"
    if len(flow.windings) == 1:
        y, x = (int(each) for each in flow.windings[0])
        return f"along one direction: {y} periods along y and {x} along x"
    return "in all directions"


def _flow_facts(leak: Leak) -> list[tuple[str, str]]:
    flow = leak.flow
    values = [f"{value:.4g}" for value in flow.eigenvalues]
    along = f"{flow.transmissivity[leak.direction, leak.direction]:.4g} m³"
    more = (
        f" along {'yx'[leak.direction]}, principal values {values[0]} and {values[1]} m³"
        if len(values) > 1
        else ""
    )
    facts = [
        ("transmissivity", along + more),
        ("certificate of the flow", f"{flow.residual:.1e} (bounds; tolerance {flow.tolerance:.0e})"),
        ("hydraulic gap", quantity("hydraulic_gap", flow.hydraulic_gap)),
    ]
    if (place := leak.constriction) is not None:
        y, x = (written(each, "m", 4) for each in place.place)
        facts.append(
            (
                "critical constriction",
                f"at x = {x}, y = {y}: {place.cells} open cells across, width {written(place.width, 'm')}, gap "
                f"{written(place.gap, 'm')}, {place.share:.0%} of the dissipation",
            )
        )
    return facts
