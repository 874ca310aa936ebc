"""Notes on the flow through a gap, and on a leak."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from roughcontact.contact.curve import Curve
from roughcontact.fluid.constriction import Constriction, is_resolved
from roughcontact.fluid.fluids import Liquid
from roughcontact.fluid.gap_flow import TOLERANCE, GapFlow
from roughcontact.fluid.leak import Leak
from roughcontact.labels.engineering_units import written
from roughcontact.labels.note import Note, Rank

__all__ = ["notes_on_flow", "notes_on_flow_curve", "notes_on_leak"]

SMALL_DROP = 0.1  # of the nominal pressure, up to which the fluid barely opens the joint


def notes_on_flow(flow: GapFlow) -> Iterator[Note]:
    """Yield the notes on a flow."""
    yield from _flow(flow)
    yield from _constriction(flow.constriction)


def _flow(flow: GapFlow) -> Iterator[Note]:
    if not flow.percolates:
        yield Note(
            Rank.LIMITED,
            "No open path leads through the gap: nothing flows except through gaps that the cells do not resolve.",
        )
        return
    if not flow.residual <= flow.tolerance:
        yield Note(
            Rank.WRONG,
            f"The bounds of the flow differ by {flow.residual:.1e}, where {flow.tolerance:.0e} was asked for.",
        )
    if len(flow.windings) == 1:
        vector = tuple(int(each) for each in flow.windings[0])
        yield Note(
            Rank.LIMITED,
            f"The open cells percolate along {vector} periods only: across it nothing flows.",
        )
    if flow.solution.missing:
        yield Note(
            Rank.LIMITED,
            f"{flow.solution.missing} cells hold no height: the flow lies between those with these cells closed and "
            "open.",
        )


def notes_on_leak(leak: Leak) -> Iterator[Note]:
    """Yield the notes on a leak, with those on its flow."""
    yield from _flow(leak.flow)
    yield from _constriction(leak.constriction)
    nominal = leak.flow.solution.nominal_pressure
    if leak.drop > SMALL_DROP * nominal:
        yield Note(
            Rank.DOUBTFUL,
            f"The drop is {leak.drop / nominal:.0%} of the nominal pressure: the fluid opens the joint, and more "
            "leaks than computed.",
        )
    if isinstance(leak.fluid, Liquid) and leak.downstream < leak.fluid.vapour_pressure:
        yield Note(
            Rank.DOUBTFUL, "The pressure falls below the vapour pressure: the liquid boils in the gap."
        )
    if leak.reynolds > 1:
        yield Note(
            Rank.DOUBTFUL,
            f"The reduced Reynolds number is {leak.reynolds:.2g} in the critical constriction: inertia counts, and "
            "less leaks than computed.",
        )


def notes_on_flow_curve(curve: Curve) -> Iterator[Note]:
    """Yield the notes on the flow along a curve; none if it was not measured."""
    if "transmissivity" not in curve.measured:
        return
    residual, percolates = curve.measured["flow_residual"], curve.measured["percolates"] > 0
    if missed := int(np.sum(~(residual <= TOLERANCE))):
        yield Note(
            Rank.WRONG,
            f"At {missed} of {len(curve)} loads the bounds of the flow differ by more than {TOLERANCE:.0e}, by up to "
            f"{np.max(residual):.1e}.",
        )
    if percolates.any():
        last = int(np.flatnonzero(percolates)[np.argmax(curve.force[percolates])])
        cells, share = (curve.measured[f"constriction_{name}"][last] for name in ("cells", "share"))
        load = written(float(curve.nominal_pressure[last]), "Pa")
        yield from _unresolved(int(cells), float(share), f"At {load}, the last load with an open path, the")


def _constriction(place: Constriction | None) -> Iterator[Note]:
    if place is not None:
        yield from _unresolved(place.cells, place.share)


def _unresolved(count: int, share: float, begin: str = "The") -> Iterator[Note]:
    if not is_resolved(count, share):
        cells = f"{count} cells" if count > 1 else "one cell"
        yield Note(
            Rank.DOUBTFUL,
            f"{begin} critical constriction is {cells} wide and takes {share:.0%} of the drop: there "
            "the flow depends on the grid. Use smaller cells, or quote the order of magnitude only.",
        )
