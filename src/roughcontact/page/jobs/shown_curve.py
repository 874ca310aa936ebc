"""Facts, figures and files of curves of every kind, and of single adhesive states."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.errors import InputError
from roughcontact.labels.variables import unit_of
from roughcontact.page.refusal import on_the_page
from roughcontact.validation import Array

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from roughcontact.adhesion.adhesive_curve import AdhesiveCurve
    from roughcontact.adhesion.adhesive_state import AdhesiveState
    from roughcontact.adhesion.detachment_curve import DetachmentCurve
    from roughcontact.contact.curve import Curve
    from roughcontact.contact.loop import Loop

__all__ = ["ShownCurve", "shown_curve"]

_REMEDY = "take loads that suit the surface, or a finer map"


@dataclass(frozen=True, slots=True, eq=False)
class ShownCurve:
    """A curve as it is shown.

    Parameters
    ----------
    curve : Curve, Loop, AdhesiveCurve, DetachmentCurve or AdhesiveState
    facts : list of (str, str)
        Facts about it as a whole: labels and values.
    figure : function
        Draws it; None for a curve of increasing loads, whose figure also shows theories.
    notes : list of str
    more : dict
        Further elements of its chart: a power law, or lines of force against depth.
    maps : list of (str, array, Grid, str)
        Fields beside those of the load: name, values, cells, unit.
    """

    curve: Any
    facts: list[tuple[str, str]]
    figure: Callable[[], Figure] | None = None
    notes: Sequence[str] = ()
    more: dict[str, Any] = field(default_factory=dict)
    maps: Sequence[tuple[str, Array, Any, str]] = ()

    def shown(self) -> dict[str, Any]:
        """Return its values for a page, as plain values."""
        return {"facts": self.facts, "notes": [on_the_page(note) for note in self.notes], **self.more}


def shown_curve(found: Any) -> ShownCurve:
    """Return the shown values of a curve of any kind."""
    return _SHOWN[type(found).__name__](found)


def _of_curve(curve: Curve) -> ShownCurve:
    from roughcontact.plot.facts import bend_words, curve_facts

    try:
        law = curve.fit()
    except InputError as error:
        left_out = f"No power law: {error.message}: {_REMEDY}."
        return ShownCurve(curve, curve_facts(curve, None), notes=(*curve.notes, left_out))
    inside = (curve.force >= law.window[0]) & (curve.force <= law.window[1])
    force = curve.force[inside]
    fit = {
        "exponent": float(law.exponent),
        "force": force.tolist(),
        "stiffness": law.stiffness(force).tolist(),
    }
    notes = curve.notes if law.straight else (*curve.notes, f"There is {bend_words(law)}.")
    return ShownCurve(curve, curve_facts(curve, law), notes=notes, more={"fit": fit})


def _of_loop(loop: Loop) -> ShownCurve:
    from roughcontact.plot.facts import loop_facts
    from roughcontact.plot.loops import loop_figure

    after: Any = loop.flattened
    heights = after.heights - np.nanmean(after.heights)
    maps = [("flattened", heights, after.grid, "m")]
    return ShownCurve(loop, loop_facts(loop), lambda: loop_figure(loop), loop.notes, maps=maps)


def _of_path(path: AdhesiveCurve) -> ShownCurve:
    from roughcontact.plot.adhesive_facts import adhesive_curve_facts, law_facts
    from roughcontact.plot.jumps import jump_figure, pieces_of

    lines = [
        _line(("retreat", "approach")[way], *piece) for way in (True, False) for piece in pieces_of(path, way)
    ]
    lines += [
        _line("jump", (jump.depth, jump.depth_after), (jump.force_before, jump.force_after))
        for jump in path.jumps
        if math.isfinite(jump.depth_after)
    ]
    if path.pull_off_force > 0:
        lines.append(_level(path))
    facts = [
        *law_facts(path.adhesion, path.modulus, path.spacing, path.summit_radius),
        *adhesive_curve_facts(path),
    ]
    return ShownCurve(path, facts, lambda: jump_figure(path), path.notes, {"lines": lines})


def _of_detachment(curve: DetachmentCurve) -> ShownCurve:
    from roughcontact.plot.detachment_plot import detachment_facts, detachment_force, line_of

    def drawn() -> Figure:
        from matplotlib.figure import Figure

        figure = Figure(figsize=(5.6, 4.2), layout="constrained")
        detachment_force(curve, figure.subplots())
        return figure

    lines = [_line("retreat", *line_of(curve).T)]
    if curve.pull_off_force > 0:
        lines.append(_level(curve, lines[0]["x"]))
    return ShownCurve(curve, detachment_facts(curve), drawn, curve.notes, {"lines": lines})


def _of_state(state: AdhesiveState) -> ShownCurve:
    from roughcontact.labels.engineering_units import pretty
    from roughcontact.plot.adhesive_facts import adhesive_facts
    from roughcontact.plot.tension import state_figure

    unit = pretty(unit_of("pressure", state.geometry))
    maps = [("traction", state.pressure, state.problem.operator.grid, unit)]
    return ShownCurve(state, adhesive_facts(state), lambda: state_figure(state), state.notes, maps=maps)


_SHOWN: dict[str, Callable[[Any], ShownCurve]] = {
    "Curve": _of_curve,
    "Loop": _of_loop,
    "AdhesiveCurve": _of_path,
    "DetachmentCurve": _of_detachment,
    "AdhesiveState": _of_state,
}


def _line(label: str, depth: Iterable[float], force: Iterable[float]) -> dict[str, Any]:
    """Return a line of a chart with one value at each place: equal depths are separated by a rounding error."""
    places: list[float] = []
    for each in map(float, depth):
        while each in places[-64:]:
            each = math.nextafter(each, -math.inf)
        places.append(each)
    return {"label": label, "x": places, "y": [float(each) for each in force]}


def _level(curve: AdhesiveCurve | DetachmentCurve, depth: Sequence[float] = ()) -> dict[str, Any]:
    """Return the level of the pull-off force across the depths."""
    finite = np.array([*depth, *curve.depth[np.isfinite(curve.depth)]])
    ends = (float(finite.min()), float(finite.max()))
    return _line("pull-off force", ends, (-curve.pull_off_force, -curve.pull_off_force))
