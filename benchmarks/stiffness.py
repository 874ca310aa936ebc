"""One stiffness beside one load: python benchmarks/stiffness.py [n].

Seconds of a load on a cold start, and of the stiffness of the region that it leaves in contact, medians of five.
"""

from __future__ import annotations

import statistics
import sys
import time

from suite.cases import CASES, Problem, chosen

import roughcontact as rc

ROUNDS = 5


def seconds(problem: Problem) -> tuple[float, float]:
    """Return what a load and what its stiffness take [s]."""
    start = time.perf_counter()
    grid = rc.Grid(problem.heights.shape, problem.spacing, periodic=problem.periodic)
    solution = rc.press(rc.Surface(problem.heights, grid), problem.modulus, force=problem.force)
    pressed = time.perf_counter()
    _ = solution.stiffness
    return pressed - start, time.perf_counter() - pressed


def main(n: int) -> None:
    print(f"| {n}^2 | load [s] | its stiffness [s] | share |\n|---|---|---|---|")
    for name in chosen("fractal,flat,sphere"):
        problem = CASES[name](n, 0)
        seconds(problem)  # warms up
        runs = [seconds(problem) for _ in range(ROUNDS)]
        load, stiffness = (statistics.median(times) for times in zip(*runs, strict=True))
        print(f"| {name} | {load:.3f} | {stiffness:.3f} | {stiffness / load:.2f} |", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 512)
