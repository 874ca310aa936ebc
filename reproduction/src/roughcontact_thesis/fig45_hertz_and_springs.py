"""Figure 45: Hertz' contact, and the springs that take its place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.mdr.lines.rough_line import loading_curves
from roughcontact.theory.spheres_and_punches.hertz import point
from roughcontact.validation import Array
from roughcontact_thesis import drawing
from roughcontact_thesis.ruling import exactly
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["Equivalent", "case", "draw", "verdicts"]

TITLE = "a sphere on a half-space, and the springs under a parabola of half its radius"
RADIUS, DEPTH = 1.0, 0.04
REACH = 0.5  # on either side of the axis
RINGS, SPRINGS = 500, 2001
SHOWN = 22  # springs
SEED = 0
CHOSEN = (
    "(a) computed on rings, (b) on springs; R as the unit of length",
    f"depth {DEPTH:g} R, heights enlarged; {SHOWN} of {SPRINGS} springs are drawn",
)
SIZE = (drawing.COLUMN, 3.8)

_BODY, _BELOW, _FLOOR = "#cfe3f2", "#eeeeee", -2.2 * DEPTH


@dataclass(frozen=True, slots=True, eq=False)
class Equivalent:
    """The contact and its springs at one depth, for E* = 1.

    Attributes
    ----------
    solution : Solution
        Of the sphere, on rings.
    x, springs : array, shape (2001,)
        Places of the springs, and their deflections.
    force, radius : tuple of float
        Of the sphere and of the springs.
    """

    solution: rc.Solution
    x: Array
    springs: Array
    force: tuple[float, float]
    radius: tuple[float, float]


def case(seed: int = SEED) -> Equivalent:
    """Return both contacts; nothing is random, the seed is not used."""
    rings = rc.RadialGrid.uniform(RINGS, REACH)
    solution = rc.press(rc.RadialProfile(-(rings.radii**2) / (2 * RADIUS), rings), 1.0, depth=DEPTH)
    x = np.linspace(-REACH, REACH, SPRINGS)
    line = -(x**2) / RADIUS  # of radius R/2
    pressed = loading_curves(line, x[1] - x[0], 1.0, depths=[DEPTH])
    return Equivalent(
        solution,
        x,
        np.maximum(line + DEPTH, 0),
        (solution.force, float(pressed.force[0, 0])),
        (float(np.sqrt(solution.contact_area / np.pi)), float(pressed.contact_length[0, 0]) / 2),
    )


def draw(figure: Figure, data: Equivalent) -> None:
    """Draw a cut through the sphere and the half-space (a), and the parabola on springs (b), to one scale."""
    upper, lower = drawing.panels(figure, 2, 1, sharex=True, sharey=True)
    rings = data.solution.problem.grid.coordinates[0]
    u = np.interp(np.abs(data.x), rings, data.solution.displacement)
    upper.fill_between(data.x, _FLOOR, -u, color=_BELOW, linewidth=0)
    upper.plot(data.x, -u, color="0.3", linewidth=1.0)
    _indenter(upper, data.x, RADIUS, "$R$")
    _indenter(lower, data.x, RADIUS / 2, "$R_1 = R/2$")
    for place in np.linspace(0, SPRINGS - 1, SHOWN).astype(int)[1:-1]:
        _spring(lower, float(data.x[place]), -float(data.springs[place]))
    lower.axhline(_FLOOR, color="0.3", linewidth=1.2)
    for axes, radius in zip((upper, lower), data.radius, strict=True):
        for side in (-radius, radius):
            axes.plot([side, side], [-DEPTH * 1.5, 0], ":", color=drawing.COLOURS[1], linewidth=1.0, zorder=4)
        drawing.arrow(axes, (0, -DEPTH * 1.35), (radius, -DEPTH * 1.35), color=drawing.COLOURS[1])
        axes.text(
            radius / 2, -DEPTH * 1.5, "$a$", ha="center", va="top", color=drawing.COLOURS[1], bbox=_ROOM
        )
        axes.axhline(0, color="0.6", linewidth=0.7, linestyle="--", zorder=0)
        axes.set_ylabel(r"height / $R$")
    lower.set(xlabel=r"$x\,/\,R$", xlim=(-REACH, REACH), ylim=(_FLOOR * 1.05, 2.2 * DEPTH))


def verdicts(data: Equivalent) -> Verdicts:
    """Return whether the springs have the force and the radius of Hertz' contact (eqs A.60 to A.66)."""
    exact = point(1.0, radius=RADIUS, depth=DEPTH)
    force, wide = (
        abs(found / float(closed) - 1)
        for found, closed in ((data.force[1], exact.force), (data.radius[1], exact.contact_radius))
    )
    yield Verdict(
        "independent springs under R1 = R/2 have the force and the radius of Hertz",
        "So simply by choosing R_1 = R/2, we can find that eq. A.61 and A.62 as well as A.60 and A.65 coincide.",
        "section A.2, eqs A.60 to A.66, fig. 45",
        f"force within {force:.0e}, radius within {wide:.0e} on {SPRINGS} springs",
        exactly(max(force, wide) < 5e-3, "5e-3: a spring over the radius"),
        "method",
    )


_ROOM = {"facecolor": "white", "edgecolor": "none", "pad": 0.3, "alpha": 0.8}  # behind a letter


def _indenter(axes: Axes, x: Array, radius: float, name: str) -> None:
    z = x**2 / (2 * radius) - DEPTH
    axes.fill_between(x, z, 1.0, color=_BODY, linewidth=0, zorder=2)
    axes.plot(x, z, color=drawing.COLOURS[0], linewidth=1.4, zorder=3)
    axes.text(0, 1.2 * DEPTH, name, ha="center", zorder=5)


def _spring(axes: Axes, x: float, top: float) -> None:
    """Draw a spring from the floor to its top."""
    ends = np.array([0, 0.15, *np.linspace(0.2, 0.8, 8), 0.85, 1])
    sides = np.array([0, 0, *np.resize([1, -1], 8), 0, 0])
    axes.plot(x + 0.008 * sides, _FLOOR + (top - _FLOOR) * ends, color="0.3", linewidth=0.6, zorder=1)
