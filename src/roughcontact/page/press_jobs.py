"""What a page shows of a load: maps at once, then the numbers; and cuts through them."""

from __future__ import annotations

from typing import Any

from roughcontact.labels.labelled import plain_values
from roughcontact.page.order import Order, Send, send_map
from roughcontact.page.statement import stated
from roughcontact.page.workbench import Workbench

__all__ = ["cut", "press"]


def press(order: Order, bench: Workbench, send: Send) -> None:
    """Send the maps of pressure and gap, then numbers, notes and the distribution of the pressure."""
    from roughcontact.contact.dataset import solution_record
    from roughcontact.plot.facts import solution_facts

    span = bench.span(order.recipe, order.files)
    send({"type": "span", **span})
    if order.recipe.load is None:  # the page does not know yet which loads suit the surface
        return
    send({"type": "doing", "words": "Pressing"})
    solution = bench.solution(order.recipe, order.files)
    grid = solution.problem.grid
    most = order.whole("pixels", 1024, 4096)
    place: dict[str, Any] = {"lengths": grid.lengths, "periodic": list(grid.periodic)}
    send_map(send, "pressure", solution.pressure, most, unit="Pa", **place)
    send_map(send, "gap", solution.gap, most, lowest=True, unit="m", **place)
    send(
        {
            "type": "state",
            "force": solution.force,
            "pressure": solution.force / grid.area,
            "depth": solution.depth,
            "fraction": solution.contact_fraction,
            "converged": solution.status.converged,
        }
    )
    statement = stated(order.recipe, order.file)
    send(
        {
            "type": "numbers",
            "facts": solution_facts(solution),
            "record": solution_record(solution),
            "notes": solution.notes,
            "command": statement.command,
            "python": statement.python,
        }
    )
    if solution.contact.any():
        density, edges = solution.pressure_histogram(60)
        centres = (edges[1:] + edges[:-1]) / 2
        send({"type": "pressures", "x": centres.tolist(), "y": density.tolist()})


def cut(order: Order, bench: Workbench, send: Send) -> None:
    """Send one row or column: the surface before the load and under it, and the pressure."""
    import numpy as np

    solution = bench.solution(order.recipe, order.files)
    problem, along_row = solution.problem, order.more.get("axis") != "column"
    count = problem.grid.shape[0 if along_row else 1]
    at = min(order.whole("place", 1, count), count) - 1
    line = (at, slice(None)) if along_row else (slice(None), at)
    step = problem.grid.spacing[1 if along_row else 0]
    gap = solution.gap[line]
    send(
        {
            "type": "cut",
            "axis": "row" if along_row else "column",
            "place": at,
            "x": [step * (k + 0.5) for k in range(len(gap))],
            # The flat lies at 0, in both.
            "before": plain_values(
                np.where(problem.measured[line], solution.depth - problem.separation[line], np.nan)
            ),
            "under": plain_values(-gap),
            "pressure": plain_values(solution.pressure[line]),
        }
    )
