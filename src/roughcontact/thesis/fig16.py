"""Figure 16: the stepped indenter pressed against a wall, contact area and deformation step by step."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from roughcontact.contact.solution import Solution
from roughcontact.halfspace.operators.build import ring
from roughcontact.plot.raster import LABEL, TICK
from roughcontact.thesis.stepped_body import INDENTER, MODULUS, full_steps, stepped_body
from roughcontact.thesis.verdict import Verdict

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["case", "draw", "verdicts"]

Array = npt.NDArray[np.float64]

TITLE = "the stepped indenter against a wall: contact areas and deformations"
COUNT = 3
SEED = 0
CHOSEN = (
    f"C = {INDENTER.ratio:g}, H = {INDENTER.hurst:g} as in figure 15",
    "each state just before the next cylinder touches",
    "the deformation is computed and to scale with the heights of the cylinders",
)
SIZE = (6.8, 5.6)

_CONTACT, _BODY, _EDGE, _WALL = "#c8290b", "#cfe3f2", "#0072b2", "0.75"
_LOW, _HIGH = -5.0, 6.5  # heights shown


def case(seed: int = SEED) -> tuple[Solution, ...]:
    """Return the contact just before cylinders 1, 2 and 3 touch; nothing is random, the seed is not used."""
    body = stepped_body(INDENTER, COUNT + 1)
    return full_steps(body, ring(body.grid, MODULUS), COUNT)


def draw(figure: Figure, data: tuple[Solution, ...]) -> None:
    """Draw a row a step: the contact seen from above, and a cut through the deformed body below its wall."""
    panels = figure.subplots(len(data), 2, width_ratios=(1, 2.6))
    for n, ((left, right), state) in enumerate(zip(panels, data, strict=True)):
        _area(left, state)
        _cut(right, state)
        left.set_ylabel(f"({'abc'[n]})", fontsize=LABEL, rotation=0, ha="right", va="center")
        last = n == len(data) - 1
        right.tick_params(labelsize=TICK, labelbottom=last)
        if last:
            right.set_xlabel(r"$x\,/\,r_0$", fontsize=LABEL)
        right.set_ylabel(r"height / $h_0$", fontsize=LABEL)
    panels[0, 0].set_title("contact area", fontsize=LABEL)
    panels[0, 1].set_title("body pressed up against the wall; dotted: undeformed", fontsize=LABEL)


def verdicts(data: tuple[Solution, ...]) -> tuple[Verdict, ...]:
    """Return whether the largest radius in contact alone decides about the stiffness."""
    radii = INDENTER.radii(len(data))
    shares = [state.stiffness / (2 * MODULUS * r) for state, r in zip(data, radii, strict=True)]
    open_shares = [1 - state.contact_area / (math.pi * r**2) for state, r in zip(data, radii, strict=True)]
    return (
        Verdict(
            "the stiffness is only determined by the largest radius in contact",
            "k_n = 2 E* r_n (eq. 4.22 with its factor of two)",
            f"{', '.join(f'{share:.2f}' for share in shares)} of it for n = 0, 1, 2, though "
            f"{', '.join(f'{share:.0%}' for share in open_shares)} of the disc do not touch",
            bool(min(shares) > 0.95),
        ),
        Verdict(
            "the wall reaches the next cylinder when the last one is pressed by its height",
            "d = h_0 for n = 0",
            f"d = {data[0].depth:.3f} h_0: the rim of the next cylinder has sunk by a third of d",
            bool(abs(data[0].depth / INDENTER.height - 1) < 0.05),
        ),
    )


def _area(axes: Axes, state: Solution) -> None:
    edges = stepped_body(INDENTER, COUNT + 1).grid.edges
    reach = INDENTER.radii(COUNT)[-1] * 1.1
    angle = np.linspace(0, 2 * math.pi, 181)
    for inner, outer in _runs(state.contact, edges):
        ways = [np.stack([r * np.cos(angle), r * np.sin(angle)]) for r in (outer, inner)]
        whole = np.concatenate([ways[0], ways[1][:, ::-1]], axis=1)
        axes.fill(*whole, color=_CONTACT, linewidth=0)
    for radius in INDENTER.radii(COUNT):
        axes.plot(radius * np.cos(angle), radius * np.sin(angle), color="0.4", linewidth=0.6)
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal", xticks=[], yticks=[])
    axes.spines[:].set_visible(False)


def _runs(contact: npt.NDArray[np.bool_], edges: Array) -> list[tuple[float, float]]:
    """Return the radii between which rings touch without a break."""
    turns = np.flatnonzero(np.diff(np.concatenate([[False], contact, [False]]).astype(int)))
    return [
        (float(edges[start]), float(edges[end])) for start, end in zip(turns[::2], turns[1::2], strict=True)
    ]


def _cut(axes: Axes, state: Solution) -> None:
    body = stepped_body(INDENTER, COUNT + 1)
    edges = body.grid.edges
    # The displacement is smooth across the rims of the cylinders, the height is not.
    sunk = np.interp(edges, body.grid.radii, state.displacement)
    r, untouched = _both_ends(edges), np.repeat(body.heights + state.depth, 2)
    surface = untouched - _both_ends(sunk)
    x = np.concatenate([-r[::-1], r])
    y, untouched = (np.concatenate([part[::-1], part]) for part in (surface, untouched))
    axes.fill_between(x, _LOW, y, color=_BODY, linewidth=0)
    axes.plot(x, y, color=_EDGE, linewidth=1.2)
    axes.plot(x, untouched, ":", color="0.35", linewidth=0.9)
    axes.axhspan(0, _HIGH, facecolor=_WALL, alpha=0.35, hatch="////", edgecolor="0.6", linewidth=0)
    axes.axhline(0, color="0.25", linewidth=1.0)
    for inner, outer in _runs(state.contact, edges):
        for side in (-1, 1):
            axes.plot(
                (side * inner, side * outer), (0, 0), color=_CONTACT, linewidth=2.6, solid_capstyle="butt"
            )
    axes.set(xlim=(-edges[-1], edges[-1]), ylim=(_LOW, _HIGH))


def _both_ends(values: Array) -> Array:
    """Return the values at the inner and the outer circle of every ring."""
    return np.asarray(np.repeat(values, 2)[1:-1])
