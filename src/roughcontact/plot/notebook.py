"""How a notebook shows a value: a table of the most useful numbers beside a picture."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Sequence
from html import escape
from io import BytesIO

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughcontact.adhesion.adhesive_curve import AdhesiveCurve
from roughcontact.adhesion.adhesive_state import AdhesiveState
from roughcontact.adhesion.detachment_curve import DetachmentCurve
from roughcontact.adhesion.detachment_state import DetachmentState
from roughcontact.arrays import is_numpy
from roughcontact.contact.curve import Curve
from roughcontact.contact.dataset import curve_dataset
from roughcontact.contact.loop import Loop
from roughcontact.contact.solution import Solution
from roughcontact.plot.adhesive_facts import (
    ADHESIVE_COLUMNS,
    adhesive_curve_facts,
    adhesive_facts,
    law_facts,
)
from roughcontact.plot.answers import plot_curve, plot_loop, plot_solution, plot_state, plot_surface
from roughcontact.plot.detachment_plot import (
    DETACHMENT_COLUMNS,
    detachment_facts,
    detachment_force,
    detachment_state_facts,
)
from roughcontact.plot.facts import (
    AREAL_COLUMNS,
    CURVE_COLUMNS,
    load_table,
    loop_facts,
    quantity,
    solution_facts,
    surface_facts,
    surface_record,
)
from roughcontact.plot.jumps import jump_loop
from roughcontact.surface.surface import Surface

__all__ = [
    *("adhesive_curve_html", "curve_html", "detachment_html", "loop_html", "solution_html", "state_html"),
    "surface_html",
]

_SHOWN = 30  # loads that are shown of a longer curve: half of them from its begin, half from its end
_SIZE, _DPI = (4.6, 3.4), 96
_LEFT = "text-align:left"


def surface_html(surface: Surface) -> str | None:
    """Return size, missing points, heights and history of a surface beside its picture.

    Heights on another device stay there: the result is None, and the notebook shows ``repr``.
    """
    if not is_numpy(surface.heights):
        return None
    figure, axes = _figure()
    plot_surface(surface, axes)
    return _page("Surface", surface_facts(surface, surface_record(surface)), figure)


def solution_html(solution: Solution) -> str:
    """Return the numbers of one loaded state beside the pressure."""
    solution = solution.on_host()
    figure, axes = _figure()
    plot_solution(solution, axes)
    facts = [*solution_facts(solution), *_noted(solution.notes)]
    return _page("Solution", facts, figure)


def curve_html(curve: Curve) -> str:
    """Return a table of the loads beside the stiffness; per area against pressure where the map is periodic."""
    joint = all(curve.periodic)
    figure, axes = _figure()
    plot_curve(curve, axes, quantity="interfacial_stiffness_per_area" if joint else "stiffness")
    facts = [
        *_noted(curve.doubts, "doubtful"),
        *_noted([note for note in curve.notes if note not in curve.doubts]),
        ("loads", f"{len(curve)}, of which the grid resolves {int(curve.resolved.sum())}"),
        ("reduced modulus E*", quantity("modulus", curve.modulus)),
    ]
    table = _table(*load_table(curve_dataset(curve), AREAL_COLUMNS if joint else CURVE_COLUMNS))
    return _page("Curve", facts, figure) + table


def loop_html(loop: Loop) -> str:
    """Return the numbers of a loop of loads beside force against depth."""
    figure, axes = _figure()
    plot_loop(loop, axes)
    return _page("Loop", [*loop_facts(loop), *_noted(loop.notes)], figure)


def state_html(state: AdhesiveState | DetachmentState) -> str:
    """Return the numbers of a state of adhesive surfaces beside pressure and tension."""
    figure, axes = _figure()
    plot_state(state, axes)
    facts = detachment_state_facts(state) if isinstance(state, DetachmentState) else adhesive_facts(state)
    return _page("State", [*facts, *_noted(state.notes)], figure)


def detachment_html(curve: DetachmentCurve) -> str:
    """Return a table of the loads of stuck surfaces, and the pull-off force beside force against depth."""
    figure, axes = _figure()
    detachment_force(curve, axes)
    table = _table(*load_table(curve.to_dataset(), DETACHMENT_COLUMNS))
    return _page("Detachment", [*detachment_facts(curve), *_noted(curve.notes)], figure) + table


def adhesive_curve_html(loop: AdhesiveCurve) -> str:
    """Return a table of the loads of adhesive surfaces, and jumps and lost energy beside force against depth."""
    figure, axes = _figure()
    jump_loop(loop, axes)
    law = law_facts(loop.adhesion, loop.modulus, loop.spacing, loop.summit_radius)
    facts = [*law, *adhesive_curve_facts(loop), *_noted(loop.notes)]
    table = _table(*load_table(loop.to_dataset(), ADHESIVE_COLUMNS))
    return _page("Loop", facts, figure) + table


def _noted(notes: Sequence[str], name: str = "note") -> list[tuple[str, str]]:
    """Return notes as facts."""
    return [(name, line) for line in notes]


def _table(header: list[str], rows: list[list[str]]) -> str:
    """Return a table; of a long one only the first and the last rows."""
    if len(rows) > _SHOWN:
        left_out = ["..."] * len(header)
        rows = [*rows[: _SHOWN // 2], left_out, *rows[-_SHOWN // 2 :]]
    head = f"<tr>{''.join(f'<th>{escape(cell)}</th>' for cell in header)}</tr>"
    body = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
    return f"<table>{head}{body}</table>"


def _figure() -> tuple[Figure, Axes]:
    figure = Figure(figsize=_SIZE, dpi=_DPI, layout="constrained")
    return figure, figure.subplots()


def _page(name: str, facts: Sequence[tuple[str, str]], figure: Figure) -> str:
    """Return a heading, lines of a name and a value, and the picture beside them."""
    rows = "".join(
        f'<tr><th style="{_LEFT}">{escape(fact)}</th><td style="{_LEFT}">{escape(value)}</td></tr>'
        for fact, value in facts
    )
    whole = BytesIO()
    figure.savefig(whole, format="png")
    picture = f'<img src="data:image/png;base64,{b64encode(whole.getvalue()).decode()}" alt="{name}">'
    beside = "display:flex;flex-wrap:wrap;gap:1em;align-items:flex-start"
    return f'<div style="{beside}"><table><caption>{name}</caption>{rows}</table>{picture}</div>'
