"""One stiffness beside one load: python benchmarks/stiffness.py [n].

Seconds of a load on a cold start, and of the stiffness of the region that it leaves in contact, medians of five.
"""

from __future__ import annotations

import statistics
import sys
import time

import numpy as np

import roughcontact as rc

FORCES = (1e-3, 0.046, 0.45)  # dimensionless, on the fractal
WARM = 0.01


def seconds(surface: rc.Surface, force: float) -> tuple[float, float]:
    start = time.perf_counter()
    solution = rc.press(surface, 1.0, force=force)
    pressed = time.perf_counter()
    _ = solution.stiffness
    return pressed - start, time.perf_counter() - pressed


def main(n: int) -> None:
    print(f"| {n}^2, H = 0.8 | load [s] | its stiffness [s] | share |\n|---|---|---|---|")
    rough = rc.self_affine(rc.Grid((n, n), 1 / n), 0.8, 0.01, np.random.default_rng(0))
    seconds(rough, WARM * 0.01)
    for force in FORCES:
        runs = [seconds(rough, force * 0.01) for _ in range(5)]
        load, stiffness = (statistics.median(times) for times in zip(*runs, strict=True))
        print(f"| force {force} | {load:.3f} | {stiffness:.3f} | {stiffness / load:.2f} |")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 512)
