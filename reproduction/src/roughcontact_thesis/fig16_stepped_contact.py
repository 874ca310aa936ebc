"""Figure 16: the stepped indenter pressed against a wall, contact area and deformation step by step."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.validation import Array
from roughcontact_thesis import drawing
from roughcontact_thesis.ruling import exactly
from roughcontact_thesis.stepped_body import INDENTER, MODULUS, full_steps, stepped_body
from roughcontact_thesis.verdict import Verdict, Verdicts, series

__all__ = ["case", "draw", "verdicts"]

TITLE = "the stepped indenter against a wall: contact areas and deformations"
COUNT = 3
SEED = 0
CHOSEN = (
    f"C = {INDENTER.ratio:g}, H = {INDENTER.hurst:g} as in figure 15",
    "each state just before the next cylinder touches",
    "the deformation is computed and to scale with the heights of the cylinders",
)
SIZE = (drawing.PAGE, 5.6)

_LOW, _HIGH = -5.0, 6.5  # heights shown


def case(seed: int = SEED) -> tuple[rc.Solution, ...]:
    """Return the contact just before cylinders 1, 2 and 3 touch; nothing is random, the seed is not used."""
    body = stepped_body(INDENTER, COUNT + 1)
    return full_steps(body, rc.ring(body.grid, MODULUS), COUNT)


def draw(figure: Figure, data: tuple[rc.Solution, ...]) -> None:
    """Draw a row a step: the contact seen from above, and a cut through the deformed body below its wall."""
    panels = figure.subplots(len(data), 2, width_ratios=(1, 2.6))
    for letter, (left, right), state in zip("abc", panels, data, strict=True):
        _area(left, state)
        _cut(right, state)
        left.set_ylabel(f"({letter})", rotation=0, ha="right", va="center")
        right.set(xlabel=r"$x\,/\,r_0$", ylabel=r"height / $h_0$")
    for axes in panels[:-1, 1]:
        axes.set_xlabel("")
        axes.tick_params(labelbottom=False)
    panels[0, 0].set_title("contact area", loc="center")
    panels[0, 1].set_title("body pressed up against the wall; dotted: undeformed", loc="center")


def verdicts(data: tuple[rc.Solution, ...]) -> Verdicts:
    """Return whether the largest radius in contact alone decides about the stiffness."""
    radii = INDENTER.radii(len(data))
    shares = [state.stiffness / (2 * MODULUS * r) for state, r in zip(data, radii, strict=True)]
    open_shares = [1 - state.contact_area / (math.pi * r**2) for state, r in zip(data, radii, strict=True)]
    yield Verdict(
        "the stiffness of the stepped body is that of the largest radius in contact",
        "in each step, the contact stiffness is only determined by the largest radius in contact and proportional to "
        "the same",
        "section 4.4.1",
        f"{series(shares, '.2f')} of 2 E* r_n for n = 0, 1, 2, though {series(open_shares, '.0%')} of the disc do not "
        f"touch; the next cylinder touches at a depth of {data[0].depth:.3f} h_0 for n = 0, as its rim sinks",
        exactly(bool(min(shares) > 0.95), "5%", f"{min(shares) - 1:+.1%}"),
        "method",
    )


def _area(axes: Axes, state: rc.Solution) -> None:
    edges = stepped_body(INDENTER, COUNT + 1).grid.edges
    reach = INDENTER.radii(COUNT)[-1] * 1.1
    angle = np.linspace(0, 2 * math.pi, 181)
    circle = np.stack([np.cos(angle), np.sin(angle)])
    for inner, outer in _runs(state.contact, edges):
        axes.fill(*np.hstack([outer * circle, inner * circle[:, ::-1]]), color=drawing.LINES, linewidth=0)
    for radius in INDENTER.radii(COUNT):
        axes.plot(*(radius * circle), color="0.4", linewidth=0.6)
    drawing.frameless(axes, xlim=(-reach, reach), ylim=(-reach, reach))


def _runs(contact: npt.NDArray[np.bool_], edges: Array) -> list[tuple[float, float]]:
    """Return the radii between which rings touch without a break."""
    turns = np.flatnonzero(np.diff(np.concatenate([[False], contact, [False]]).astype(int)))
    return list(zip(edges[turns[::2]].tolist(), edges[turns[1::2]].tolist(), strict=True))


def _cut(axes: Axes, state: rc.Solution) -> None:
    body = stepped_body(INDENTER, COUNT + 1)
    edges = body.grid.edges
    # The displacement is smooth across the rims of the cylinders, the height is not.
    sunk = np.interp(edges, body.grid.radii, state.displacement)
    r, untouched = _both_ends(edges), np.repeat(body.heights + state.depth, 2)
    surface = untouched - _both_ends(sunk)
    x = np.concatenate([-r[::-1], r])
    y, untouched = (np.concatenate([part[::-1], part]) for part in (surface, untouched))
    axes.fill_between(x, _LOW, y, color="#cfe3f2", linewidth=0)
    axes.plot(x, y, color=drawing.COLOURS[0])
    axes.plot(x, untouched, ":", color="0.35", linewidth=0.9)
    axes.axhspan(0, _HIGH, facecolor="0.75", alpha=0.35, hatch="////", edgecolor="0.6", linewidth=0)
    axes.axhline(0, color="0.25", linewidth=1.0)
    for inner, outer in _runs(state.contact, edges):
        for span in ((inner, outer), (-inner, -outer)):
            axes.plot(span, (0, 0), color=drawing.LINES, linewidth=2.6, solid_capstyle="butt")
    axes.set(xlim=(-edges[-1], edges[-1]), ylim=(_LOW, _HIGH))


def _both_ends(values: Array) -> Array:
    """Return the values at the inner and the outer circle of every ring."""
    return np.asarray(np.repeat(values, 2)[1:-1])
