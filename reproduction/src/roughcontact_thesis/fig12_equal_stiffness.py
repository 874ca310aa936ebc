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
from roughcontact.halfspace.influence.love import love
from roughcontact.theory.spheres_and_punches import punch
from roughcontact.validation import Array, Mask
from roughcontact_thesis import bounds, drawing
from roughcontact_thesis.ruling import exactly, in_part
from roughcontact_thesis.verdict import Verdict, Verdicts

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
SIZE = (drawing.PAGE, 2.2)

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
    """Return the stiffness of a disc, the bound of a square, one cell's, two discs', and two shape factors."""
    one, two, *angular = data
    stiffnesses = punch.square(1.0, 1.0), punch.triangle(1.0, 1.0)
    exact = map(punch.shape_factor, stiffnesses, (1.0, 1.0), (1.0, math.sqrt(3) / 4))
    apart = float(punch.two_discs(1.0, two.size, SPACING) / (2 * punch.disc(1.0, two.size)))
    far = float(brentq(lambda s: float(punch.two_discs(1.0, 1.0, s)) - 0.99 * 4, 3.0, 1e3))
    bound = float(punch.square(1.0, 1.0))
    yield _same_circle()
    yield _bound(bound)
    yield _one_cell(bound)
    yield Verdict(
        "two distant circles act in parallel",
        "Example (b) shows two distant circles which act in parallel.",
        "section 4, fig. 12",
        f"{apart:.3f} of the sum of their stiffnesses {SPACING:g} a apart, 0.99 of it {far:.0f} of their radii apart",
        in_part(f"from {far:.0f} radii apart on", "1%", f"{apart - 1:+.1%} at {SPACING:g} a"),
        "method",
    )
    for region, factor in zip(angular, map(float, exact), strict=True):
        printed, source = _PRINTED[region.name]
        yield Verdict(
            f"stiffness of a {region.name} over that of a disc of its area",
            f"{printed:.3f}",
            source,
            f"{factor:.4f}, and {region.shape_factor / one.shape_factor:.3f} from {CELLS[0]}² and {CELLS[1]}² cells",
            exactly(abs(factor / printed - 1) < 5e-4, "its last digit", f"{printed / factor - 1:+.1%}"),
            "misprint",
        )


def _same_circle() -> Verdict:
    """Return whether bodies of several exponents are equally stiff when they touch in one circle (eq. 4.6)."""
    rings = rc.RadialGrid.uniform(200, 2.0)
    shares = []
    for exponent in (1.0, 2.0, 4.0):
        body = rc.RadialProfile(-(rings.radii**exponent), rings)
        depths = np.array([0.5, 0.5 * (1 + 1e-4)])
        low, high = (rc.press(body, 1.0, depth=float(each), operator=rc.ring(rings, 1.0)) for each in depths)
        radius = float(rings.edges[int(low.contact.sum())])
        shares.append((high.force - low.force) / (high.depth - low.depth) / (2 * radius))
    return Verdict(
        "the stiffness of a circular contact is 2 E* a, whatever indenter made it",
        "Every time it is a circle, eq. 4.6 applies. For example, any rotational symmetric indenter",
        "section 4.1, eq. 4.6",
        f"dF/dd of indenters r, r² and r⁴ by rings is {', '.join(f'{each:.3f}' for each in shares)} of 2 E* a",
        exactly(max(abs(each - 1) for each in shares) < 0.02, "2%: the width of a ring over the radius"),
        "method",
    )


def _bound(square: float) -> Verdict:
    """Return whether a region within a square can be stiffer than the square (eq. 4.7)."""
    n, rng = 24, np.random.default_rng(0)
    grid = rc.Grid((n, n), 1 / n)
    whole = rc.contact_stiffness(np.ones(grid.shape, dtype=bool), grid, 1.0)
    parts = [
        rc.contact_stiffness(rng.random(grid.shape) < part, grid, 1.0) / whole
        for part in (0.2, 0.5, 0.8, 0.95)
    ]
    printed = 2 * _PRINTED["square"][0] / math.sqrt(math.pi)
    return Verdict(
        "no region within a square is stiffer than the square",
        "A contact region that is within a square of length L cannot be associated with a stiffness that exceeds",
        "section 4.2, eq. 4.7",
        f"regions with 20 to 95 % of its cells are {min(parts):.2f} to {max(parts):.3f} times as stiff as the square; "
        f"the square is {square:.4f} E* L, the number printed {printed:.4f}",
        exactly(
            max(parts) < 1 and abs(printed / square - 1) < 0.02,
            "2% of the bound",
            f"{printed / square - 1:+.1%}",
        ),
        "method",
    )


def _one_cell(square: float) -> Verdict:
    """Return the stiffness of one cell under uniform pressure over that of a rigid square (eq. 4.16)."""
    inside = float(love(0.0, 0.0, 1.0, 1.0))
    share = float(bounds.cell(1.0, 1.0)) / square
    printed = float(bounds.king_full_contact_stiffness(1.0, 1.0))
    return Verdict(
        "a single cell is 0.78 times as stiff as a rigid square of its size, K00 = 3.5255",
        "This value differs from the stiffness of a square indenter (eq. 4.14) by factor 0.78.",
        "section 4.3, eq. 4.16",
        f"K00 = {inside:.4f}; {share:.4f} of the rigid square, {share * square / printed:.4f} of the number in "
        "eq. 4.14",
        exactly(abs(share - 0.78) < 0.01, "0.01", f"{share - 0.78:+.4f}"),
        "method",
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
