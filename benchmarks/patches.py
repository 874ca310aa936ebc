"""Processor time of a product and its approximate inverse: on the plane by transforms, and on tiles.

    OMP_NUM_THREADS=1 python benchmarks/patches.py

Where tiles cover some part of the plane, at random. See README.md beside this file.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

import roughcontact as rc
from roughcontact.halfspace.tiles import SIDE, Tiles

SIZES = (96, 128, 256, 512, 1024)
PARTS = (0.1, 0.3, 0.6, 1.0)


def least(work: Callable[[], object], times: int = 12) -> float:
    """Return the least processor time of some runs [ms]."""
    found = []
    for _ in range(times):
        start = time.process_time()
        work()
        found.append(time.process_time() - start)
    return 1e3 * min(found)


def main() -> None:
    print("| cells | boundary | plane | " + " | ".join(f"{part:.0%} of the tiles" for part in PARTS) + " |")
    print("|---" * (3 + len(PARTS)) + "|")
    rng = np.random.default_rng(0)
    for n in SIZES:
        for periodic in (False, True):
            operator = rc.half_space(rc.Grid((n, n), (1.0, 1.0), periodic), 1.0)
            field = rng.random((n, n))
            plane = least(lambda: operator.apply(field)) + least(lambda: operator.approximate_inverse(field))  # noqa: B023
            row = []
            for part in PARTS:
                chosen = rng.random((n // SIDE, n // SIDE)) < part
                patch = operator.patches.on(Tiles.of(np.kron(chosen, np.ones((SIDE, SIDE), dtype=bool))))
                values = patch.tiles.gather(field)
                row.append(
                    least(lambda: patch.apply(values)) + least(lambda: patch.approximate_inverse(values))  # noqa: B023
                )
            kind = "periodic" if periodic else "free"
            print(
                f"| {n}^2 | {kind} | {plane:.2f} | " + " | ".join(f"{t:.2f}" for t in row) + " |", flush=True
            )


if __name__ == "__main__":
    main()
