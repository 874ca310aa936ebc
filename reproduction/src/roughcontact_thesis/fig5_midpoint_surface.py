"""Figure 5: a fractal surface by random midpoint displacement, its two half steps and its stages."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.plot.view import surface_view
from roughcontact.validation import Array
from roughcontact_thesis import drawing
from roughcontact_thesis.ruling import exceeds
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["case", "draw", "verdicts"]

TITLE = "random midpoint displacement of a surface, half steps and stages"
HURST = 0.8
RELATIVE = 0.25  # d over the side
LENGTH = 1.0
LEVELS = (1, 3, 7)
SEED = 6
DRAWS = 200  # surfaces whose waves are counted
CHOSEN = (
    f"H = {HURST:g}, d = {RELATIVE:g} L",
    "the same d in both half steps",
    "edges on the border: the mean of their three neighbours",
    f"surfaces of {', '.join(f'{2**n + 1}²' for n in LEVELS)} nodes",
)
SIZE = (drawing.PAGE, 4.8)


# Of two squares a side: where the nodes of a half step lie.
_HALVES = np.indices((5, 5)).reshape(2, -1)
_CENTRES, _EDGES = (_HALVES[:, (_HALVES % 2).sum(axis=0) == odd] / 2 for odd in (2, 1))
_CENTRE, _EDGE, _DIAMOND, _NEXT = "#c8290b", "#0047b2", "#9ccbee", "#8fd08f"


def case(seed: int = SEED) -> tuple[rc.Surface, ...]:
    """Return the surface after each of `LEVELS` levels; each holds the nodes of the one before."""
    grids = (rc.Grid((2**level + 1,) * 2, (LENGTH / 2**level,) * 2) for level in LEVELS)
    return tuple(
        rc.midpoint_surface(grid, HURST, np.random.default_rng(seed), displacement=RELATIVE * LENGTH)
        for grid in grids
    )


def draw(figure: Figure, data: tuple[rc.Surface, ...]) -> None:
    """Draw the half steps (a) to (c) seen from above, and the surface after some levels."""
    steps = (
        ("(a) centres of the squares", _square_step),
        ("(b) middles of the diamonds", _diamond_step),
        ("(c) squares of the next level", _next_level),
    )
    for place, (words, step) in enumerate(steps, start=1):
        axes = figure.add_subplot(2, 3, place)
        _squares(axes)
        step(axes)
        axes.set_title(words)
    for place, (letter, level, surface) in enumerate(zip("def", LEVELS, data, strict=True), start=4):
        view = figure.add_subplot(2, 3, place, projection="3d")
        surface_view(surface, view, frame=False)
        view.set_title(f"({letter}) {level} {'level' if level == 1 else 'levels'}", loc="left")


def _squares(axes: Axes) -> None:
    """Draw the squares of a level: two a side, so that diamonds between neighbours are seen."""
    for at in (0, 1, 2):
        axes.plot((0, 2), (at, at), color="black", zorder=2)
        axes.plot((at, at), (0, 2), color="black", zorder=2)
    axes.plot(*np.indices((3, 3)).reshape(2, -1), "s", color="black", zorder=3)
    axes.set(xlim=(-0.15, 2.15), ylim=(-0.15, 2.15), aspect="equal")
    axes.set_axis_off()


def _square_step(axes: Axes) -> None:
    for x, y in _CENTRES.T:
        for right, up in ((-1, -1), (-1, 1), (1, -1), (1, 1)):
            start, end = ((x + far * right, y + far * up) for far in (0.45, 0.1))
            drawing.arrow(axes, start, end, color=_CENTRE, linewidth=0.8, alpha=0.6)
    _nodes(axes, _CENTRES)


def _diamond_step(axes: Axes) -> None:
    for x, y in _EDGES.T:
        inside = 0 < x < 2 and 0 < y < 2
        # On the border the diamond lacks its fourth corner.
        diamond = np.clip([(x - 0.5, y), (x, y - 0.5), (x + 0.5, y), (x, y + 0.5)], 0, 2)
        shade = 0.8 if inside else 0.4
        axes.fill(*diamond.T, facecolor=_DIAMOND, edgecolor="white", linewidth=1.2, alpha=shade, zorder=1)
    _nodes(axes, _CENTRES, _EDGES)


def _next_level(axes: Axes) -> None:
    for x, y in np.indices((4, 4)).reshape(2, -1).T / 2:
        corners = np.array([(x, y), (x + 0.5, y), (x + 0.5, y + 0.5), (x, y + 0.5)])
        axes.fill(*corners.T, facecolor=_NEXT, edgecolor="#2e7d32", linewidth=0.9, alpha=0.55, zorder=1)
    _nodes(axes, _CENTRES, _EDGES)


def _nodes(axes: Axes, centres: Array, edges: Array | None = None) -> None:
    if edges is not None:
        axes.plot(*edges, "o", color=_EDGE, markersize=5, zorder=4)
    axes.plot(*centres, "o", color=_CENTRE, markersize=9, zorder=4)


def verdicts(data: tuple[rc.Surface, ...]) -> Verdicts:
    """Return how much the power of long and of short waves scatters among surfaces of this kind."""
    grid = rc.Grid((65, 65), 1 / 64)
    # Mean squares of the second difference, which knows waves about as long as it is, at L/2 and at one cell.
    squares = np.array([[_bend(grid, seed, lag) for lag in (32, 1)] for seed in range(DRAWS)])
    scatter = squares.std(axis=0, ddof=1) / squares.mean(axis=0)
    ratio = float(scatter[0] / scatter[1])
    yield Verdict(
        "the long waves of random midpoint surfaces scatter greatly",
        "the lower frequency amplitudes are subject to great scattering.",
        "section 2.3.1",
        f"the mean square of the second difference over half the side scatters by {scatter[0]:.0%} of its mean among "
        f"{DRAWS} surfaces, over a cell by {scatter[1]:.0%}; amplitudes of the inverse Fourier transform are fixed",
        # Each scatter is known to 1/sqrt(2 n) of itself.
        exceeds(ratio, ratio / np.sqrt(DRAWS), 3.0, ".1f", "three times that of the short waves"),
        "method",
    )


def _bend(grid: rc.Grid, seed: int, lag: int) -> float:
    """Return the mean square of the second difference of one surface over a number of cells."""
    heights = rc.midpoint_surface(
        grid, HURST, np.random.default_rng(seed), displacement=RELATIVE * LENGTH
    ).heights
    return float(np.mean((heights[2 * lag :] - 2 * heights[lag:-lag] + heights[: -2 * lag]) ** 2))
