"""What a step costs: an exact product, and a step of conjugate gradients by what drives a solve.

    OMP_NUM_THREADS=1 python benchmarks/patches.py

Milliseconds of processor time. Tiles cover the summits of a self-affine surface, H = 0.8. See README.md beside this
file.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

import roughcontact as rc
from roughcontact.halfspace.sums.tiles import SIDE, Tiles
from roughcontact.solver.conjugate_gradients import conjugate_gradients
from roughcontact.solver.inner_operator import FullGrid, InnerOperator
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.vectors import vectors_on
from roughcontact.threads import one_blas_thread

SIZES = (128, 256, 512, 1024, 2048)
PARTS = (0.01, 0.03, 0.1, 0.3)


def least(work: Callable[[], object], times: int = 9) -> float:
    """Return the least processor time of some runs [ms]."""
    found = []
    for _ in range(times):
        start = time.process_time()
        work()
        found.append(time.process_time() - start)
    return 1e3 * min(found)


def step(driver: InnerOperator, region: np.ndarray, heights: np.ndarray) -> float:
    """Return what one step of conjugate gradients takes on a region [ms]: that many take more than few."""
    kept, lacking = driver.gather(region), driver.scaled(driver.gather(heights))
    measure, none = Measure(driver.weights), np.zeros_like(lacking)

    def solve(count: int) -> None:
        fields = vectors_on(driver, measure, kept, lacking.copy(), none)
        conjugate_gradients(driver, fields, limit=0.0, max_steps=count)

    def steps(count: int) -> float:
        return least(lambda: solve(count))

    return (steps(12) - steps(2)) / 10


def summits(heights: np.ndarray, part: float) -> np.ndarray:
    """Return the highest cells of a surface, as many as lie on some part of its tiles."""
    n = len(heights)
    tiles = heights.reshape(n // SIDE, SIDE, n // SIDE, SIDE).max(axis=(1, 3))
    return heights >= np.quantile(tiles, 1 - part)


def main() -> None:
    print(
        f"| cells | boundary | exact product | step on the plane, {PARTS[-1]:.0%} of whose tiles are touched | "
        + " | ".join(f"on {part:.0%} of the tiles" for part in PARTS)
    )
    print("|---" * (4 + len(PARTS)) + "|")
    for n in SIZES:
        for periodic in (False, True):
            grid = rc.Grid((n, n), 1.0, periodic)
            operator = rc.half_space(grid, 1.0)
            rough = rc.self_affine(grid, 0.8, 1.0, np.random.default_rng(0)).heights
            regions = [summits(rough, part) for part in PARTS]
            row = [least(lambda: operator.apply(rough))]  # noqa: B023
            row += [step(FullGrid(operator, single=True), regions[-1], rough)]
            row += [step(operator.particle_mesh.on(Tiles.of(region)), region, rough) for region in regions]
            kind = "periodic" if periodic else "free"
            print(f"| {n}^2 | {kind} | " + " | ".join(f"{t:.2f}" for t in row) + " |", flush=True)


if __name__ == "__main__":
    with one_blas_thread():
        main()
