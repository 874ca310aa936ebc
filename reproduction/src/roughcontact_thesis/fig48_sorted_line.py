"""Figure 48: a rough line sorted by height, from which the depth under a force is read."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

from roughcontact.mdr.lines.rough_line import loading_curves
from roughcontact.validation import Array
from roughcontact_thesis import drawing, fig47_springs_under_line as fig47
from roughcontact_thesis.ruling import exactly
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["Sorted", "case", "draw", "verdicts"]

TITLE = "the rough line of figure 47, and the same springs sorted by height"
FORCES = np.geomspace(1e-4, 1.0, 100)  # over E* h L, for the comparison of both searches
STEPS = 50  # of a binary search: the depth to 1e-15 of the largest
SEED = fig47.SEED
CHOSEN = ("the line and the depth of figure 47", f"{FORCES.size} forces, binary searches of {STEPS} steps")
SIZE = (drawing.COLUMN, 2.5)


@dataclass(frozen=True, slots=True, eq=False)
class Sorted:
    """The line, its heights in order, and the depths under `FORCES` by two searches.

    Attributes
    ----------
    pressed : LineOnSprings
        The line at the level of the picture.
    heights : array, shape (256,)
        The same heights, the highest first.
    by_bisection, by_order : array, shape (100,)
        Depths.
    """

    pressed: fig47.LineOnSprings
    heights: Array
    by_bisection: Array
    by_order: Array


def case(seed: int = SEED) -> Sorted:
    """Return the line, sorted, and the depths."""
    pressed = fig47.case(seed)
    heights, spacing = pressed.line.heights, pressed.line.grid.spacing[0]
    low, high = np.zeros(FORCES.size), np.full(FORCES.size, np.ptp(heights) + FORCES[-1])
    for _ in range(STEPS):
        middle = (low + high) / 2
        over = spacing * np.maximum(heights - heights.max() + middle[:, None], 0).sum(axis=1) > FORCES
        low, high = np.where(over, low, middle), np.where(over, middle, high)
    ordered = loading_curves(heights, spacing, 1.0, forces=FORCES).depth[0]
    return Sorted(pressed, np.sort(heights)[::-1], high, ordered)


def draw(figure: Figure, data: Sorted) -> None:
    """Draw the line (a) and the sorted heights (b) with one level."""
    left, right = drawing.panels(figure, 1, 2, sharey=True)
    level, points = data.pressed.level, data.heights.size
    x = data.pressed.line.grid.coordinates[0]
    for axes, places, heights in (
        (left, x, data.pressed.line.heights),
        (right, np.arange(1, points + 1), data.heights),
    ):
        axes.plot(places, heights, color=drawing.COLOURS[0], linewidth=1.0, zorder=3)
        axes.axhline(level, color=drawing.COLOURS[1], linewidth=1.0)
        where = (heights > level).tolist()
        axes.fill_between(
            places, level, heights, where=where, color=drawing.COLOURS[1], alpha=0.4, linewidth=0
        )
    drawing.label(left, r"$x\,/\,L$", r"height / $h$", xlim=(0, 1))
    drawing.label(right, "rank of the spring", "", xlim=(0, points))


def verdicts(data: Sorted) -> Verdicts:
    """Return how many heights both searches read for the same depths."""
    points, forces = data.heights.size, FORCES.size
    off = float(np.abs(data.by_bisection / data.by_order - 1).max())
    searched = STEPS * points * forces
    order = points * math.ceil(math.log2(points)) + points + forces * math.ceil(math.log2(points))
    yield Verdict(
        "the depth under a force is found much faster on a sorted line",
        "finding the appropriate indentation depth for a given normal force can be done much faster.",
        "section A.2, caption of fig. 48",
        f"depths under {forces} forces agree within {max(off, 1e-15):.0e}; {points} heights are read {searched} times "
        f"by {STEPS} bisections, and {order} times by one sort, a running sum and searches in it",
        exactly(
            bool(off < 1e-9 and order < searched / 10),
            "a tenth of the heights read",
            f"1/{searched / order:.0f}",
        ),
        "method",
    )
