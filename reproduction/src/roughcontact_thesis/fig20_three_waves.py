"""Figure 20: a line of three waves, and three depths at which it is pressed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.mdr.lines.line_curves import LineCurves
from roughcontact.mdr.lines.rough_line import loading_curves
from roughcontact.plot.drawing.raster import box
from roughcontact.theory.springs.two_cosines import FLAT_STIFFNESS, Hierarchy
from roughcontact.validation import Array
from roughcontact_thesis import drawing
from roughcontact_thesis.ruling import exactly
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["WavyLine", "case", "draw", "verdicts"]

TITLE = "a rough line with three scales, H = 0.9, C = 7, and depths of indentation"
WAVES = Hierarchy(amplitude=1.0, wavenumber=2 * np.pi, ratio=7.0, hurst=0.9)
COUNT = 3
CREST = 401  # points a crest of the shortest wave; odd, so that the highest crest lies on a point
SEED = 0
CHOSEN = (
    "longest wavelength and its amplitude h0 as units; all waves in phase at the highest crest",
    "d1 = h2, on the highest crest; d2 = 2.4 h2, on three crests of the shortest wave; d3 = h1, where it is flat",
    "pressed as in the method of dimensionality reduction: springs touch where the line stands above the level",
)
SIZE = (drawing.PAGE, 3.6)

_LEVELS = ("#8b1a1a", "#d55e00", "#b07d00")  # of d1, d2, d3


@dataclass(frozen=True, slots=True, eq=False)
class WavyLine:
    """The line, 0 at its highest crest, and how it is pressed.

    Attributes
    ----------
    line : Surface
        One period of the longest wave; lengths in units of it, heights in those of its amplitude.
    amplitudes : array
        Of the three waves.
    pressed : LineCurves
        At the three depths, for E* = 1.
    """

    line: rc.Surface
    amplitudes: Array
    pressed: LineCurves

    def touching(self, depth: float) -> npt.NDArray[np.bool_]:
        """Return which points of the line stand above the level at a depth."""
        return np.asarray(self.line.heights > self.line.heights.max() - depth)

    def spots(self, depth: float) -> int:
        """Return the number of separate spots of contact in a period."""
        return int((np.diff(self.touching(depth).astype(int)) == 1).sum())


def case(seed: int = SEED) -> WavyLine:
    """Return the line and its contact at three depths; nothing is random, the seed is not used."""
    lengths = 2 * np.pi / WAVES.wavenumbers(COUNT)
    points = round(float(lengths[0] / lengths[-1])) * CREST
    grid = rc.Grid(points, float(lengths[0]) / points, periodic=True)
    amplitudes = WAVES.amplitudes(COUNT)
    first, *others = (
        rc.shapes.wave(grid, float(h), float(length)) for h, length in zip(amplitudes, lengths, strict=True)
    )
    line = sum(others, first)
    depths = np.array([amplitudes[2], 2.4 * amplitudes[2], amplitudes[1]])
    return WavyLine(line, amplitudes, loading_curves(line.heights, grid.spacing[0], 1.0, depths=depths))


def draw(figure: Figure, data: WavyLine) -> None:
    """Draw the line with its levels of indentation (a), and the highest crest enlarged (b)."""
    left, right = drawing.panels(figure, 1, 2, width_ratios=(1.3, 1))
    across, upright = (-0.05, 0.05), (-0.23, 0.015)
    _line(left, data, (-0.5, 0.5), (float(data.line.heights.min()) - 0.1, 0.15))
    _line(right, data, across, upright)
    box(left, across, upright, color="0.35", linewidth=0.8)
    left.text(across[1] + 0.015, upright[1], "(b)", va="center")
    for axes in (left, right):
        axes.set_xlabel(r"$x\,/\,\lambda_0$")
        axes.locator_params(axis="x", nbins=5)
    for n, (depth, colour) in enumerate(zip(data.pressed.depth, _LEVELS, strict=True), start=1):
        right.axhline(-depth, color=colour, linewidth=1.0, linestyle="--", zorder=3)
        beside = right.get_yaxis_transform()
        right.text(1.02, -depth, f"$d_{n}$", transform=beside, va="center", color=colour)
    left.set_ylabel(r"height below the crest / $h_0$")


def verdicts(data: WavyLine) -> Verdicts:
    """Return where contact is one spot, and what the asymptotic forms of 4.45 to 4.47 make of this line."""
    spots = [data.spots(float(depth)) for depth in data.pressed.depth]
    first, last = _one_spot(data)
    beyond = np.abs(data.line.grid.coordinates[0] - data.line.grid.lengths[0] / 2) > 0.5 / WAVES.ratio
    crests = -float(data.line.heights[beyond].max())
    depths, spacing = 2 * data.amplitudes[:0:-1], data.line.grid.spacing[0]
    ends = loading_curves(data.line.heights, spacing, 1.0, depths=depths, energy=False)
    stiffness, force = ends.stiffness[0], ends.force[0]
    exponent = float(np.log(stiffness[1] / stiffness[0]) / np.log(force[1] / force[0]))
    asymptotic = float(WAVES.corners(1, 1.0)[1][0])
    printed = asymptotic / FLAT_STIFFNESS * 4
    alpha = 1 / (WAVES.hurst + 1)
    yield Verdict(
        "each wave is flat before the next crest of the longer one touches",
        "contact will regularly occur at one continuous spot",
        "section 4.4.2, fig. 20",
        f"{spots[0]}, {spots[1]} and {spots[2]} spots at d1, d2 and d3; one from {first:.3f} h0 to {last:.3f} h0, "
        f"where the shortest wave touches at its flanks; the next crests do at {crests:.3f} h0",
        exactly(bool(spots[2] == 1 and last < crests), "one spot at d3"),
        "method",
    )
    yield Verdict(
        "stiffness where the middle wave is flat, over E* and the longest wavelength",
        f"{printed:.4f}",
        "eq. 4.46, d = 2 h1",
        f"{stiffness[1]:.4f}; {asymptotic:.4f} by the corrected form, which holds for a large C",
        exactly(bool(abs(stiffness[1] / printed - 1) < 0.05), "5%", f"{printed / stiffness[1] - 1:+.0%}"),
        "misprint",
    )
    yield Verdict(
        "a line of three waves follows k ~ F^(1/(H + 1)) from one scale to the next",
        "k ∝ F^(1/(H+1))",
        "eq. 4.47",
        f"{exponent:.4f} between the depths 2 h2 and 2 h1, {alpha:.4f} by the law",
        exactly(bool(abs(exponent / alpha - 1) < 0.02), "2%", f"{exponent / alpha - 1:+.2%}"),
        "method",
    )


def _one_spot(data: WavyLine) -> tuple[float, float]:
    """Return between which depths about d3 contact is one spot."""
    depth = float(data.pressed.depth[2])
    below = np.linspace(0, depth, 3000)
    above = np.linspace(depth, 2.5 * depth, 3000)
    first = max((each for each in below if data.spots(each) > 1), default=0.0)
    last = min((each for each in above if data.spots(each) > 1), default=float(above[-1]))
    return float(first), float(last)


def _line(axes: Axes, data: WavyLine, across: tuple[float, float], upright: tuple[float, float]) -> None:
    x = data.line.grid.coordinates[0] - data.line.grid.lengths[0] / 2
    heights = data.line.heights
    axes.plot(x, heights, color=drawing.COLOURS[0], linewidth=1.0, zorder=4)
    for depth, colour in zip(data.pressed.depth[::-1], _LEVELS[::-1], strict=True):
        touching = data.touching(float(depth)).tolist()
        axes.fill_between(x, -depth, heights, where=touching, color=colour, alpha=0.35, linewidth=0)
    axes.set(xlim=across, ylim=upright)
