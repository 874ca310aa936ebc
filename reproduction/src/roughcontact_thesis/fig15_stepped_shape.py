"""Figure 15: the stepped indenter, the simplest body that follows the fractal law."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughcontact.theory.springs.stepped import SteppedIndenter
from roughcontact.validation import Array
from roughcontact_thesis import drawing
from roughcontact_thesis.ruling import exactly
from roughcontact_thesis.stepped_body import INDENTER
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["Shape", "case", "draw", "verdicts"]

TITLE = "cylinders whose radii and heights follow the fractal law, C = 2, H = 0.5"
COUNT = 4
SEED = 0
CHOSEN = (f"{COUNT} cylinders", "r0 and h0 as units of length and height")
SIZE = (drawing.COLUMN, 2.4)

_BODY, _EDGE, _SMOOTH = "#cfe3f2", "#0072b2", "#d55e00"
_ROOM = {"facecolor": "white", "edgecolor": "none", "pad": 0.5}  # behind a label that a line would cross


@dataclass(frozen=True, slots=True)
class Shape:
    """The indenter, and the smooth one that it resembles.

    Attributes
    ----------
    indenter : SteppedIndenter
    coefficient : float
        Q of the smooth indenter z = Q r^H [m^(1-H)].
    apex : float
        Height of its tip above the highest cylinder [m].
    """

    indenter: SteppedIndenter
    coefficient: float
    apex: float

    def depth(self, radius: Array) -> Array:
        """Return how far the smooth indenter lies below the highest cylinder [m]."""
        return np.asarray(self.coefficient * radius**self.indenter.hurst - self.apex)

    @property
    def rims(self) -> tuple[Array, Array]:
        """Radii of the cylinders and depths of their upper rims below the highest [m]."""
        tops = np.concatenate([[0.0], np.cumsum(self.indenter.heights(COUNT - 1))])
        return self.indenter.radii(COUNT), tops


def case(seed: int = SEED) -> Shape:
    """Return the cylinders and the smooth indenter through their rims; nothing is random, the seed is not used."""
    # The depth of rim n is h0 (C^(Hn) - 1)/(C^H - 1): a geometric sum.
    apex = INDENTER.height / (INDENTER.ratio**INDENTER.hurst - 1)
    return Shape(INDENTER, apex / INDENTER.radius**INDENTER.hurst, apex)


def draw(figure: Figure, data: Shape) -> None:
    """Draw a cut through the axis, and the smooth indenter through the upper rims."""
    axes = figure.subplots()
    radii, tops = data.rims
    heights = data.indenter.heights(COUNT)
    bottom = -float(tops[-1] + heights[-1])
    for n, (radius, top) in enumerate(zip(radii, tops, strict=True)):
        low = -float(top + heights[n])
        x, y = [-radius, -radius, radius, radius], [low, -top, -top, low]
        axes.fill(x, y, color=_BODY, linewidth=0, zorder=1)
        axes.plot(x, y, color=_EDGE, linewidth=1.4, zorder=3)
        axes.plot((-radius, radius), (low, low), color=_EDGE, linewidth=0.6, alpha=0.5, zorder=2)
        _radius(axes, n, float(radius), (-top + low) / 2)
        _height(axes, n, float(radius), (low, -float(top)))
    r = np.linspace(-radii[-1], radii[-1], 1601)
    axes.plot(r, -data.depth(np.abs(r)), "--", color=_SMOOTH, zorder=4, label=r"$z \sim r^H$")
    axes.set(xlim=(-radii[-1] * 1.04, radii[-1] * 1.16), ylim=(bottom, data.apex * 1.08))
    axes.set(xlabel=r"$x\,/\,r_0$", ylabel=r"height / $h_0$")
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(loc="upper left")


def verdicts(data: Shape) -> Verdicts:
    """Return whether the cylinders resemble the smooth indenter of the same exponent."""
    radii, tops = data.rims
    furthest = float(np.abs(data.depth(radii) - tops).max() / tops[-1])
    yield Verdict(
        "the stepped body resembles a smooth indenter r^H",
        "the shape of the indenter shown in fig. 15 is actually very similar to a smooth indenter z = r^H.",
        "section 4.4.1",
        f"the upper rims lie on it within {max(furthest, 1e-15):.0e}, its tip {data.apex:.3f} h0 above the highest "
        "cylinder",
        exactly(bool(furthest < 1e-12), "the upper rims on it, within rounding"),
        "method",
    )


def _radius(axes: Axes, number: int, radius: float, height: float) -> None:
    drawing.arrow(axes, (0, height), (radius, height), linewidth=0.8)
    axes.text(radius / 2, height, f"$r_{number}$", ha="center", va="bottom", zorder=5)


def _height(axes: Axes, number: int, radius: float, ends: tuple[float, float]) -> None:
    place = radius + 0.18
    drawing.arrow(axes, (place, ends[1]), (place, ends[0]), "<->", linewidth=0.8)
    axes.text(place + 0.12, sum(ends) / 2, f"$h_{number}$", va="center", bbox=_ROOM, zorder=5)
