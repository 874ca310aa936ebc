"""Figure 3: a piece of a self-affine line, magnified, looks like the line."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.plot.drawing.raster import box
from roughcontact.validation import Array
from roughcontact_thesis import drawing
from roughcontact_thesis.ruling import exactly
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["Magnified", "case", "draw", "verdicts"]

TITLE = "self-affine lines with H = 1 and 0.5, and a piece of each, magnified to the size of the line"
EXPONENTS = (1.0, 0.5)
FACTOR = 4  # lambda
POINTS = 4096
START = 0.3  # of the piece, over the length of the line
SEED = 23
CHOSEN = (
    f"periodic lines of {POINTS} points, with the same phases",
    f"magnified by lambda = {FACTOR} along the line and by lambda^H in height",
    "the frame of a line as a square; H = 0.5 beside H = 1",
)
SIZE = (drawing.COLUMN, 3.7)


@dataclass(frozen=True, slots=True, eq=False)
class Magnified:
    """A line of length 1 and its piece.

    Attributes
    ----------
    hurst : float
    line : Surface
    """

    hurst: float
    line: rc.Surface

    @property
    def piece(self) -> Array:
        """Heights of the piece above its middle, magnified by lambda^H, shape (1024,)."""
        first = round(START * POINTS)
        heights = self.line.heights[first : first + POINTS // FACTOR]
        return np.asarray(FACTOR**self.hurst * (heights - (heights.max() + heights.min()) / 2))

    @property
    def centre(self) -> float:
        """Height of the middle of the piece."""
        first = round(START * POINTS)
        heights = self.line.heights[first : first + POINTS // FACTOR]
        return float((heights.max() + heights.min()) / 2)

    def second_difference(self, points: int) -> float:
        """Return the rms of h(x + r) - 2 h(x) + h(x - r), r a number of points; a tilt does not change it."""
        z = self.line.heights
        return float(np.sqrt(np.mean((np.roll(z, points) - 2 * z + np.roll(z, -points)) ** 2)))


def case(seed: int = SEED) -> tuple[Magnified, ...]:
    """Return a line for each exponent, with the same phases."""
    grid = rc.Grid(POINTS, 1 / POINTS, periodic=True)
    return tuple(Magnified(h, rc.self_affine(grid, h, 1.0, np.random.default_rng(seed))) for h in EXPONENTS)


def draw(figure: Figure, data: tuple[Magnified, ...]) -> None:
    """Draw the lines (a, b), and below each its piece in the frame of the line (c, d)."""
    panels = drawing.panels(figure, 2, len(data))
    for above, below, one in zip(panels[: len(data)], panels[len(data) :], data, strict=True):
        reach = 1.1 * float(np.abs(one.line.heights).max())
        ends, half = (START, START + 1 / FACTOR), reach / FACTOR**one.hurst
        x = one.line.grid.coordinates[0]
        above.plot(x, one.line.heights, color=drawing.COLOURS[0], linewidth=0.7)
        box(above, ends, (one.centre - half, one.centre + half), color=drawing.COLOURS[1], linewidth=1.2)
        below.plot(np.linspace(*ends, one.piece.size), one.piece, color=drawing.COLOURS[1], linewidth=0.7)
        above.set_title(f"{above.get_title(loc='left')}  $H$ = {one.hurst:g}", loc="left")
        below.set_title(f"{below.get_title(loc='left')}  the piece", loc="left")
        for axes, width in ((above, (0, 1)), (below, ends)):
            axes.set(xlim=width, ylim=(-reach, reach), xticks=[], yticks=[], box_aspect=1)


def verdicts(data: tuple[Magnified, ...]) -> Verdicts:
    """Return how a magnified piece resembles its line."""
    lags = POINTS // 32, POINTS // 128
    ratios = {
        one.hurst: one.second_difference(lags[0]) / (FACTOR**one.hurst * one.second_difference(lags[1]))
        for one in data
    }
    worst = max(ratios.values(), key=lambda ratio: abs(ratio - 1))
    told = ", ".join(f"{ratio:.3f} at H = {h:g}" for h, ratio in ratios.items())
    yield Verdict(
        "a magnification by lambda along the line and by lambda^H in height looks like the line",
        "z' = λ^H z(x/λ)",
        "section 2.2, eq. 2.1, fig. 3",
        f"rms second difference over 1/32 of the line, over that of the piece magnified by {FACTOR}: {told}",
        exactly(
            bool(abs(worst - 1) < 0.05), "5%: the line has a longest and a shortest wave", f"{worst - 1:+.1%}"
        ),
        "method",
    )
