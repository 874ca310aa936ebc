"""Random problems from cold starts: whether every one is certified, and how many products the hardest takes.

    python benchmarks/robust.py [problems] [first]

Free and periodic, Hurst exponents from -0.5 to 2.5, single cells to full contact, ragged masks of missing cells,
stretched surfaces and cells; a tenth of them of 512 x 512 cells or more. Certified is what a product of NumPy's own
says (`certificate.py`), to 1e-8. Prints the hardest of each kind; ends with 1 if one is not certified.
"""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass

import numpy as np
from certificate import Judge

import roughcontact as rc

TOLERANCE = 1e-8
LARGE = 0.1  # of the problems


@dataclass(frozen=True)
class Problem:
    """One problem, and what it is called."""

    kind: str
    surface: rc.Surface
    load: dict[str, float]


def problem(seed: int) -> Problem:
    """Return a problem that depends on its number alone."""
    rng = np.random.default_rng(seed)
    large = rng.random() < LARGE
    low, high = (512, 768) if large else (4, 200)
    shape = (int(rng.integers(low, high)), int(rng.integers(low, high)))
    if large and rng.integers(2):
        shape = (512, 512)
    spacing = tuple(rng.uniform(0.3, 3.0, 2)) if rng.random() < 0.2 else (1.0, 1.0)
    periodic = bool(rng.integers(2))
    grid = rc.Grid(shape, spacing, periodic)
    hurst = rng.uniform(-0.5, 2.5)
    heights = rc.self_affine(grid, hurst, 1.0, rng).heights.copy()
    words = ["large" if large else "small", "periodic" if periodic else "free"]
    if rng.random() < 0.2:  # longer waves along y than along x: rows of one surface, drawn out
        factor = int(rng.integers(2, 8))
        heights = np.repeat(heights, factor, axis=0)[: shape[0]]
        words.append("stretched")
    if rng.random() < 0.25:
        words.append("missing points")
        y, x = np.indices(shape)
        for _ in range(int(rng.integers(1, 6))):
            row, column = rng.integers(shape[0]), rng.integers(shape[1])
            heights[(y - row) ** 2 + (x - column) ** 2 < rng.uniform(0.5, 0.2 * min(shape)) ** 2] = np.nan
        heights[rng.random(shape) < 0.02] = np.nan
        if not np.isfinite(heights).any():
            heights[0, 0] = 1.0
    surface = rc.Surface(heights, grid)
    # From a single cell to full contact: what every wave at full contact takes is about E* h q/2.
    largest = 3.0 * np.nanstd(heights) * min(grid.lengths) * (1.0 + 0.1 * min(shape))
    force = 10 ** rng.uniform(-6, 1) * max(largest, 1e-3)
    if rng.random() < 0.2 and np.nanstd(heights) > 0:
        words.append("at given depth")
        measured = np.isfinite(heights)
        mean = float(np.nanmax(heights) - heights[measured].mean())
        return Problem(", ".join(words), surface, {"depth": mean * rng.uniform(0.01, 0.98)})
    return Problem(", ".join(words), surface, {"force": force})


def main() -> int:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 2000
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    hardest: dict[str, tuple[int, int]] = {}
    failed, full, single, start = [], 0, 0, time.perf_counter()
    for seed in range(first, first + count):
        one = problem(seed)
        try:
            solution = rc.press(one.surface, 1.0, **one.load, tolerance=TOLERANCE)
        except rc.ConvergenceError as error:
            failed.append(seed)
            print(f"{seed}: {one.kind}, {one.surface.grid.shape}, {one.load}: {error}")
            continue
        grid = one.surface.grid
        judge = Judge(grid.shape, grid.spacing, all(grid.periodic), 1.0)
        found = judge.certify(one.surface.heights, solution.pressure, solution.force)
        error = found.error
        if "depth" in one.load:  # the judge takes the depth that suits the pressure best
            scale = np.abs(judge.displacement(solution.pressure)).max()
            error = found.residual + abs(found.depth - one.load["depth"]) / scale
        if not error <= TOLERANCE:
            failed.append(seed)
            print(f"{seed}: {one.kind}, {grid.shape}, {one.load}: the judge says {error:.1e}")
        cells = int(solution.contact.sum())
        full, single = full + (cells == int(np.isfinite(one.surface.heights).sum())), single + (cells == 1)
        hardest[one.kind] = max(hardest.get(one.kind, (0, 0)), (solution.steps, seed))
    for kind, (steps, seed) in sorted(hardest.items(), key=lambda item: -item[1][0]):
        print(f"{steps:6d} products at most: {kind} (problem {seed})")
    print(
        f"{count} problems, {len(failed)} not certified to {TOLERANCE:g}; {single} with a single cell in contact, "
        f"{full} in full contact; {time.perf_counter() - start:.0f} s"
    )
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
