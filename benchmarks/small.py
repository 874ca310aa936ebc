"""Processor time of one load on a small surface [ms]: OMP_NUM_THREADS=1 python benchmarks/small.py.

Free and periodic self-affine surfaces (H = 0.8) under four forces over E* L h_rms: the least of some calls, means over
three seeds.
"""

import time

import numpy as np

import roughcontact as rc

FORCES = 1e-3, 0.046, 0.2, 1.0
SEEDS = range(3)
ROUNDS = 30


def milliseconds(n: int, periodic: bool) -> dict[float, float]:
    """Return the time for each force."""
    grid = rc.Grid((n, n), 1 / n, periodic)
    surfaces = [rc.self_affine(grid, 0.8, 0.01, np.random.default_rng(seed)) for seed in SEEDS]
    cases = [(load, k) for load in FORCES for k in SEEDS]
    least = dict.fromkeys(cases, np.inf)
    for _ in range(ROUNDS):
        for load, k in cases:
            start = time.process_time_ns()
            rc.press(surfaces[k], 1.0, force=0.01 * load)
            least[load, k] = min(least[load, k], (time.process_time_ns() - start) / 1e6)
    return {load: float(np.mean([least[load, k] for k in SEEDS])) for load in FORCES}


if __name__ == "__main__":
    print("| cells | boundary |", " | ".join(f"force {load:g}" for load in FORCES), "|")
    print("|" + "---|" * (2 + len(FORCES)))
    for n in (16, 32, 64, 128):
        for periodic in (False, True):
            found = milliseconds(n, periodic)
            times = " | ".join(f"{found[load]:.1f}" for load in FORCES)
            print(f"| {n}^2 | {'periodic' if periodic else 'free'} | {times} |", flush=True)
