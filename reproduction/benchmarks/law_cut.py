"""The stiffness of a smooth crest that the border of a map cuts, and what the cut adds to the mean over maps.

    python reproduction/benchmarks/law_cut.py   # writes docs/data/law/cut*.csv and prints the errors

**What is held.** The force F. a is Hertz's contact radius of the whole crest under this force, F = 4/3 E* a^3/R.
The contact of a cut crest is no disc, and its size is not a. The apex lies at c = x a from a straight
border. s(x) is k/k_Hertz at the same force, with k_Hertz = 2 E* a. There are two cuts:

* out of a period: the part of the crest beyond the border lies at the opposite border, far away. Both pieces
  share the force and one approach of the rigid plane.
* out of a larger surface: the part beyond the border is missing. The apex is on the map.

**Pieces.** f(t) is the force on a piece over that on the whole crest, 4/3 E* sqrt(R) d^(3/2), both at the
depth d. The apex is at c = t sqrt(R d) from the border, and outside the piece if t < 0. Because c and sqrt(R d) are
the only lengths, f depends on t only. From t = 1, where the disc of contact reaches the border, f = 1. Up to
t = -sqrt(2), where the border is as low as the plane, f = 0. Pieces that are far apart do not deform each other.
Their force is that of the whole crest times phi(t) = f(t) + f(-t); for the second cut phi = f. With
F = 4/3 E* sqrt(R) d^(3/2) phi, dF/dd at constant c gives::

    x = t/phi^(1/3),   s = (phi - t phi'(t)/3)/phi^(1/3)

**The mean over maps.** The crest is anywhere in a square of side L with equal probability. It is closer than
x a to one of the four borders with the probability 1 - (1 - 2 x a/L)^2 = 4 x a/L + O(a^2/L^2); corners are of
second order. The mean stiffness at one force, over that of a crest in the middle, is therefore ::

    k_all/k_mid = 1 + (4 a/L) int_0^sqrt(2) (s(x) - 1) dx + O(a^2/L^2)

**Errors.** Forces converge with the first power of the size of a cell, because the pressure is singular at the
border. They are extrapolated from two grids. The error is the difference from the extrapolation of the next
coarser pair, plus the difference if every second t is left out.

**Maps of finite size.** `on_map` computes s on a map of side L. Each of two equal pieces is lowered by the
force F/2 of the other piece at the distance L, by F/(2 pi E* L). Therefore 1/s = 1/s(0) + a/(pi L) +
O(a^2/L^2). `added` is the mean over all places on such a map, with its corners.
"""

from __future__ import annotations

import csv
from fractions import Fraction

import law_peer
import numpy as np
from law_ensembles import ROOT, STUDIES
from law_tables import Table, comma_separated
from scipy.interpolate import CubicSpline, PchipInterpolator

import roughcontact as rc
from roughcontact.study.study import Study
from roughcontact.study.task import generator
from roughcontact.validation import Array
from roughcontact_thesis.crest_case import CASE, CrestParameters

DATA = ROOT / "docs" / "data" / "law"
REACH = 2**0.5  # x and -t from which nothing is cut
ANGLES = np.linspace(-np.pi / 2, np.pi / 4, 55)  # t = sqrt(2) sin(angle), denser where f ends with a power
CELLS = (128, 256, 512)  # a side of a piece
PLACES = np.append(np.arange(0, 1.36, 0.05), [1.38, 1.4, 1.41, REACH])
PERIOD, LARGER = CUTS = "out of a period", "out of a larger surface"
Curve = tuple[Array, Array]  # x and s(x)

WIDTHS = {4: 128, 8: 256, 16: 512, 32: 1024}  # L/a and the cells of the map: 32 a contact radius
SOLVED_AGAIN = (8, 16)  # by the other solver


def piece_force(place: float, cells: int) -> float:
    """Return f(t) on a grid that covers the part of a piece above the plane, with `cells` cells a side."""
    width, half = (
        REACH + place,
        (2 - min(place, 0) ** 2) ** 0.5,
    )  # in contact radii sqrt(R d) of the whole crest
    middles = (np.arange(cells) + 0.5) / cells
    heights = -((width * middles - place) ** 2 + (half * (2 * middles[:, np.newaxis] - 1)) ** 2) / 2
    piece = rc.Surface(heights, rc.Grid(heights.shape, (2 * half / cells, width / cells)))
    return 3 / 4 * rc.press(piece, 1.0, depth=1 + heights.max()).force


def forces(cells: int, angles: Array = ANGLES) -> Array:
    """Return f at all angles. Its ends are exact."""
    return np.array([0, *(piece_force(REACH * np.sin(angle), cells) for angle in angles[1:-1]), 1])


def curves(angles: Array, found: Array) -> dict[str, Curve]:
    """Return x and s(x) of both cuts from f at some angles."""
    share = CubicSpline(angles, found, bc_type="clamped")
    angle = np.linspace(0, np.pi / 2, 2000, endpoint=False)
    inner, outer = np.minimum(angle, np.pi / 4), -angle  # beyond t = 1, f is 1 and has no slope
    one, slope = share(inner), share(inner, 1)
    return {
        PERIOD: _curve(angle, one + share(outer), slope - share(outer, 1)),
        LARGER: _curve(angle, one, slope),
    }


def _curve(angle: Array, force: Array, slope: Array) -> Curve:
    """Return x and s(x) from phi and its derivative by the angle, with their end at sqrt(2)."""
    root = np.cbrt(force)
    x, s = REACH * np.sin(angle) / root, (force - np.tan(angle) * slope / 3) / root
    return np.append(x, REACH), np.append(s, 1.0)


def integral(curve: Curve) -> float:
    """Return the integral of s(x) - 1 from 0 to sqrt(2)."""
    return float(np.trapezoid(curve[1] - 1, curve[0]))


def computed() -> tuple[Table, Table]:
    """Return s(x) of both cuts, and their integrals; print the order and the largest errors."""
    found = np.array([forces(cells) for cells in CELLS])
    steps = abs(np.diff(found, axis=0)).mean(axis=1)
    print(f"order of the forces: {np.log2(steps[0] / steps[1]):.2f}")
    coarse, fine = 2 * found[1:] - found[:-1]
    best, *others = curves(ANGLES, fine), curves(ANGLES, coarse), curves(ANGLES[::2], fine[::2])
    columns, rows = [np.char.mod("%.5g", PLACES)], []
    for cut in CUTS:
        ratios, *off = (np.interp(PLACES, *each[cut]) for each in (best, *others))
        errors = sum(abs(each - ratios) for each in off)
        print(
            f"{cut}: errors below {errors.max():.1e}, up to x = 1.4 below {errors[PLACES <= 1.4].max():.1e}"
        )
        columns.append(np.char.mod("%.4f", ratios))
        total, *off = (integral(each[cut]) for each in (best, *others))
        error = sum(abs(each - total) for each in off)
        rows.append([cut, f"{total:.5f} ± {error:.5f}", f"{4 * total:.5f} ± {4 * error:.5f}"])
    head = ["c/a", *(f"k/k_Hertz at one force, cut {cut}" for cut in CUTS)]
    return (head, np.transpose(columns).tolist()), (["cut", "integral of s - 1", "times 4"], rows)


def stiffness_ratio(place: Array, cut: str) -> Array:
    """Return s(x) of a cut, one of `CUTS`, interpolated in docs/data/law/cut.csv; 1 beyond sqrt(2)."""
    table = np.loadtxt(DATA / "cut.csv", delimiter=",", skiprows=1)
    x, s = table[:, 0], table[:, 1 + CUTS.index(cut)]
    found: Array = PchipInterpolator(x, s)(np.minimum(place, x[-1]))
    return found


def mean_effect(width: Array, cut: str) -> Array:
    """Return k_all/k_mid - 1 of a cut, one of `CUTS`, for a/L = `width`, at most 1/4, from docs/data/law/cut-*.csv."""
    name = dict(zip(CUTS, ("cut-period", "cut-larger"), strict=True))[cut]
    with (DATA / f"{name}.csv").open(encoding="utf-8") as file:
        rows = list(csv.reader(file))[1:]
    points = sorted((float(Fraction(first)), float(last)) for first, *_, last in rows)
    found: Array = width * PchipInterpolator(*np.transpose(points))(np.minimum(width, points[-1][0]))
    return found


def cut_map(width: float, cells: int, cut: str, *place: float) -> tuple[Array, float]:
    """Return heights and the force, for a/L = `width`, L = R = E* = 1.

    `place` holds the distances of the apex from the borders along both axes, over a; by default it is in the middle.
    """
    middles = (np.arange(cells) + 0.5) / cells
    along, across = (abs(middles - each * width) for each in (*place, 0.5 / width, 0.5 / width)[:2])
    if cut == PERIOD:
        along, across = np.minimum(along, 1 - along), np.minimum(across, 1 - across)
    return -(along**2 + across[:, np.newaxis] ** 2) / 2, 4 / 3 * width**3


def on_map(width: float, cells: int, cut: str, *place: float) -> float:
    """Return s on a map of side L, a/L = `width`."""
    heights, force = cut_map(width, cells, cut, *place)
    surface = rc.Surface(heights, rc.Grid(heights.shape, 1 / cells))
    return rc.press(surface, 1.0, force=force).stiffness / (2 * width)


def added(width: float, cells: int, cut: str, nodes: int = 8) -> float:
    """Return k_all/k_mid - 1 of maps of side L, a/L = `width`: four strips at the borders and four corners.

    Gauss' rule in the angle whose sine is x/sqrt(2), because s(x) - 1 ends like a root.
    """
    angles, weights = np.polynomial.legendre.leggauss(nodes)
    angles = np.pi / 4 * (1 + angles)
    x, w = REACH * np.sin(angles), np.pi / 4 * weights * REACH * np.cos(angles)
    strip = sum(one * (on_map(width, cells, cut, at) - 1) for at, one in zip(x, w, strict=True))
    pairs = [(i, j) for i in range(nodes) for j in range(i + 1)]
    corner = sum((1 + (i != j)) * w[i] * w[j] * (on_map(width, cells, cut, x[i], x[j]) - 1) for i, j in pairs)
    return float(4 * width * (1 - 2 * REACH * width) * strip + 4 * width**2 * corner)


def by_peer(heights: Array, force: float) -> float:
    """Return the stiffness of a map of side 1, E* = 1, by the other solver."""
    spacing = 1 / len(heights)
    displacement = law_peer.half_space(heights.shape, spacing, 1.0)
    contact = law_peer.pressed(displacement, heights, force, spacing**2) > 0
    return law_peer.stiffness(displacement, contact, spacing**2)


def limit(cut: str, first_order: float) -> Table:
    """Return s(0) for several a/L, by both solvers, its limit, and the mean over all places."""
    rows, found = [], []
    for inverse, cells in WIDTHS.items():
        width = 1 / inverse
        found.append(on_map(width, cells, cut, 0))
        again = (
            f"{by_peer(*cut_map(width, cells, cut, 0)) / (2 * width):.4f}" if inverse in SOLVED_AGAIN else "-"
        )
        mean = f"{added(width, cells, cut) / width:.2f}"
        rows.append([f"1/{inverse}", f"{cells}²", f"{found[-1]:.4f}", again, mean])
    end = 1 / np.polyfit([1 / inverse for inverse in WIDTHS], 1 / np.array(found), 2)[-1]
    rows.append(["0", "-", f"{end:.4f}", "-", f"{first_order:.2f}"])
    return ["a/L", "cells", "s(0)", "s(0), other solver", "(k_all/k_mid - 1) L/a"], rows


def member(points: int = 512) -> tuple[float, float]:
    """Return k/(E* L) of the first surface of E8 at H = 0.7 and the largest force, by both solvers."""
    study = Study.read(STUDIES / "e8-cut.toml")
    parameters = CrestParameters(**(dict(study.parameters) | {"points": points, "hurst": 0.7, "crest": 0.5}))
    record = CASE.run(parameters, generator(study.seed, 0))
    heights = parameters.roughness(generator(study.seed, 0)).heights
    return float(record["stiffness"][-1]), by_peer(heights, float(record["force"][-1]))


if __name__ == "__main__":
    ratios, integrals = computed()
    written = {"cut": ratios, "cut-integral": integrals}
    for name, cut, row in zip(("cut-period", "cut-larger"), CUTS, integrals[1], strict=True):
        written[name] = limit(cut, float(row[-1].split()[0]))
    for name, table in written.items():
        (DATA / f"{name}.csv").write_text(comma_separated(table), encoding="utf-8", newline="\n")
        print(comma_separated(table))
    print("k/(E* L) of a surface of E8, and by the other solver: {:.9f}, {:.9f}".format(*member()))
