"""Surfaces that stick: whether states depend on the step, and random problems.

    python benchmarks/adhesion.py [--surfaces 10] [--approaches 60] [--count 1000]
    python benchmarks/adhesion.py --strong 256

Ten strongly adhesive rough surfaces, free and periodic in turn, with Irwin's length from 1.5 to 4 cells, are approached
and drawn back in 10, 20, 50 and 100 steps: forces at the depths that all four share, relative to the largest, and
depths of the jumps, relative to the way from where the attraction begins. Then states that are reached at once, by
`press`, beside those at the end of an approach from where nothing attracts, on free and periodic planes and on rings:
gaps relative to the range. Then random problems under random depths or
forces: certified to 1e-8 and stable, or what their status says. Ends with 1 if numbers of jumps differ, a force by more
than 1e-6, a jump's depth by more than 1e-6, or if a state is neither certified and stable nor says so.

With --strong, a periodic surface of that many cells a side that sticks strongly is approached in one step from beyond
the attraction: its jumps, what the way to them takes, and seconds of processor time.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from pathlib import Path

import numpy as np

import roughcontact as rc

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from sticking import counted, rough, sticky, strong

STEPS = (1, 2, 5, 10)
ALLOWED = 1e-6
SAME = 1e-5  # of the range: as two states that are one in the library


def steps(number: int) -> bool:
    """Compare the steps on one surface."""
    length = (1.5, 2.0, 2.5, 3.0, 4.0)[number // 2 % 5]
    slope = 0.05 if number % 2 else 0.08 if length < 2.6 else 0.06
    surface = rough(32, periodic=bool(number % 2), slope=slope, seed=number)
    adhesion = sticky(length)
    deep = 0.4 * float(surface.heights.max() - surface.heights.mean())
    found = []
    for finer in STEPS:
        up = np.linspace(-10 * adhesion.range, deep, 10 * finer + 1)
        path = list(rc.adhesive_path(surface, 1.0, adhesion, depths=np.r_[up, up[-2::-1]]))
        jumps = [jump for state in path for jump in state.jumps]
        found.append(([state.force for state in path][::finer], jumps, sum(state.products for state in path)))
    forces = np.array([one[0] for one in found])
    force = np.ptp(forces, axis=0).max() / np.abs(forces).max()
    counts = [len(jumps) for _, jumps, _ in found]
    place = math.nan
    if len(set(counts)) == 1:
        places = np.array([[jump.depth for jump in jumps] for _, jumps, _ in found])
        place = float(np.ptp(places, axis=0).max(initial=0.0)) / (deep + 40 * adhesion.range)
    doubtful = sum(jump.ambiguous for _, jumps, _ in found for jump in jumps)
    kind = "periodic" if number % 2 else "free"
    print(
        f"{number:3} {kind:9} {length:4} cells  jumps {counts}  ambiguous {doubtful}  forces {force:.1e}  "
        f"places {place:.1e}  products {[products for *_, products in found]}",
        flush=True,
    )
    return force <= ALLOWED and place <= ALLOWED


def approach(number: int) -> tuple[str, int, float]:
    """Return the body of a random problem, the jumps of an approach and how far `press` is from its end."""
    rng = np.random.default_rng(number)
    kind = ("free", "periodic", "rings")[number % 3]
    modulus, depth = 1.0, rng.uniform(-0.1, 0.4)
    if kind == "rings":
        rings = rc.RadialGrid.uniform(int(rng.integers(40, 80)), radius=6e-7)
        wavy = rng.uniform(0, 3e-9) * np.cos(2 * np.pi * rings.radii / rng.uniform(0.8e-7, 3e-7))
        body: rc.Surface | rc.RadialProfile = rc.RadialProfile(
            wavy - rings.radii**2 / (2 * 10 ** rng.uniform(-5.6, -4.6)), rings
        )
        adhesion = rc.Adhesion(
            10 ** rng.uniform(-2.3, -1.5), 10 ** rng.uniform(-8.7, -7.9), allow_unresolved=True
        )
        modulus, depth = 1e8, 3e-8 * depth
    else:
        body = rough(20, periodic=kind == "periodic", slope=rng.uniform(0.02, 0.1), seed=number)
        adhesion = sticky(rng.uniform(1.5, 2.5))
        depth *= float(body.heights.max() - body.heights.mean())
    far = -40 * adhesion.range
    *_, end = rc.adhesive_path(body, modulus, adhesion, depths=[far, depth])
    once = rc.adhesive_state(body, modulus, adhesion, depth=depth)
    return kind, len(end.jumps), float(np.abs(once.gap - end.gap).max()) / adhesion.range


def approaches(count: int) -> bool:
    """Compare states that are reached at once with those of an approach."""
    apart = {"free": 0.0, "periodic": 0.0, "rings": 0.0}
    jumping = dict.fromkeys(apart, 0)
    for number in range(count):
        kind, jumps, distance = approach(number)
        apart[kind] = max(apart[kind], distance)
        jumping[kind] += jumps > 0
    print(f"reached at once and by an approach: {count} problems, gaps apart by at most (of the range)")
    for kind, distance in apart.items():
        print(f"  {kind:9} {distance:.1e}, jumps on the way in {jumping[kind]}", flush=True)
    return max(apart.values()) <= SAME


def random_problem(number: int) -> list[rc.AdhesiveState]:
    """Return three states of a random problem, which depends on its number alone."""
    rng = np.random.default_rng(number)
    cells, slope = int(rng.choice([16, 20, 24, 32])), 10 ** rng.uniform(-2, 0.3)
    surface = rough(cells, periodic=bool(rng.integers(2)), slope=slope, seed=number)
    adhesion = sticky(rng.uniform(1.5, 6.0), reach=10 ** rng.uniform(-1.3, 0.5))
    mean = float(surface.heights.max() - surface.heights.mean())
    if rng.integers(2):
        depths = rng.uniform(-3 * adhesion.range, 0.9 * mean, 3)
        return list(rc.adhesive_path(surface, 1.0, adhesion, depths=depths))
    forces = rng.normal(size=3) * 0.1 * slope * cells**2
    forces[0] = abs(forces[0])
    return list(rc.adhesive_path(surface, 1.0, adhesion, forces=forces))


def one_step(cells: int) -> int:
    """Print the jumps of one step into contact and what it takes."""
    surface, adhesion = strong(cells)
    depth = 0.3 * float(surface.heights.max() - surface.heights.mean())
    with counted() as counts:
        start = time.process_time()
        *_, end = rc.adhesive_path(surface, 1.0, adhesion, depths=[-40 * adhesion.range, depth])
        seconds = time.process_time() - start
    for jump in end.jumps:
        print(f"jump at {jump.depth:.6f}, lost {jump.lost:.6g}{', ambiguous' * jump.ambiguous}")
    for name in (name for name in counts if not name.endswith("products")):
        products = counts.get(f"{name}: products")
        print(f"{name:22} {counts[name]:5}" + (f"  {products:6} products" if products else ""))
    print(
        f"{cells}^2 cells, {len(end.jumps)} jumps, {end.products} products, {seconds:.1f} s of processor time"
    )
    return int(not end.status.converged)


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--surfaces", type=int, default=10)
    parser.add_argument("--approaches", type=int, default=60)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument(
        "--strong", type=int, metavar="CELLS", help="a surface of this many cells a side, in one step"
    )
    options = parser.parse_args()
    if options.strong:
        return one_step(options.strong)
    found = [steps(number) for number in range(options.surfaces)] + [approaches(options.approaches)]
    certified = missed = unstable = jumps = doubtful = 0
    worst = 0.0
    for number in range(options.count):
        for state in random_problem(number):
            jumps += len(state.jumps)
            doubtful += sum(jump.ambiguous for jump in state.jumps)
            if not state.status.converged:
                missed += 1
                print(f"problem {number}: {state}", flush=True)
            elif math.isfinite(state.depth) and state.stability <= 0:
                unstable += 1
                print(f"problem {number}: stability {state.stability:.2g}, {state}", flush=True)
            else:
                certified += 1
                worst = max(worst, state.residual)
    print(
        f"certified and stable {certified}, largest residual {worst:.1e}; missed {missed}; unstable {unstable}; "
        f"jumps {jumps}, ambiguous {doubtful}"
    )
    return int(not all(found) or unstable > 0)


if __name__ == "__main__":
    sys.exit(main())
