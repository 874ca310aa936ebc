"""Detachment of stuck surfaces: force against depth, with the cells that let go, and the main numbers in words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes

from roughcontact.labels.adhesive_columns import DETACHMENT_CURVE
from roughcontact.labels.column import names_of, shown_in
from roughcontact.labels.engineering_units import scale, written
from roughcontact.labels.variables import VARIABLES, unit_of
from roughcontact.plot.adhesive_facts import tension
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.ticks import LABEL, label_axes
from roughcontact.plot.facts import closed_gap, quantity, size_of
from roughcontact.validation import Array

if TYPE_CHECKING:
    from roughcontact.adhesion.detachment_curve import DetachmentCurve
    from roughcontact.adhesion.detachment_state import DetachmentState

__all__ = ["DETACHMENT_COLUMNS", "detachment_facts", "detachment_force", "detachment_state_facts", "line_of"]

DETACHMENT_COLUMNS = names_of(shown_in("path", DETACHMENT_CURVE[("load",)]))
_COLOUR = "#d55e00"


def detachment_force(curve: DetachmentCurve, ax: Axes | None = None) -> Axes:
    """Draw force against depth: a line through all detachments, and a mark at each load.

    Parameters
    ----------
    curve : DetachmentCurve
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> curve = rc.detachment_curve(rc.press(ball, 1e8, depth=2e-8), 10e-3, depths=[2e-8, 1e-8, 0.0, -2e-8])
    >>> rc.plot.detachment_force(curve).get_title()
    'pull-off force 487 nN, 30 detachments'
    """
    axes, kind = axes_for(ax), curve.geometry
    line = line_of(curve)
    x = scale(float(np.abs(line[:, 0]).max(initial=0.0)), VARIABLES["depth"].unit)
    y = scale(float(np.abs(line[:, 1]).max(initial=0.0)), unit_of("force", kind))
    axes.axhline(0.0, color="0.75", linewidth=0.8, zorder=0)
    axes.plot(line[:, 0] * x.factor, line[:, 1] * y.factor, linewidth=1.1, color=_COLOUR)
    marks: Any = {"color": _COLOUR, "markerfacecolor": "none", "markersize": 3.5}
    axes.plot(curve.depth * x.factor, curve.force * y.factor, "v", **marks)
    words = f"{_pull_off(curve)} {written(curve.pull_off_force, unit_of('force', kind))}"
    title = f"{words}, {_count(len(curve.detachments), 'detachment')}"
    axes.set_title(title + (" (preload too small)" if curve.preload_too_small else ""), fontsize=LABEL)
    label_axes(axes, f"depth [{x.unit}]", f"force [{y.unit}]", grid=True)
    return axes


def detachment_state_facts(state: DetachmentState) -> list[tuple[str, str]]:
    """Return the main numbers of a state of stuck surfaces, line by line."""
    problem, kind = state.problem, state.geometry
    met = "met" if state.status.converged else "MISSED"
    energies = [quantity(name, getattr(state, name), kind) for name in ("elastic_energy", "adhesive_energy")]
    return [
        ("surface", size_of(problem.grid)),
        *_of_the_bodies(state.work, problem.modulus),
        ("force", quantity("force", state.force, kind)),
        ("nominal pressure", quantity("pressure", state.nominal_pressure, kind)),
        ("largest pressure", quantity("pressure", state.max_pressure, kind)),
        ("largest tension", quantity("pressure", state.max_tension, kind)),
        ("depth", quantity("depth", state.depth, kind)),
        ("stiffness", quantity("stiffness", state.stiffness, kind)),
        ("contact area", quantity("contact_area", state.contact_area, kind)),
        ("relative contact area A/A0", f"{state.contact_fraction:.4g}"),
        ("mean gap", quantity("mean_gap", float(closed_gap(state.mean_gap, state.depth)), kind)),
        ("elastic and adhesive energy", " and ".join(energies)),
        ("largest tension so far", quantity("pull_off_force", state.pull_off_force, kind)),
        ("certificate", f"{state.residual:.1e} (tolerance {problem.tolerance:.0e}: {met})"),
    ]


def detachment_facts(curve: DetachmentCurve) -> list[tuple[str, str]]:
    """Return the main numbers of a curve of stuck surfaces, line by line."""
    kind = curve.geometry
    depth, force = min(line_of(curve), key=lambda point: point[1], default=(0.0, 0.0))
    at = f" at a depth of {quantity('depth', depth)}" if force < 0 else ""
    return [
        *_of_the_bodies(curve.work, curve.modulus),
        (_pull_off(curve), tension(curve.pull_off_force, kind) + at),
        (_count(len(curve.detachments), "detachment"), f"{quantity('lost_energy', curve.lost, kind)} lost"),
        ("largest certificate", f"{curve.residual.max():.1e}"),
    ]


def _of_the_bodies(work: float | Array, modulus: float) -> list[tuple[str, str]]:
    each = "that of each cell" if np.ndim(work) else quantity("work_of_adhesion", float(work))
    return [("reduced modulus E*", quantity("modulus", modulus)), ("work of adhesion", each)]


def _pull_off(curve: DetachmentCurve) -> str:
    return "pull-off force" if curve.contact_area[-1] == 0 else "largest tension"


def _count(number: int, name: str) -> str:
    return f"{number} {name}{'' if number == 1 else 's'}"


def line_of(curve: DetachmentCurve) -> Array:
    """Return depths and forces along the curve; between detachments the force is linear in the depth."""
    points: list[tuple[float, float]] = []
    for k, here in enumerate(zip(curve.depth, curve.force, strict=True)):
        for event, at in zip(curve.detachments, curve.detached_at, strict=True):
            if at == k:
                points += [(event.depth, event.force_before), (event.depth_after, event.force_after)]
        points.append(here)
    finite = [point for point in points if np.isfinite(point).all()]
    return np.array(finite, np.float64).reshape(-1, 2)
