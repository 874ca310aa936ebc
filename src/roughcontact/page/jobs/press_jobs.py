"""What a page shows of a load: maps at once, then the numbers; and cuts through them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.labels.labelled import plain_values
from roughcontact.page.jobs.curve_point import point_of
from roughcontact.page.jobs.session_cache import SessionCache
from roughcontact.page.server.page_request import PageRequest, Send, send_map
from roughcontact.recipe.elastic_jobs import PressJob

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution

__all__ = ["cut", "press"]


def press(request: PageRequest, cache: SessionCache, send: Send) -> None:
    """Send the maps of pressure and gap, then numbers, notes and the distribution of the pressure."""
    import numpy as np

    from roughcontact.plot.facts import solution_facts

    send({"type": "span", **cache.span(request.job)})
    if not isinstance(request.job, PressJob):  # the page does not know yet which loads suit the surface
        return
    solution = cache.solution(request.job)
    grid = solution.problem.grid
    most = request.whole("pixels", 1024, 4096)
    place: dict[str, Any] = {"lengths": grid.lengths, "periodic": list(grid.periodic)}
    send_map(send, "pressure", solution.pressure, most, unit="Pa", **place)
    send_map(send, "gap", solution.gap, most, lowest=True, unit="m", **place)
    highest = np.unravel_index(int(solution.pressure.argmax()), grid.shape)
    send(
        {
            "type": "state",
            "force": solution.force,
            "pressure": solution.nominal_pressure,
            "depth": solution.depth,
            "highest": [int(index) for index in highest],
            "warning": _warning(solution),
        }
    )
    send(
        {
            "type": "numbers",
            "facts": solution_facts(solution),
            "point": point_of(solution),
            "notes": solution.notes,
            **request.statement,
        }
    )
    if solution.contact.any():
        density, edges = solution.pressure_histogram(60)
        centres = (edges[1:] + edges[:-1]) / 2
        send({"type": "pressures", "x": centres.tolist(), "y": density.tolist()})


def cut(request: PageRequest, cache: SessionCache, send: Send) -> None:
    """Send one row or column: the surface before the load and under it, and the pressure."""
    import numpy as np

    solution = cache.solution(request.job)
    problem, along_row = solution.problem, request.more.get("axis") != "column"
    count = problem.grid.shape[0 if along_row else 1]
    at = min(request.whole("place", 1, count), count) - 1
    line = (at, slice(None)) if along_row else (slice(None), at)
    gap = solution.gap[line]
    send(
        {
            "type": "cut",
            "axis": "row" if along_row else "column",
            "place": at,
            "count": count,
            "x": problem.grid.coordinates[1 if along_row else 0].tolist(),
            "across": float(problem.grid.coordinates[0 if along_row else 1][at]),
            # The flat lies at 0, in both.
            "before": plain_values(
                np.where(problem.measured[line], solution.depth - problem.separation[line], np.nan)
            ),
            "under": plain_values(-gap),
            "gap": plain_values(gap),
            "pressure": plain_values(solution.pressure[line]),
        }
    )


def _warning(solution: Solution) -> str:
    """Return in one sentence what to do about a load whose numbers are not to be relied upon; else nothing."""
    if not solution.status.converged:
        return "The solver has missed its tolerance: take another load, or filter the shortest waves."
    if solution.contact.any() and not solution.resolved_from_below:
        return (
            "So few cells bear this load that the grid sets the stiffness: take a larger load or a finer map."
        )
    return ""
