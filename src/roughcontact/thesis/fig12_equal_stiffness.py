"""Figure 12: contact regions of different shapes and one stiffness."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from scipy.optimize import brentq

import roughcontact as rc
from roughcontact.theory import punch
from roughcontact.thesis import drawing
from roughcontact.thesis.verdict import Verdict, Verdicts
from roughcontact.validation import Array, Mask

__all__ = ["PunchShape", "case", "draw", "verdicts"]


TITLE = "contact regions of equal stiffness: a disc, two discs, a square, a triangle"
SPACING = 3.0  # of the two discs, in radii of the single one
FIELD = 4.4  # side of the map in the same
CELLS = (128, 256)
SEED = 0
CHOSEN = (
    f"two discs {SPACING:g} a apart",
    "sizes from the stiffnesses of punches as computed here: the square's is 0.9 %, the triangle's 2.6 % above the "
    "source of the figure",
    f"colours: pressure under a flat punch, from {CELLS[1]} x {CELLS[1]} cells",
)
SIZE = (7.4, 2.2)

# Stiffnesses over 2 E* sqrt(A/pi) in the thesis' source of the figure; the square's stands in eqs 4.7 and 4.14, too.
_PRINTED = {"square": (1.012, "eqs 4.7, 4.14"), "triangle": (1.034, "source of the figure")}


@dataclass(frozen=True, slots=True, eq=False)
class PunchShape:
    """A contact region as stiff as a disc of radius 1, with E* = 1.

    Attributes
    ----------
    name : str
    size : float
        Radius of each disc, or side.
    outlines : tuple of array, each of shape (2, n)
        Closed curves x, y from the middle of the map.
    area : float
    cells : float
        Stiffness over that of the disc, from cells.
    pressure : array
        Of a flat punch pressed by a unit depth, on the finer cells.
    """

    name: str
    size: float
    outlines: tuple[Array, ...]
    area: float
    cells: float
    pressure: Array

    @property
    def shape_factor(self) -> float:
        """Stiffness over that of a disc of the same area, from cells."""
        return float(punch.shape_factor(2 * self.cells, 1.0, self.area))


def case(seed: int = SEED) -> tuple[PunchShape, ...]:
    """Return the four regions; nothing is random, the seed is not used."""
    radius = float(brentq(lambda a: float(punch.two_discs(1.0, a, SPACING)) - 2, 0.4, 1.0))
    side, edge = 2 / float(punch.square(1.0, 1.0)), 2 / float(punch.triangle(1.0, 1.0))
    places = (-SPACING / 2, SPACING / 2)
    middle = FIELD / 2
    turn = np.linspace(0, 2 * math.pi, 241)
    circle = np.stack([np.cos(turn), np.sin(turn)])
    circles = tuple(radius * circle + np.array([[x], [0.0]]) for x in places)
    square = side / 2 * np.array([[-1, 1, 1, -1, -1], [-1, -1, 1, 1, -1]])
    # Its corners are equally far from the centroid, one of them above it.
    corners = math.pi / 2 + 2 * math.pi / 3 * np.arange(4)
    triangle = edge / math.sqrt(3) * np.stack([np.cos(corners), np.sin(corners)])
    area = math.sqrt(3) / 4 * edge**2

    def discs(grid: rc.Grid) -> Mask:
        first, second = (rc.shapes.flat_disc(grid, radius, (middle, middle + x)).measured for x in places)
        return np.asarray(first | second)

    return (
        _region("disc", (1.0, math.pi), (circle,), lambda g: rc.shapes.flat_disc(g, 1.0).measured),
        _region("two discs", (radius, 2 * math.pi * radius**2), circles, discs),
        _region("square", (side, side**2), (square,), lambda g: rc.shapes.flat_square(g, side).measured),
        _region("triangle", (edge, area), (triangle,), lambda g: rc.shapes.flat_triangle(g, edge).measured),
    )


def draw(figure: Figure, data: tuple[PunchShape, ...]) -> None:
    """Draw the regions to one scale, with their pressures and sizes."""
    panels = figure.subplots(1, len(data), width_ratios=[2 * _reach(region) for region in data])
    two, square, triangle = (f"{region.size:.3f} a" for region in data[1:])
    words = "radius a", f"radii {two}, {SPACING:g} a apart", f"side {square}", f"side {triangle}"
    for letter, axes, region, text in zip("abcd", panels, data, words, strict=True):
        image = _region_view(axes, region)
        axes.set(xlabel=text, title=f"({letter})")
    bar = figure.colorbar(image, ax=panels, shrink=0.9, pad=0.01, extend="max")
    bar.set_label(r"$p\,/\,(E^* d\,/\,a)$")


def verdicts(data: tuple[PunchShape, ...]) -> Verdicts:
    """Return the shape factors of square and triangle, and what two discs lose by each other."""
    one, two, *angular = data
    stiffnesses = punch.square(1.0, 1.0), punch.triangle(1.0, 1.0)
    exact = map(punch.shape_factor, stiffnesses, (1.0, 1.0), (1.0, math.sqrt(3) / 4))
    apart = float(punch.two_discs(1.0, two.size, SPACING) / (2 * punch.disc(1.0, two.size)))
    far = float(brentq(lambda s: float(punch.two_discs(1.0, 1.0, s)) - 0.99 * 4, 3.0, 1e3))
    for region, factor in zip(angular, map(float, exact), strict=True):
        printed, source = _PRINTED[region.name]
        yield Verdict(
            f"stiffness of a {region.name} over that of a disc of its area ({source})",
            f"{printed:.3f}",
            f"{factor:.4f}, and {region.shape_factor / one.shape_factor:.3f} from {CELLS[0]}² and {CELLS[1]}² cells",
            abs(factor / printed - 1) < 5e-4,
        )
    yield Verdict(
        "two distant circles act in parallel",
        "k = k1 + k2",
        f"{apart:.3f} of the sum {SPACING:g} a apart; 0.99 of it {far:.0f} of their radii apart",
        None,
    )


def _region(
    name: str, size_area: tuple[float, float], outlines: tuple[Array, ...], mask: Callable[[rc.Grid], Mask]
) -> PunchShape:
    """Return a region with what cells make of it."""
    size, area = size_area
    stiffness = []
    for n in CELLS:
        grid = rc.Grid((n, n), FIELD / n)
        inside = mask(grid)
        punched = rc.prescribed_displacement(inside, 1.0, operator=rc.half_space(grid, 1.0))
        # The cells cover a little more or less than the region; a stiffness is a length.
        stiffness.append(punched.force * math.sqrt(area / (inside.sum() * grid.cell_area)))
    coarse, fine = stiffness
    # Uniform pressure in cells leaves an error that falls as the size of the cells.
    return PunchShape(name, size, outlines, area, (2 * fine - coarse) / 2, punched.pressure)


def _reach(region: PunchShape) -> float:
    """Return half the width of what is shown."""
    return 1.12 * max(float(curve[0].max()) for curve in region.outlines)


def _region_view(axes: Axes, region: PunchShape) -> AxesImage:
    reach = FIELD / 2
    seen = np.where(region.pressure > 0, region.pressure, np.nan)
    extent = (-reach, reach, -reach, reach)
    image = axes.imshow(seen, cmap="viridis", vmin=0, vmax=1, extent=extent, interpolation="nearest")
    for outline in region.outlines:
        axes.plot(*outline, color="0.15", linewidth=0.9)
    drawing.frameless(axes, xlim=(-_reach(region), _reach(region)), ylim=(-1.3, 1.6))
    return image
