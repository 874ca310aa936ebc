"""Figure 7: rough surfaces with different Hurst exponents."""

from __future__ import annotations

import numpy as np
import xarray
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.plot.view import surface_view
from roughcontact_thesis import drawing
from roughcontact_thesis.fig6_lines_by_hurst import EXPONENTS, LENGTH
from roughcontact_thesis.ruling import ruled
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["EXPONENTS", "case", "draw", "verdicts"]

TITLE = "surfaces with H = 0, 0.5, 1, 1.5, 2 and the same phases"
POINTS = 128
RMS = 0.05  # over the side
SEED = 3
COUNTED = (0.3, 0.5, 0.7, 0.9)  # Hurst exponents at which boxes are counted
BOXES = (513, 8)  # points a side, and surfaces of each exponent
CHOSEN = (
    f"{POINTS} x {POINTS} points",
    f"rms height {RMS:g} L for every H; each view is as high as its surface",
    "the same phases for every H",
)
SIZE = (drawing.PAGE, 4.6)


def case(seed: int = SEED) -> tuple[rc.Surface, ...]:
    """Return a periodic surface for each exponent, with the same phases and rms height."""
    grid = rc.Grid((POINTS, POINTS), LENGTH / POINTS, periodic=True)
    return tuple(
        rc.self_affine(grid, hurst, RMS * LENGTH, np.random.default_rng(seed)) for hurst in EXPONENTS
    )


def draw(figure: Figure, data: tuple[rc.Surface, ...]) -> None:
    """Draw the surfaces (a) to (e): three above, two below."""
    # Six columns, of which each view takes two: so the lower row stands in the middle.
    table = figure.add_gridspec(2, 6)
    places = [table[0, 0:2], table[0, 2:4], table[0, 4:6], table[1, 1:3], table[1, 3:5]]
    for letter, place, hurst, surface in zip("abcde", places, EXPONENTS, data, strict=True):
        axes = figure.add_subplot(place, projection="3d")
        surface_view(surface, axes, frame=False)
        axes.set_title(f"({letter})  H = {hurst:.1f}", loc="center", y=0.92)


def verdicts(data: tuple[rc.Surface, ...]) -> Verdicts:
    """Return the fractal dimensions of such surfaces, by counting boxes."""
    points, draws = BOXES
    grid = rc.Grid((points, points), LENGTH / points)
    counted = np.array(
        [
            [
                rc.box_counting_dimension(rc.self_affine(grid, hurst, RMS, np.random.default_rng(seed)))
                for seed in range(draws)
            ]
            for hurst in COUNTED
        ]
    )
    hurst = xarray.DataArray(list(COUNTED), {"hurst": list(COUNTED)}, "hurst")
    mean, error = counted.mean(axis=1), counted.std(axis=1, ddof=1) / np.sqrt(draws)
    rows = zip(mean, COUNTED, strict=True)
    yield Verdict(
        "the fractal dimension is 3 - H",
        "H = 3 - D_f",
        "section 2.2, eqs 2.2 and 2.9",
        f"by boxes {', '.join(f'{each:.2f} at H = {h:g}' for each, h in rows)}; {draws} surfaces of {points}² points. "
        "Points miss the extremes between them, the more the lower H",
        ruled(mean - 3 + hurst, error + 0 * hurst, 0.1, "+.2f"),
        "method",
    )
