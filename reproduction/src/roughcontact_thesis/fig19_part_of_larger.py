"""Figure 19: one contact, of a rough square and of the larger one that it is a part of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from scipy.ndimage import uniform_filter

import roughcontact as rc
from roughcontact.plot.drawing.raster import box
from roughcontact.validation import Array
from roughcontact_thesis import drawing
from roughcontact_thesis.ruling import exactly, in_part
from roughcontact_thesis.verdict import Verdict, Verdicts, series

__all__ = ["Gedankenexperiment", "case", "draw", "verdicts"]

TITLE = "one contact of a rough square and of the larger one that it is a part of"
POINTS = 256
HURST = 0.7
RMS = 0.01  # of the large indenter, over its side
SCALE = 2  # lambda
NEAR = 0.1  # of a ratio of rms heights
PARTS = (1, 2, 4, 8, 16, 32)  # sides of the large square over those of its parts
SEED = 30
CHOSEN = (
    f"H = {HURST:g}, {POINTS} x {POINTS} cells, rms height {RMS:g} of the side, lambda = {SCALE}",
    "square (1) about the highest point of square (2)",
    "depth: as much as the highest point outside of square (1) lies below the highest",
)
SIZE = (drawing.PAGE, 4.3)


@dataclass(frozen=True, slots=True, eq=False)
class Gedankenexperiment:
    """The contacts of both indenters.

    Attributes
    ----------
    surfaces : tuple of Surface
        The small one and the large one.
    contacts : tuple of Solution
        Of both, at one depth.
    corner : tuple of int
        First row and column of the small indenter in the large one.
    rms : array
        Of square parts of the large surface, for `PARTS`, over that of the whole.
    """

    surfaces: tuple[rc.Surface, rc.Surface]
    contacts: tuple[rc.Solution, rc.Solution]
    corner: tuple[int, int]
    rms: Array


def case(seed: int = SEED) -> Gedankenexperiment:
    """Return the contacts of a rough surface and of a square about its highest point, at one depth."""
    grid = rc.Grid((POINTS, POINTS), 1 / POINTS)
    surface = rc.self_affine(grid, HURST, RMS, np.random.default_rng(seed))
    heights, n = surface.heights, POINTS // SCALE
    peak = np.unravel_index(int(np.argmax(heights)), heights.shape)
    row, column = (int(np.clip(place - n // 2, 0, POINTS - n)) for place in peak)
    window = slice(row, row + n), slice(column, column + n)
    # Where the half-space is not reached at first, it is not reached later: it only gives way.
    outside = heights.copy()
    outside[window] = -np.inf
    depth = float(heights.max() - outside.max())
    surfaces = surface.cropped(*window), surface
    small, large = (rc.press(each, 1.0, depth=depth) for each in surfaces)
    return Gedankenexperiment(surfaces, (small, large), (row, column), _rms_of_parts(heights))


def draw(figure: Figure, data: Gedankenexperiment) -> None:
    """Draw the small indenter and the large one to one scale, and their contact."""
    panels = figure.subplots(1, 2, width_ratios=(1, SCALE))
    x, y = data.corner[1] / POINTS, data.corner[0] / POINTS
    for n, (axes, place) in enumerate(zip(panels, ((x, y), (0.0, 0.0)), strict=True)):
        surface, contact = data.surfaces[n], data.contacts[n]
        length = surface.grid.lengths[0]
        left, right, top, bottom = place[0], place[0] + length, place[1], place[1] + length
        image = _indenter(axes, data, n, (left, right, bottom, top))
        force, stiffness = contact.force / (surface.rms * length), contact.stiffness / length
        centre, middle = (left + right) / 2, (top + bottom) / 2
        axes.text(centre, top - 0.02, f"({n + 1})", ha="center", va="bottom")
        numbers = rf"$\bar{{F}}$ = {force:.4f},  $\bar{{k}}$ = {stiffness:.4f}"
        axes.text(centre, bottom + 0.1, numbers, ha="center", va="top")
        drawing.scale_bar(axes, (left, bottom + 0.03), 0.5 / SCALE, f"$L_2/{2 * SCALE}$")
        drawing.frameless(axes, xlim=(left, right), ylim=(middle + 0.68, middle - 0.56))  # one scale for both
    box(panels[1], (x, x + 1 / SCALE), (y, y + 1 / SCALE), color="black", linewidth=1.4)
    panels[1].text(x + 0.015, y + 0.015, "(1)", va="top")
    bar = figure.colorbar(image, ax=panels, shrink=0.7, pad=0.01)
    bar.set_label("height / $h_2$")


def verdicts(data: Gedankenexperiment) -> Verdicts:
    """Return what both indenters share, and how the rms height of a part compares with that of the whole."""
    small, large = data.contacts
    force, stiffness = (getattr(small, name) / getattr(large, name) - 1 for name in ("force", "stiffness"))
    row, column = data.corner
    expected = np.zeros_like(large.contact)
    expected[row : row + POINTS // SCALE, column : column + POINTS // SCALE] = small.contact
    same = np.array_equal(large.contact, expected)
    ratios = data.rms[:-1] / data.rms[1:]
    away = ratios / 2**HURST - 1
    near = np.flatnonzero(np.abs(away) < NEAR)
    trigger = f"{away[0]:+.0%} between the whole and its halves"
    yield Verdict(
        "a part and the whole have the same contact, force and stiffness at one depth",
        "all physical quantities remain unchanged, that is to say, all quantities that still have dimensions.",
        "section 4.4.2, eqs 4.25, 4.26",
        f"{'the same' if same else 'other'} cells in contact; F and k equal within "
        f"{max(abs(force), abs(stiffness), 1e-15):.0e}",
        exactly(same and bool(abs(force) < 1e-6 and abs(stiffness) < 1e-6), "1e-6"),
        "method",
    )
    yield Verdict(
        "the rms height of a surface grows as lambda^H with its size",
        "we know that for the rms roughness of both we have h_2 = λ^H h_1.",
        "section 4.4.2, eq. 4.27",
        f"{ratios[0]:.3f} in place of {2**HURST:.3f} on the mean over all places, as the longest wave is the side of "
        f"the large one; between parts halved again and again the exponent is {series(np.log2(ratios), '.2f')} in "
        f"place of {HURST:g}",
        in_part(
            f"for parts of L/{PARTS[near[0]]} and smaller", f"{NEAR:.0%} from one size to its half", trigger
        )
        if near.size
        else exactly(False, f"{NEAR:.0%}", trigger),
    )


def _rms_of_parts(heights: Array) -> Array:
    """Return the rms heights of square parts of one period, averaged over all places.

    A part lacks the square of its own mean; over all places that does not depend on the phases of the waves.
    """
    means = (uniform_filter(heights, POINTS // parts, mode="wrap") for parts in PARTS)
    return np.asarray(np.sqrt([1 - each.var() / heights.var() for each in means]))


def _indenter(
    axes: Axes, data: Gedankenexperiment, number: int, extent: tuple[float, float, float, float]
) -> AxesImage:
    # Over the rms height of the large one.
    low, high = (float(end) / RMS for end in (data.surfaces[1].heights.min(), data.surfaces[1].heights.max()))
    grey: Any = {"cmap": "Greys_r", "vmin": low, "vmax": high, "alpha": 0.75, "interpolation": "nearest"}
    image = axes.imshow(data.surfaces[number].heights / RMS, extent=extent, **grey)
    seen = np.where(data.contacts[number].contact, 1.0, np.nan)
    axes.imshow(seen, cmap=ListedColormap([drawing.LINES]), extent=extent, interpolation="nearest")
    return image
