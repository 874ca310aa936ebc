"""A loaded state on a page: maps at once, then numbers, and cuts through the maps."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughcontact.labels.labelled import plain_values
from roughcontact.labels.variables import unit_of
from roughcontact.page.jobs.curve_point import point_of
from roughcontact.page.jobs.session_cache import SessionCache
from roughcontact.page.refusal import on_the_page
from roughcontact.page.server.page_request import PageRequest, Send, send_map
from roughcontact.recipe.contact import Contact
from roughcontact.recipe.elastic_jobs import PressJob
from roughcontact.recipe.prescribed_loads import kinds_of

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution

__all__ = ["cut", "press"]


def press(request: PageRequest, cache: SessionCache, send: Send) -> None:
    """Send the maps of pressure and gap, then numbers, notes and the distribution of the pressure."""
    from roughcontact.labels.engineering_units import pretty, written
    from roughcontact.plot.facts import solution_facts
    from roughcontact.plot.pressure_bars import pressure_bars

    profile = getattr(request.job, "contact", Contact()).profile
    units = {name: kind.unit for name, kind in kinds_of(profile).items()}
    send({"type": "span", "units": units, **cache.span(request.job)})
    if not isinstance(request.job, PressJob):  # the page has no loads yet that suit the surface
        return
    solution = cache.solution(request.job)
    problem = solution.problem
    grid, unit = problem.grid, pretty(unit_of("pressure", problem.geometry))
    most = request.whole("pixels", 1024, 4096)
    send_map(send, "pressure", solution.pressure, grid, most, unit)
    send_map(send, "gap", solution.gap, grid, most, "m", lowest=True)
    highest = divmod(int(solution.pressure.argmax()), grid.shape[-1])
    send(
        {
            "type": "state",
            "force": solution.force,
            "pressure": solution.nominal_pressure,
            "depth": solution.depth,
            "highest": highest,
            "warning": _warning(solution),
        }
    )
    send(
        {
            "type": "numbers",
            "facts": solution_facts(solution),
            "point": point_of(solution),
            "notes": [on_the_page(note) for note in solution.notes],
            **request.statement,
        }
    )
    if solution.contact.any():
        bars = pressure_bars(solution)
        part = f"{100 * bars.beyond:.2g} % of the contact area, up to {written(bars.largest, unit)}"
        send(
            {
                "type": "pressures",
                "x": ((bars.edges[1:] + bars.edges[:-1]) / 2).tolist(),
                "y": bars.density.tolist(),
                "unit": unit,
                "beyond": f"Beyond the axis: {part}." if bars.beyond else "",
            }
        )


def cut(request: PageRequest, cache: SessionCache, send: Send) -> None:
    """Send one row or column: the surface before the load and under it, and the pressure."""
    import numpy as np

    from roughcontact.labels.engineering_units import pretty

    solution = cache.solution(request.job)
    problem = solution.problem
    *across, x = problem.grid.coordinates
    along_row = not across or request.more.get("axis") != "column"
    if not along_row:
        [x], across = across, [x]
    count = across[0].size if across else 1
    at = min(request.whole("place", 1, count), count) - 1
    line = () if not across else (at, slice(None)) if along_row else (slice(None), at)
    gap = solution.gap[line]
    send(
        {
            "type": "cut",
            "axis": "row" if along_row else "column",
            "place": at,
            "count": count,
            "x": x.tolist(),
            "across": float(across[0][at]) if across else None,
            # The flat is at height 0 in both lines.
            "before": plain_values(
                np.where(problem.measured[line], solution.depth - problem.separation[line], np.nan)
            ),
            "under": plain_values(-gap),
            "gap": plain_values(gap),
            "pressure": plain_values(solution.pressure[line]),
            "unit": pretty(unit_of("pressure", problem.geometry)),
        }
    )


def _warning(solution: Solution) -> str:
    """Return one sentence with a remedy if the numbers of a load are not reliable; otherwise an empty text."""
    if not solution.status.converged:
        return "The solver missed its tolerance: take another load, or filter the shortest waves."
    if solution.contact.any() and not solution.resolved_from_below:
        return "Too few cells carry this load, so the stiffness depends on the grid: take a larger load or a finer map."
    return ""
