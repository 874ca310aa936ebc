"""What one load costs beside the model of docs/concepts/method.md: products, cells, memory, and how its time scales.

    python benchmarks/cost.py [n ...]

For each number of cells a side, on nominally flat surfaces and a fractal one: the parts of the grid in the overlap
(m/n) and in contact (c/n), outer and inner iterations (those of coarser grids too), cells that inner products went
over, peak memory per cell of the grid, and the ratio of processor seconds to those of the grid before.
"""

from __future__ import annotations

import sys
import time
import tracemalloc
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from suite.cases import CASES

import roughcontact as rc
from roughcontact.halfspace.sums.particle_mesh import TileOperator
from roughcontact.solver import active_set
from roughcontact.solver.inner_operator import FullGrid

SHOWN = ("fractal-0.8-0.046", "flat-free", "flat-periodic")


@contextmanager
def counted() -> Iterator[dict[str, list[int]]]:
    """Note the cells of each inner product and of each evaluated iterate, on all grids."""
    found: dict[str, list[int]] = {"inner": [], "outer": []}
    kept = [(kind, kind.apply) for kind in (FullGrid, TileOperator)]
    evaluate = active_set.Optimality.evaluate

    def noting(apply: Any) -> Any:
        def noted(self: Any, pressure: Any) -> Any:
            found["inner"].append(pressure.size)
            return apply(self, pressure)

        return noted

    def evaluated(self: Any, iterate: Any) -> Any:
        found["outer"].append(iterate.pressure.size)
        return evaluate(self, iterate)

    for kind, apply in kept:
        kind.apply = noting(apply)  # type: ignore[method-assign]
    active_set.Optimality.evaluate = evaluated  # type: ignore[method-assign]
    try:
        yield found
    finally:
        for kind, apply in kept:
            kind.apply = apply  # type: ignore[method-assign]
        active_set.Optimality.evaluate = evaluate  # type: ignore[method-assign]


def main(sizes: list[int]) -> None:
    print("| case | n | m/n | c/n | outer | inner | cells of inner products / m | B per cell | time ratio |")
    print("|---" * 9 + "|")
    for name in SHOWN:
        before = 0.0
        for side in sizes:
            problem = CASES[name](side, 0)
            grid = rc.Grid(problem.heights.shape, problem.spacing, periodic=problem.periodic)
            surface = rc.Surface(problem.heights, grid)
            rc.press(surface, problem.modulus, force=problem.force)  # kernels are made
            with counted() as found:
                start = time.process_time()
                solution = rc.press(surface, problem.modulus, force=problem.force)
                seconds = time.process_time() - start
            tracemalloc.start()
            rc.press(surface, problem.modulus, force=problem.force)
            peak = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
            # A periodic body may bulge: no part of it is left out.
            n = grid.size
            m = n if problem.periodic else int((solution.problem.separation < solution.depth).sum())
            c = int(np.count_nonzero(solution.contact))
            ratio = f"{seconds / before:.1f}" if before else ""
            print(
                f"| {name} | {side}^2 | {m / n:.2f} | {c / n:.3f} | {len(found['outer'])} | {len(found['inner'])} "
                f"| {sum(found['inner']) / m:.1f} | {peak / n:.0f} | {ratio} |",
                flush=True,
            )
            before = seconds


if __name__ == "__main__":
    main([int(text) for text in sys.argv[1:]] or [256, 512, 1024])
