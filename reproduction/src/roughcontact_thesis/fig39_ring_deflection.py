"""Figure 39: the deflection of the surface under a ring-shaped force."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.validation import Array
from roughcontact_thesis import drawing
from roughcontact_thesis.ruling import exactly
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["Deflection", "case", "draw", "verdicts"]

TITLE = "deflection under a ring-shaped force, and its logarithmic approximation"
REACH = 3.0  # r/a up to which it is drawn
WIDTH = 2e-4  # of the loaded ring over its radius
GROWTH = 0.04  # width of another ring over its distance from the loaded one
NEAREST = 4e-3  # |r/a - 1| from which on the widths change the deflection by less than 3e-5
SEED = 0
CHOSEN = (
    f"computed: a load on a ring {WIDTH:g} a wide",
    "approximation: eq. A.21, drawn far beyond the vicinity of the ring, for which it was derived",
)
SIZE = (drawing.PAGE, 2.9)

_COMPUTED, _LAW = drawing.COLOURS[:2]


@dataclass(frozen=True, slots=True)
class Deflection:
    """Deflections over F/(2 a E*) at distances from the axis.

    Attributes
    ----------
    radius : array, shape (n,)
        r/a, means of rings.
    computed : array, shape (n,)
        Mean over each ring.
    """

    radius: Array
    computed: Array

    @property
    def logarithm(self) -> Array:
        """Eq. A.21, (2/pi^2) ln(8/|r/a - 1|)."""
        return np.asarray(2 / np.pi**2 * np.log(8 / np.abs(self.radius - 1)))

    @property
    def error(self) -> Array:
        """Relative error of eq. A.21."""
        return np.asarray(self.logarithm / self.computed - 1)


def case(seed: int = SEED) -> Deflection:
    """Return the deflection by the half-space's rings; nothing is random, the seed is not used."""
    inside, outside = 1 - _distances(1.0)[::-1], 1 + _distances(REACH - 1)
    grid = rc.RadialGrid(np.concatenate([inside, outside]))
    loaded = int(np.searchsorted(grid.radii, 1.0 - WIDTH / 4))
    pressure = np.zeros(grid.shape)
    pressure[loaded] = 1 / grid.cell_area[loaded]  # a unit force
    others = np.arange(grid.size) != loaded
    return Deflection(grid.radii[others], 2 * rc.ring(grid, 1.0).apply(pressure)[others])


def draw(figure: Figure, data: Deflection) -> None:
    """Draw deflection and approximation (a), and the error of the approximation (b)."""
    left, right = drawing.panels(figure, 1, 2, width_ratios=(1.25, 1))
    left.plot(data.radius, data.computed, color=_COMPUTED, linewidth=1.6, label="computed")
    left.plot(data.radius, data.logarithm, "--", color=_LAW, label="eq. A.21")
    left.axvline(1.0, color="0.6", linewidth=0.8, linestyle=":")
    words = r"deflection $u_z\,\cdot 2 a E^*/F_N$"
    drawing.label(left, r"$r\,/\,a$", words, xlim=(0, REACH), ylim=(0, 2))
    for side, style, name in ((-1, "-", "inside"), (1, "--", "outside")):
        there = (side * (data.radius - 1) >= NEAREST) & (side * (data.radius - 1) <= 1)
        distance, error = np.abs(data.radius[there] - 1), np.abs(data.error[there])
        right.plot(distance, error, style, color=_COMPUTED, linewidth=1.4, label=name)
    drawing.label(right, r"$|r/a - 1|$", "relative error of eq. A.21", **drawing.LOG)
    left.legend()
    right.legend()


def verdicts(data: Deflection) -> Verdicts:
    """Return the error of the approximation at some distances from the ring."""
    distance, outside = np.abs(data.radius - 1), data.radius > 1
    errors = [float(np.interp(x, distance[outside], np.abs(data.error[outside]))) for x in (0.1, 0.01, 0.005)]
    centre = float(data.computed[0])
    yield Verdict(
        "near the ring the deflection is logarithmic",
        "In the vicinity of r = a there is a logarithmic singularity, which can be approximated as",
        "section A.1.1, eq. A.21",
        f"off by {errors[0]:.1%}, {errors[1]:.2%} and {errors[2]:.2%} outside, at |r/a - 1| = 0.1, 0.01 and 0.005; in "
        f"the centre the deflection is {centre:.4f}, {2 / np.pi:.4f} by eq. A.19",
        exactly(bool(errors[1] < 0.01 and errors[2] < errors[1] < errors[0]), "1% at 0.01, and falling"),
        "method",
    )


def _distances(far: float) -> Array:
    """Return the distances from the ring's middle of circles that bound rings, from its edge to `far`."""
    places = [WIDTH / 2]
    while places[-1] < far:
        places.append(places[-1] + max(1.5e-4 * (1 + places[-1]), GROWTH * places[-1]))
    return np.array([*places[:-1], far])
