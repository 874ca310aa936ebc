"""Figure 47: a rough line pressed on springs: the lengths in contact and the force."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.mdr.lines.rough_line import loading_curves
from roughcontact.validation import Array
from roughcontact_thesis import drawing
from roughcontact_thesis.ruling import exactly
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["LineOnSprings", "case", "draw", "verdicts"]

TITLE = "a rough line on springs: lengths in contact, and the area that is the force"
POINTS = 256
HURST = 0.7
DEPTH = 1.0  # below the highest point, in units of the rms height
SEED = 30
CHOSEN = (
    f"a line of {POINTS} points, H = {HURST:g}, waves down to 1/32 of its length",
    f"depth {DEPTH:g} of the rms height h; line upside down, as in the text: springs touch above the level",
)
SIZE = (drawing.COLUMN, 2.6)


@dataclass(frozen=True, slots=True, eq=False)
class LineOnSprings:
    """A line of length 1 at a level, for E* = 1.

    Attributes
    ----------
    line : Surface
    level : float
        Height of the surface of the foundation.
    """

    line: rc.Surface
    level: float

    @property
    def springs(self) -> npt.NDArray[np.bool_]:
        """Which springs are in contact, shape (256,)."""
        return np.asarray(self.line.heights > self.level)

    @property
    def spots(self) -> Array:
        """First and last edge of each spot, shape (spots, 2)."""
        turns = np.flatnonzero(np.diff(np.concatenate([[0], self.springs.astype(int), [0]])))
        return np.asarray(turns.reshape(-1, 2) * self.line.grid.spacing[0])

    @property
    def lengths(self) -> Array:
        """L_i, shape (spots,)."""
        return np.asarray(np.diff(self.spots, axis=1)[:, 0])

    @property
    def force(self) -> float:
        """F_N as captioned, with the height of the level for d."""
        above = self.line.heights[self.springs] - self.level
        return float(self.line.grid.spacing[0] * above.sum())


def case(seed: int = SEED) -> LineOnSprings:
    """Return the line and the level."""
    line = rc.self_affine(
        rc.Grid(POINTS, 1 / POINTS), HURST, 1.0, np.random.default_rng(seed), short_cutoff=1 / 32
    )
    return LineOnSprings(line, float(line.heights.max()) - DEPTH)


def draw(figure: Figure, data: LineOnSprings) -> None:
    """Draw the line above the level, with the lengths in contact and the shaded area."""
    axes = figure.subplots()
    x, heights = data.line.grid.coordinates[0], data.line.heights
    axes.plot(x, heights, color=drawing.COLOURS[0], linewidth=1.1, zorder=3)
    axes.axhline(data.level, color=drawing.COLOURS[1], linewidth=1.0)
    touching = data.springs.tolist()
    axes.fill_between(
        x, data.level, heights, where=touching, color=drawing.COLOURS[1], alpha=0.4, linewidth=0
    )
    axes.vlines(x[data.springs], data.level, heights[data.springs], color=drawing.COLOURS[1], linewidth=0.4)
    for number, (start, end) in enumerate(data.spots, start=1):
        place = data.level - 0.15
        drawing.arrow(axes, (start, place), (end, place), "<->", linewidth=0.7, mutation_scale=5)
        axes.text((start + end) / 2, place - 0.1, f"$L_{number}$", ha="center", va="top")
    axes.text(0.01, data.level + 0.06, "$d$", color=drawing.COLOURS[1])
    drawing.label(axes, r"$x\,/\,L$", r"height / $h$", xlim=(0, 1))


def verdicts(data: LineOnSprings) -> Verdicts:
    """Return force and stiffness as captioned, beside those of the springs."""
    spacing, depth = data.line.grid.spacing[0], float(data.line.heights.max()) - data.level
    above = np.sort(np.abs(data.line.heights - data.level))[0] / 2  # no spring touches or leaves within it
    pressed = loading_curves(data.line.heights, spacing, 1.0, depths=[depth - above, depth, depth + above])
    force = abs(data.force / float(pressed.force[0, 1]) - 1)
    stiffness = float(np.ptp(pressed.force[0])) / (2 * above)
    yield Verdict(
        "the force is the sum of the deflections of the springs in contact",
        "F_N = E^* Δ Σ_c (h_c - d)",
        "section A.2, caption of fig. 47",
        f"within {max(force, 1e-15):.0e} of the force of the line, with d as the height of the level",
        exactly(bool(force < 1e-10), "rounding"),
        "method",
    )
    printed = float(data.lengths.sum()) / POINTS
    yield Verdict(
        "the stiffness is E*/n times the lengths in contact",
        "k = E^*/n Σ_i L_i",
        "section A.2, caption of fig. 47",
        f"dF/dd is {stiffness / float(data.lengths.sum()):.6f} of E* times the sum of the lengths, without n",
        exactly(bool(abs(printed / stiffness - 1) < 1e-6), "1e-6", f"a factor of n = {POINTS}"),
        "misprint",
    )
