"""Processor time of one load on a small surface [ms]: OMP_NUM_THREADS=1 python benchmarks/small.py.

Free and periodic self-affine surfaces (H = 0.8) under four forces over E* L h_rms: the least of some calls, means over
three seeds. Then how many of 64 x 64 cells are pressed a second: one after the other, by a thread for each core, and by
`press_many` with a process for each, their start included; medians of five turns.
"""

import os
import statistics
import time
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import numpy as np

import roughcontact as rc

FORCES = 1e-3, 0.046, 0.2, 1.0
SEEDS = range(3)
ROUNDS = 30
MANY, TURNS = 4000, 5
CORES = os.cpu_count() or 1


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


def throughputs() -> dict[str, float]:
    """Return how many surfaces are pressed a second, in three ways."""
    grid, rngs = rc.Grid((64, 64), 1 / 64), (np.random.default_rng(k) for k in range(MANY))
    surfaces = [rc.self_affine(grid, 0.8, 0.01, rng) for rng in rngs]
    load = partial(rc.press, modulus=1.0, force=0.01 * 0.046)

    def by_threads() -> Iterable[object]:
        with ThreadPoolExecutor(CORES) as pool:
            yield from pool.map(load, surfaces)

    ways: dict[str, Callable[[], Iterable[object]]] = {
        "one after the other": lambda: map(load, surfaces),
        f"{CORES} threads": by_threads,
        f"press_many, {CORES} processes": lambda: rc.press_many(
            surfaces, 1.0, force=0.01 * 0.046, executor=rc.study.Processes(CORES)
        ),
    }
    taken: dict[str, list[float]] = {way: [] for way in ways}
    for _ in range(TURNS):
        for way, solutions in ways.items():
            start = time.perf_counter()
            each = iter(solutions())
            next(each)
            begun = time.perf_counter() - start
            for _ in each:
                pass
            taken[way].append(time.perf_counter() - start)
    print(f"the last way had its first solution after {begun:.1f} s")
    return {way: MANY / statistics.median(each) for way, each in taken.items()}


if __name__ == "__main__":
    print("| cells | boundary |", " | ".join(f"force {load:g}" for load in FORCES), "|")
    print("|" + "---|" * (2 + len(FORCES)))
    for n in (16, 32, 64, 128):
        for periodic in (False, True):
            found = milliseconds(n, periodic)
            times = " | ".join(f"{found[load]:.1f}" for load in FORCES)
            print(f"| {n}^2 | {'periodic' if periodic else 'free'} | {times} |", flush=True)
    for way, rate in throughputs().items():
        print(f"{way}: {rate:.0f} surfaces of 64 x 64 cells a second")
