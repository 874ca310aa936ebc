"""How accurate every geometry is: errors on refined grids, observed order, extrapolated limit, exact value.

    python benchmarks/accuracy.py > docs/evidence/accuracy.md

Every number is computed here, E* = 1. Where the edge of a contact falls between cells, errors jump from grid to grid;
there each is the root mean square over contacts of sixteen slightly different sizes.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

import roughcontact as rc
from roughcontact.theory.spheres_and_punches import hertz, power_law_indenter, punch

Array = npt.NDArray[np.float64]
Shape = Callable[[Array], Array]
Method = Literal["fft", "multilevel", "moving-grid", "dense"]

SIZES = 1 + 0.15 * np.arange(16) / 16  # of a contact, so that its edge falls anywhere within a cell
SUMS = {"multilevel": 512, "moving-grid": 64, "dense": 64}  # cells a side up to which each is tried
NONE = 1e-15  # a relative difference that is rounding
SURFACE, RINGS, SPRINGS = (32, 64, 128, 256), (50, 100, 200, 400), (100, 200, 400, 800)


@dataclass(frozen=True)
class Case:
    """One closed form in one geometry.

    Parameters
    ----------
    name, geometry, quantity : str
        For the table.
    cells : sequence of int
        Cells across the domain, each number twice the one before.
    value, exact : callable
        What is computed, ``value(cells, size)``, and what is right, ``exact(size)``, for a contact whose size is
        multiplied by `size`. On a surface ``value(cells, size, method)`` sums in another way.
    edge : bool
        Whether the contact finds its own edge, between cells; else the grid is made to fit, and the limit is
        extrapolated by two more terms.
    """

    name: str
    geometry: str
    quantity: str
    cells: Sequence[int]
    value: Callable[..., float]
    exact: Callable[[float], float]
    edge: bool = True


def row(case: Case) -> str:
    """Return one row of the table."""
    sizes = SIZES if case.edge else np.ones(1)
    ratios = np.array([[case.value(n, s) / case.exact(s) for s in sizes] for n in case.cells])
    errors = np.sqrt(np.mean((ratios - 1) ** 2, axis=1))
    exact = case.exact(1.0)
    shown = ", ".join(f"{error:.1e}" for error in errors)
    head = (
        f"| {case.name} | {case.geometry} | {case.quantity} | {case.cells[0]} to {case.cells[-1]} | {shown} "
    )
    if errors[-1] < 1e-12:  # no error to see an order of
        return head + f"| exact | {exact:.8f} | {exact:.8f} |"
    # Over all grids: the edge's jumps average out; of fitted grids the last two tell.
    first = 0 if case.edge else -2
    order = math.log2(errors[first] / errors[-1]) / (len(errors) - 1 if case.edge else 1)
    limits = ratios.mean(axis=1)
    whole = max(1, round(order))
    for power in range(whole, whole + (1 if case.edge else len(limits) - 1)):
        limits = limits[1:] + np.diff(limits) / (2**power - 1)
    return head + f"| {order:.2f} | {limits[-1] * exact:.8f} | {exact:.8f} |"


def sums(case: Case) -> str:
    """Return one row of the table of the ways to sum: the largest relative difference to the transforms."""
    shown = []
    for method, most in SUMS.items():
        grids = [n for n in case.cells if n <= most]
        differences = [abs(case.value(n, 1.0, method) / case.value(n, 1.0) - 1) for n in grids]
        worst = max(differences)
        size = "none" if worst < NONE else f"{worst:.0e}"
        shown.append(f"{size} ({grids[0]} to {grids[-1]})" if len(grids) > 1 else f"{size} ({grids[0]})")
    return f"| {case.name} | {case.quantity} | {' | '.join(shown)} |"


def on_surface(
    fall: Callable[[Array, Array], Array], n: int, side: float, depth: float, method: Method = "fft"
) -> rc.Solution:
    """Press a body that falls from its apex in the middle of a square; the depth counts from the apex."""
    grid = rc.Grid((n, n), side / n)
    y, x = (c - side / 2 for c in grid.coordinates)
    heights = -fall(y[:, None], x)
    body = rc.half_space(grid, 1.0, method=method)
    return rc.press(rc.Surface(heights, grid), 1.0, depth=depth + heights.max(), operator=body)


def on_rings(fall: Shape, n: int, radius: float, depth: float) -> rc.Solution:
    """Press a body of revolution; the depth counts from the apex."""
    grid = rc.RadialGrid.uniform(n, radius)
    heights = -fall(grid.radii)
    return rc.press(rc.RadialProfile(heights, grid), 1.0, depth=depth + heights.max())


def on_springs(fall: Shape, n: int, half: float, depth: float) -> rc.Solution:
    """Press a transformed profile into springs; the depth counts from the apex."""
    grid = rc.Grid(n, 2 * half / n)
    heights = -fall(np.abs(grid.coordinates[0] - half))
    return rc.press(
        rc.Surface(heights, grid), 1.0, depth=depth + heights.max(), operator=rc.foundation(grid, 1.0)
    )


def flat(region: npt.NDArray[np.bool_], grid: rc.Grid, method: Method) -> float:
    """Return the stiffness of a flat region of cells."""
    body = rc.half_space(grid, 1.0, method=method)
    return rc.contact_stiffness(region, grid, 1.0, operator=body, tolerance=1e-9)


def flat_rings(inner: float, n: int) -> float:
    """Return the stiffness of a flat ring up to radius 1."""
    grid = rc.RadialGrid(np.linspace(inner, 1.0, n + 1))
    return rc.contact_stiffness(np.ones(n, bool), grid, 1.0)


def bodies_of_revolution() -> Iterator[Case]:
    """F = r^n/2 at the depth at which the contact has half the radius of the domain: force."""
    names = {2.0: "Hertz, point", 1.0: "cone", 0.5: "power law r^0.5", 4.0: "power law r^4"}
    for n, name in names.items():
        kappa = float(power_law_indenter.kappa(n))

        def fall(r: Array, n: float = n) -> Array:
            return r**n / 2

        def depth(s: float, n: float = n, kappa: float = kappa) -> float:
            return kappa / 2 * (0.5 * s) ** n

        def exact(s: float, n: float = n, kappa: float = kappa) -> float:
            return n / (n + 1) * kappa * (0.5 * s) ** (n + 1)

        def surface(
            cells: int, s: float, method: Method = "fft", f: Shape = fall, d: Callable[[float], float] = depth
        ) -> float:
            return on_surface(lambda y, x: f(np.hypot(y, x)), cells, 1.4, d(s), method).force

        def rings(cells: int, s: float, f: Shape = fall, d: Callable[[float], float] = depth) -> float:
            return on_rings(f, cells, 1.0, d(s)).force

        def springs(
            cells: int, s: float, f: Shape = fall, d: Callable[[float], float] = depth, k: float = kappa
        ) -> float:
            return on_springs(lambda x: k * f(x), cells, 1.0, d(s)).force

        yield Case(name, "surface", "force", SURFACE, surface, exact)
        yield Case(name, "ring", "force", RINGS, rings, exact)
        yield Case(name, "foundation", "force", SPRINGS, springs, exact)


def elliptic() -> Iterator[Case]:
    """Radii 1 and 2 under the depth that belongs to a unit force."""

    def contact(s: float) -> hertz.EllipticContact:
        return hertz.elliptic(modulus=1.0, radii=(1.0, 2.0), force=s**3)

    def force(cells: int, s: float, method: Method = "fft") -> float:
        depth = float(contact(s).depth)
        return on_surface(lambda y, x: x**2 / 2 + y**2 / 4, cells, 3.2, depth, method).force

    yield Case("Hertz, elliptic 1:2", "surface", "force", SURFACE, force, lambda s: s**3)


def cylinders() -> Iterator[Case]:
    """Press a cylinder under a unit force per length, and waves."""

    def half_width(s: float) -> float:
        return 2 / math.sqrt(math.pi) * s

    def cylinder(cells: int, s: float) -> float:
        grid = rc.Grid(cells, 4.0 / cells)
        heights = -((grid.coordinates[0] - 2) ** 2) / 2
        body = rc.line(grid, 1.0, reference_length=4.0)
        solution = rc.press(rc.Surface(heights, grid), 1.0, force=s**2, operator=body)
        return solution.depth - heights.max()

    def depth(s: float) -> float:
        return s**2 / math.pi * (2 * math.log(8.0 / half_width(s)) + 1)

    yield Case("Hertz, line", "line", "depth", SPRINGS, cylinder, depth)

    def strip(cells: int, s: float) -> float:
        grid = rc.Grid(cells, 2.0 / cells)
        body = rc.line(grid, 1.0, reference_length=8.0)
        return rc.contact_stiffness(np.ones(cells, bool), grid, 1.0, operator=body)

    yield Case(
        "flat strip", "line", "stiffness", SPRINGS, strip, lambda s: math.pi / (2 * math.log(16.0)), False
    )

    def mean_pressure(s: float) -> float:
        return 0.01 * math.pi * math.sin(math.pi * 0.2 * s) ** 2

    def largest(s: float) -> float:
        return 2 * 0.01 * math.pi * math.sin(math.pi * 0.2 * s)  # 2 p_mean / sin(pi a/l)

    def wave(cells: int, s: float, line: bool) -> float:
        grid = rc.Grid(cells, 1.0 / cells, True) if line else rc.Grid((4, cells), 1.0 / cells, True)
        x = grid.coordinates[-1] - 0.5
        heights = np.broadcast_to(0.01 * np.cos(2 * np.pi * x), grid.shape)
        body = rc.line(grid, 1.0) if line else None
        return float(
            rc.press(rc.Surface(heights, grid), 1.0, pressure=mean_pressure(s), operator=body).pressure.max()
        )

    # An odd number of cells would put one on the crest; with an even one the two at its sides stand for it.
    yield Case(
        "Westergaard", "periodic line", "largest pressure", SPRINGS, lambda n, s: wave(n, s, True), largest
    )
    yield Case(
        "Westergaard",
        "periodic surface",
        "largest pressure",
        SPRINGS,
        lambda n, s: wave(n, s, False),
        largest,
    )


def punches() -> Iterator[Case]:
    """Flat regions: stiffness."""
    yield Case("flat disc", "ring", "stiffness", RINGS, lambda n, s: flat_rings(0.0, n), lambda s: 2.0, False)

    def disc(n: int, s: float, method: Method = "fft") -> float:
        grid = rc.Grid((n, n), 2.2 / n)
        y, x = (c - 1.1 for c in grid.coordinates)
        return flat(np.hypot(y[:, None], x) < 0.9 * s, grid, method)

    yield Case("flat disc", "surface", "stiffness", SURFACE, disc, lambda s: 1.8 * s)
    yield Case(
        "flat disc", "foundation", "stiffness", SPRINGS,
        lambda n, s: rc.contact_stiffness(
            np.ones(n, bool), rc.Grid(n, 2.0 / n), 1.0, operator=rc.foundation(rc.Grid(n, 2.0 / n), 1.0)
        ),
        lambda s: 2.0, False,
    )  # fmt: skip
    square = float(punch.square(1.0, 1.0))
    yield Case(
        "square", "surface", "stiffness", SURFACE,
        lambda n, s, method="fft": flat(np.ones((n, n), bool), rc.Grid((n, n), 1 / n), method),
        lambda s: square, False,
    )  # fmt: skip
    triangle = float(punch.triangle(1.0, 1.0))
    height = math.sqrt(3) / 2

    def equilateral(n: int, s: float, method: Method = "fft") -> float:
        # Rows of a height that divides the triangle's, cells cut by its sides when their middle lies inside.
        grid = rc.Grid((n, n), (height / n, 1.0 / n))
        y, x = grid.coordinates[0][:, None], grid.coordinates[1] - 0.5
        return flat(np.abs(x) < (height - y) / (2 * height), grid, method)

    yield Case(
        "equilateral triangle", "surface", "stiffness", SURFACE, equilateral, lambda s: triangle, False
    )
    for inner in (0.5, 0.9):
        exact = float(punch.annulus(1.0, 1.0, inner))
        yield Case(
            f"annulus {inner:g}", "ring", "stiffness", RINGS,
            lambda n, s, b=inner: flat_rings(b, n), lambda s, k=exact: k, False,
        )  # fmt: skip

    two = float(punch.two_discs(1.0, 0.8, 3.2))

    def discs(n: int, s: float, method: Method = "fft") -> float:
        grid = rc.Grid((n // 2, n), 6.0 / n)
        y, x = (c - length / 2 for c, length in zip(grid.coordinates, grid.lengths, strict=True))
        return flat(np.hypot(y[:, None], np.abs(x) - 1.6 * s) < 0.8 * s, grid, method)

    yield Case("two discs, s = 4a", "surface", "stiffness", (64, 128, 256, 512), discs, lambda s: two * s)


def toroid() -> Iterator[Case]:
    """F = (r - 1)^2/2: a thin ring, whose asymptote holds to the order of its width (here 2 %)."""
    line = math.pi * 1e-4
    width = math.sqrt(4 * line / math.pi)

    def depth(n: int, s: float) -> float:
        grid = rc.RadialGrid(np.linspace(1 - 3 * width, 1 + 3 * width, n + 1))
        heights = -((grid.radii - 1) ** 2) / 2
        return (
            rc.press(rc.RadialProfile(heights, grid), 1.0, force=2 * math.pi * line * s).depth - heights.max()
        )

    def asymptote(s: float) -> float:
        return line * s / math.pi * (2 * math.log(16 / (width * math.sqrt(s))) + 1)

    yield Case("toroid, first term in c/R", "ring", "depth", RINGS, depth, asymptote)


HEAD = """# Accuracy

How far is each geometry from the closed forms, and how does the error fall as the grid is refined? The page is
written by `python benchmarks/accuracy.py > docs/evidence/accuracy.md`, with E* = 1. Its errors are discretisation
errors. A certificate bounds the residual of the discrete problem, which is far smaller.

All errors are relative. The columns are computed in two ways:

* If the edge of the contact is part of the solution, each error is the root mean square over sixteen contacts of
  slightly different sizes. A single error would jump with the place of the edge within a cell. The order is that from
  the first grid to the last. The limit is one step of Richardson's extrapolation of the mean.
* If the grid fits a flat region, the error has an expansion in powers of the cell. The limit then uses all terms that
  the four grids give.

| body | geometry | quantity | cells | errors | order | limit | exact |
|---|---|---|---|---|---|---|---|"""

OTHER = """
## Other ways to sum

On a free surface `half_space(..., method=...)` sums the same displacements over the cells in four ways. The table
above uses Fourier transforms. The other ways solve the same equations and therefore have the same order, limit and
error.

The table below lists the largest relative difference of each quantity from that by transforms. The cells along a side
are in brackets, and "none" means below 1e-15. Compare the differences with the tolerance of the solves, 1e-8, and of
the flat regions, 1e-9. A multilevel sum is inexact: its answer is corrected until the exact sum certifies it. Flat
regions are solved only with the exact sum.

| body | quantity | multilevel | moving grid | full matrix |
|---|---|---|---|---|"""

TAIL = """
## Remarks

* In force and depth, a smooth contact converges with the square of the cell. A sharp contact converges with the cell,
  because half a cell is missing along its edge. For the square the missing part is about 0.345/n.
* The limit of the square is 1.152298(1) E* L, and so is that of every full contact. The thesis uses 1.1419 E* L for
  the largest stiffness (eq. 4.14, from a shape factor of 1.012). This is 0.9 % too small: 64 x 64 cells exceed it.
* The equilateral triangle has no closed form. The value in its row is `roughcontact.theory.punch.TRIANGLE`, accurate
  to its fifth digit. The height of its cells is chosen so that the rows fit into the triangle.
* On a surface discs are staircases. The area of their cells differs from that of the disc, and it jumps.
* For the cost of the four ways in time and memory, run `benchmarks/operators.py`.
* The last column of the toroid is an asymptote for a thin ring, not an exact value. Its limit is more accurate.
"""


def main() -> None:
    """Write the page to standard output."""
    groups = (bodies_of_revolution, elliptic, cylinders, punches, toroid)
    cases = [case for group in groups for case in group()]
    sys.stdout.write(HEAD + "\n")
    for case in cases:
        sys.stdout.write(row(case) + "\n")
        sys.stdout.flush()
    sys.stdout.write(OTHER + "\n")
    for case in cases:
        if case.geometry == "surface":
            sys.stdout.write(sums(case) + "\n")
            sys.stdout.flush()
    sys.stdout.write(TAIL)


if __name__ == "__main__":
    main()
