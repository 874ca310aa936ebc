"""Laws of adhesion against the theories of a sphere, as the grid gets finer.

    python benchmarks/adhesive_laws.py [--rings 120 240 480] [--numbers 0.01 0.1 0.5 1 2] [--cells 64 128]
        [--only dugdale | plane | detachment]

Dugdale's law on rings against Maugis' equations: relative error of the pull-off force under a given force, of contact
radius and depth without load, and the largest error of the force on the curve of stable states at given depths over
the pull-off force; jumps but the pull-off, and what they lose of the work of adhesion times the square of the radius.
The contact radius is where the gap, which grows as the distance from the edge to 3/2, extrapolates to zero.

The same on planes: the contact radius without load, from the area, and the largest error of the force from there to
the depth of the pull-off, over the pull-off force.

Detachment without a range against Johnson, Kendall and Roberts, on rings and on planes (mean and scatter over positions
of the sphere within a cell), from a contact larger than that at the pull-off; the same from contacts of other sizes; a
flat disc against Kendall, and square punches along the rows and turned.
"""

from __future__ import annotations

import argparse
import math
import sys
import time

import numpy as np

import roughcontact as rc
from roughcontact.theory.adhesive.maugis import DugdaleSphere

POINTS = 24
PRESSED = (
    4.0  # depth from which a sphere is drawn back: a contact of radius 2, where that at the pull-off is 1.52
)


def ball(theory: DugdaleSphere, rings: int) -> tuple[rc.RadialProfile, float]:
    """Return a sphere on rings as far as its attraction reaches without load, half of them in contact, and its tip."""
    inner, outer = 1.2 * unloaded(theory), 1.25 * float(theory.zone_radius(unloaded(theory)))
    half = rings // 2
    x = np.arange(rings - half + 1) / (rings - half)
    width = inner / half * (rings - half)  # beyond the contact rings widen slowly, by a cubic
    outside = inner + width * x + (outer - inner - width) * x**3
    uniform = np.linspace(0.0, outer, rings + 1)
    edges = np.r_[np.linspace(0.0, inner, half + 1), outside[1:]] if outer > inner + width else uniform
    grid = rc.RadialGrid(edges)
    heights = -(grid.radii**2) / (2 * theory.radius)
    return rc.RadialProfile(heights, grid), float(heights[0])


def unloaded(theory: DugdaleSphere) -> float:
    """Return the contact radius without load."""
    low, high = 0.5, 3.0
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if float(theory.force(middle)) < 0 else (low, middle)
    return low


def contact_radius(state: rc.AdhesiveState) -> float:
    """Return where the gap becomes zero."""
    radii = state.problem.operator.grid.radii
    first = int(state.contact.sum()) + 1  # the ring next to the contact is the least exact
    near, far = state.gap[first : first + 2] ** (2 / 3)
    return float(radii[first] - near * (radii[first + 1] - radii[first]) / (far - near))


def row(number: float, rings: int) -> None:
    theory = DugdaleSphere.of_number(number)
    profile, tip = ball(theory, rings)
    adhesion = rc.Adhesion(1.0, 1 / theory.strength, law="dugdale")
    began = time.perf_counter()
    pull = theory.pull_off_force
    free, off = rc.adhesive_path(profile, 1.0, adhesion, forces=[0.0, -1.2 * pull])
    jumps = [jump for jump in off.jumps if not math.isfinite(jump.lost)]
    radius = unloaded(theory)
    # Depths of stable states: from the smallest depth of an equilibrium up to twice the radius without load.
    radii = np.linspace(1.1 * radius, 0.02, 4000)
    depths = theory.depth(radii)
    last = int(np.argmin(depths))
    chosen = np.linspace(0, max(1, int(0.98 * last)), POINTS).astype(int)
    states = list(rc.adhesive_path(profile, 1.0, adhesion, depths=depths[chosen] + tip))
    events = [jump for state in states[1:] for jump in state.jumps]
    curve = max(
        abs(state.force - float(theory.force(radii[k]))) for state, k in zip(states, chosen, strict=True)
    )
    zone = (float(theory.zone_radius(radius)) - radius) / profile.grid.edges[1]
    print(
        f"{number:6} {rings:6} {zone:6.1f}  {-jumps[0].force_before / pull - 1:+.1e}  "
        f"{contact_radius(free) / radius - 1:+.1e}  {(free.depth - tip) / float(theory.depth(radius)) - 1:+.1e}  "
        f"{curve / pull:.1e}  {len(events):3}  {sum(jump.lost for jump in events):.0e}  "
        f"{max(state.residual for state in [free, *states]):.0e}  {time.perf_counter() - began:6.1f} s",
        flush=True,
    )


def plane(number: float, cells: int) -> None:
    theory = DugdaleSphere.of_number(number)
    grid = rc.Grid((cells, cells), 2.3 * float(theory.zone_radius(unloaded(theory))) / cells)
    x = (np.arange(cells) - 0.5 * cells + 0.5) * grid.spacing[0]
    surface = rc.Surface(-(x[:, None] ** 2 + x**2) / (2 * theory.radius), grid)
    adhesion = rc.Adhesion(1.0, 1 / theory.strength, law="dugdale")
    began = time.perf_counter()
    radius = unloaded(theory)
    radii = np.linspace(radius, 0.02, 4000)
    pull_off = int(np.argmin(theory.force(radii)))
    chosen = np.linspace(0, pull_off, 6).astype(int)
    depths = theory.depth(radii[chosen]) + float(surface.heights.max())
    states = list(rc.adhesive_path(surface, 1.0, adhesion, depths=depths))
    forces = np.array([state.force for state in states])
    errors = np.abs(forces - theory.force(radii[chosen])) / theory.pull_off_force
    found = math.sqrt(states[0].contact_area / math.pi)
    print(
        f"{number:6} {cells:6}  {found / radius - 1:+.1e}  {errors.max():.1e}  "
        f"{max(state.residual for state in states):.0e}  {time.perf_counter() - began:6.1f} s",
        flush=True,
    )


def pulled(surface: rc.Surface | rc.RadialProfile, depth: float) -> tuple[float, float, int]:
    """Return the largest tension of a stuck surface drawn back under given depths, the first, and its events."""
    *_, off = rc.detachment_path(rc.press(surface, 1.0, depth=depth), 1.0)
    return off.pull_off_force, -off.detachments[0].force_before, len(off.detachments)


def sphere(cells: int, place: np.ndarray) -> rc.Surface:
    grid = rc.Grid((cells, cells), 6.0 / cells)
    x = (np.arange(cells) - 0.5 * cells + 0.5 + place[:, None]) * grid.spacing[0]
    return rc.Surface(-(x[0][:, None] ** 2 + x[1] ** 2) / 2, grid)


def punch(cells: int, turned: float) -> rc.Surface:
    """Return a square of side 2, turned against the rows."""
    grid = rc.Grid((cells, cells), 3.0 / cells)
    x = (np.arange(cells) - 0.5 * cells + 0.5) * grid.spacing[0]
    first = math.cos(turned) * x[:, None] + math.sin(turned) * x
    second = math.cos(turned) * x - math.sin(turned) * x[:, None]
    return rc.Surface(np.where(np.maximum(np.abs(first), np.abs(second)) <= 1, 0.0, math.nan), grid)


def detachment() -> None:
    print("Johnson, Kendall and Roberts: cells in the radius at the pull-off, error, scatter")
    jkr, radius = 1.5 * math.pi, math.cbrt(9 * math.pi / 8)
    for rings in (50, 100, 200, 400):
        grid = rc.RadialGrid.uniform(rings, 3.2)
        tension, _, _ = pulled(rc.RadialProfile(-(grid.radii**2) / 2, grid), PRESSED)
        print(f"rings  {radius / grid.edges[1]:6.1f}  {tension / jkr - 1:+.2%}", flush=True)
    rng = np.random.default_rng(0)
    for cells in (24, 32, 40, 48, 64, 80):
        errors = [pulled(sphere(cells, rng.random(2)), PRESSED)[0] / jkr - 1 for _ in range(8)]
        print(f"plane  {radius * cells / 6:6.1f}  {np.mean(errors):+.2%}  {np.std(errors):.2%}", flush=True)
    print("planes of 40 cells: radius of the contact at the start, over that at the pull-off; error, scatter")
    places = np.random.default_rng(1).random((8, 2))
    for depth in (1.0, 1.5, 2.0, 3.0, 4.0, 5.0):
        errors = [pulled(sphere(40, place), depth)[0] / jkr - 1 for place in places]
        start = math.sqrt(depth) / radius
        print(f"start  {start:6.2f}  {np.mean(errors):+.2%}  {np.std(errors):.2%}", flush=True)
    print(
        "Kendall's disc: cells in the diameter, error of the largest tension and of that when the first cell lets go"
    )
    for cells in (32, 48, 64, 80):
        disc = rc.shapes.flat_disc(rc.Grid((cells + 2, cells + 2), 2 / cells), radius=1.0)
        most, first, _ = pulled(disc, 0.1)
        print(
            f"disc   {cells:6}  {most / math.sqrt(8 * math.pi) - 1:+.2%}  {first / math.sqrt(8 * math.pi) - 1:+.2%}"
        )
    print("square punch of side 2: cells in the side, tension along the rows, turned by 22.5 and 45 degrees")
    for cells in (48, 72, 96):
        tensions = [pulled(punch(cells, math.pi * k / 8), 0.1)[0] for k in range(3)]
        print(
            f"punch  {cells * 2 // 3:6}  " + "  ".join(f"{tension:.3f}" for tension in tensions), flush=True
        )


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--rings", type=int, nargs="+", default=[120, 240, 480])
    parser.add_argument("--numbers", type=float, nargs="+", default=[0.01, 0.1, 0.5, 1.0, 2.0])
    parser.add_argument("--cells", type=int, nargs="+", default=[64, 128], help="of planes")
    parser.add_argument("--only", choices=["dugdale", "plane", "detachment"])
    options = parser.parse_args()
    if options.only in (None, "detachment"):
        detachment()
    if options.only in (None, "plane"):
        print("lambda  cells  radius    force    residual")
        for cells in options.cells:
            plane(1.0, cells)
    if options.only not in (None, "dugdale"):
        return 0
    print("lambda  rings   zone  pull-off  radius    depth     curve    jumps lost   residual")
    for number in options.numbers:
        for rings in options.rings:
            row(number, rings)
    return 0


if __name__ == "__main__":
    sys.exit(main())
