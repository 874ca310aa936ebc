"""How the numbers of `solver/tuning.py` were chosen: products of large contacts with each of them changed.

    python benchmarks/steps.py [n] [seeds]

Means over the seeds of the products of one load on the cells asked for, from a cold start to 1e-8; those on the coarser
cells of the first guess are not counted.
"""

from __future__ import annotations

import statistics
import sys
from typing import Any

from pairs import without
from suite.cases import CASES

import roughcontact as rc
from roughcontact.solver import tuning

CHANGES: tuple[tuple[str, Any], ...] = (
    ("TRIAL_STEP", 0.8),
    ("TRIAL_STEP", 1.0),
    ("SHORTEST_STEP", 0.3),
    ("SHORTEST_STEP", 1.0),
    ("LONGEST_STEP", 1.0),
    ("LONGEST_STEP", 1.5),
    ("ESTIMATE_AT_BOUNDS", (0.5, 1.1)),
    ("ESTIMATE_AT_BOUNDS", (0.7, 1.3)),
    ("ESTIMATE_FREE", (0.7, 1.25)),
    ("ESTIMATE_FREE", (0.1, 10.0)),
    ("LIFTED_RESIDUAL", 0.03),
    ("LIFTED_RESIDUAL", 0.3),
    ("BOUND_VIOLATION", 0.03),
    ("BOUND_VIOLATION", 0.3),
    ("INNER_FORCING", 0.1),
    ("INNER_FORCING", 0.3),
    ("STALE_CONSTRAINT_DIRECTION", 0.01),
    ("STALE_CONSTRAINT_DIRECTION", 0.1),
)
SHOWN = ("flat-periodic", "flat-half", "flat-free", "fractal-0.8-0.45", "fractal-0.3-0.45", "sphere")


def products(name: str, n: int, seed: int) -> int:
    """Return the products that a load takes."""
    problem = CASES[name](n, seed)
    grid = rc.Grid(problem.heights.shape, problem.spacing, periodic=problem.periodic)
    return rc.press(rc.Surface(problem.heights, grid), problem.modulus, force=problem.force).steps


def row(n: int, seeds: int) -> list[float]:
    """Return the means of all cases; a sphere has no seed."""
    return [
        statistics.fmean(products(name, n, seed) for seed in range(1 if name == "sphere" else seeds))
        for name in SHOWN
    ]


def shown(label: str, means: list[float]) -> None:
    print(f"| {label} | " + " | ".join(f"{mean:.1f}" for mean in (*means, sum(means))) + " |", flush=True)


def main(n: int, seeds: int) -> None:
    print(f"| n = {n}, {seeds} seeds | " + " | ".join(SHOWN) + " | sum |")
    print("|---" * (2 + len(SHOWN)) + "|")
    shown("as it is", row(n, seeds))
    for name, value in CHANGES:
        label = f"{name} = {value} instead of {getattr(tuning, name)}"
        with without(tuning, name, value):
            shown(label, row(n, seeds))


if __name__ == "__main__":
    given = [int(text) for text in sys.argv[1:]]
    main(*(given + [512, 5][len(given) :]))
