"""Figure 6: rough lines with different Hurst exponents."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact_thesis import drawing

__all__ = ["case", "draw"]

TITLE = "lines with H = 0, 0.5, 1, 1.5, 2 and the same phases"
EXPONENTS = (0.0, 0.5, 1.0, 1.5, 2.0)
POINTS = 1024
LENGTH = 1.0
RMS = 0.01  # over the length
SEED = 4
CHOSEN = (
    f"{POINTS} points",
    f"rms height {RMS:g} L for every H, enlarged in the picture",
    "the same phases for every H",
)
SIZE = (drawing.COLUMN, 3.6)


def case(seed: int = SEED) -> tuple[rc.Surface, ...]:
    """Return a periodic line for each exponent, with the same phases and rms height."""
    grid = rc.Grid((POINTS,), (LENGTH / POINTS,), periodic=True)
    return tuple(
        rc.self_affine(grid, hurst, RMS * LENGTH, np.random.default_rng(seed)) for hurst in EXPONENTS
    )


def draw(figure: Figure, data: tuple[rc.Surface, ...]) -> None:
    """Draw the lines (a) to (e), one below the other, all to one scale."""
    panels = figure.subplots(len(data), 1, sharex=True, sharey=True)
    reach = 1.08 * max(float(np.abs(line.heights).max()) for line in data)
    for letter, axes, hurst, line in zip("abcde", panels, EXPONENTS, data, strict=True):
        x = (np.arange(line.heights.size) + 0.5) / line.heights.size
        axes.plot(x, line.heights, color=drawing.COLOURS[0], linewidth=0.9)
        axes.set(xlim=(0, 1), ylim=(-reach, reach))
        axes.set_ylabel(f"({letter})  H = {hurst:.1f}", rotation=0, ha="right", va="center")
        axes.spines[:].set_visible(False)
        axes.tick_params(bottom=False, left=False, labelbottom=False, labelleft=False)
