"""What an idea or a tuning constant saves that one run is too coarse to show: processes with and without it, in turn.

    python benchmarks/pairs.py [rounds [cases]]
    python benchmarks/pairs.py --tuning NAME[,NAME] [rounds [cases]]

Each row is a case: the least seconds with all ideas, and for each idea how much longer it takes without: the median of
the ratios of neighbours, and the ratio of the least. Processes take turns every case, so that what disturbs the machine
disturbs all of them; each has two threads. With `--tuning` the columns are some constants of `TUNED`, or all that begin
with a NAME, halved and doubled: above 1 the change costs time.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache, partial
from typing import Any

import numpy as np
from suite.cases import CASES

import roughcontact as rc
from roughcontact.halfspace.influence import tables
from roughcontact.halfspace.sums import particle_mesh
from roughcontact.kernels import active_cells, buffers, compiled_convolution, planes
from roughcontact.solver import tuning

# The names of what is taken away, and what each replaces: where, which name, and by what.
IDEAS: dict[str, tuple[Any, str, Any]] = {
    "memory that is kept": (buffers, "SMALL", buffers.LARGE),
    "judging in one pass": (planes, "fit", lambda *_: False),
}
# Constants that decide which way costs least: no answer and hardly a product depends on them.
TUNED = {
    tuning: (
        *("DIRECT_CELLS", "DIRECT_BESIDE_TILES", "DIRECT_ROUGHLY", "DOWNDATED", "SINGLE_CELLS", "LOOKUPS"),
        *("LIST_FILLING", "LARGE_BOX", "KEPT_BOX", "SMALLER_BOX", "COARSEST", "FACTOR_FOUR"),
        *("COARSE_TOLERANCE", "SUMMITS", "SLAB"),
    ),
    active_cells: ("FEW", "SEVERAL"),
    compiled_convolution: ("LARGE",),
    particle_mesh: ("LEAST_PLANE", "MOST_DIRECT_TILES"),
    tables: ("SMALL_TABLE",),
}
CHANGED: dict[str, tuple[Any, str, Any]] = {
    f"{name} x {factor:g}": (module, name, type(getattr(module, name))(factor * getattr(module, name)))
    for module, names in TUNED.items()
    for name in names
    for factor in (0.5, 2)
}


@contextmanager
def without(where: Any, name: str, other: Any) -> Iterator[None]:
    """Do without an idea meanwhile."""
    before = getattr(where, name)
    setattr(where, name, other)
    try:
        yield
    finally:
        setattr(where, name, before)


problem_of = cache(lambda name, n: CASES[name](n, 0))  # made before the rounds that count


def press(name: str, n: int) -> None:
    """Press one case, from heights to a certified pressure."""
    problem = problem_of(name, n)
    grid = rc.Grid(problem.heights.shape, problem.spacing, periodic=problem.periodic)
    rc.press(rc.Surface(problem.heights, grid), problem.modulus, force=problem.force)


def curve(n: int) -> None:
    """Compute a curve of forty loads."""
    grid = rc.Grid((n, n), 1 / n)
    surface = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=np.random.default_rng(0))
    rc.loading_curve(surface, 1.0, forces=np.geomspace(1e-5, 4.5e-3, 40))


SHOWN: dict[str, Callable[[], None]] = {
    f"{name}, {n}": partial(press, name, n)
    for name, n in (
        ("fractal-0.8-0.001", 512),
        ("fractal-0.8-0.45", 512),
        ("fractal-0.8-0.001", 1024),
        ("fractal-0.8-0.45", 1024),
        ("flat-periodic", 512),
        ("flat-half", 512),
        ("sphere", 1024),
    )
} | {"curve, 256": partial(curve, 256)}


def answer(idea: str) -> None:
    """Time the cases that come in, without an idea."""
    with without(*(IDEAS | CHANGED)[idea]) if idea else without(sys, "flags", sys.flags):
        for line in sys.stdin:
            start = time.perf_counter()
            SHOWN[line.rstrip()]()
            print(time.perf_counter() - start, flush=True)


def main(ideas: list[str], rounds: int, cases: tuple[str, ...]) -> None:
    workers = [
        subprocess.Popen(
            [sys.executable, __file__, "--without", idea],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env={**os.environ, "OMP_NUM_THREADS": "2"},
        )
        for idea in ("", *ideas)
    ]

    def seconds(k: int, name: str) -> float:
        worker = workers[k]
        assert worker.stdin is not None
        assert worker.stdout is not None
        worker.stdin.write(name + "\n")
        worker.stdin.flush()
        return float(worker.stdout.readline())

    labels = (f"without {idea}" if idea in IDEAS else idea for idea in ideas)
    print(f"| {rounds} rounds | as it is | " + " | ".join(labels) + " |")
    print("|---" * (2 + len(ideas)) + "|")
    for name in (name for name in SHOWN if name.startswith(cases)):
        times = np.empty((rounds + 1, len(workers)))
        for k in range(rounds + 1):  # the first is not counted
            for w in np.roll(range(len(workers)), k):
                times[k, w] = seconds(w, name)
        least = times[1:].min(axis=0)
        columns = [
            f"{statistics.median(times[1:, w] / times[1:, 0]):.3f}, least {least[w] / least[0]:.3f}"
            for w in range(1, len(workers))
        ]
        print(f"| {name} | {least[0]:.3f} s | " + " | ".join(columns) + " |", flush=True)
    for worker in workers:
        worker.terminate()


if __name__ == "__main__":
    if sys.argv[1:2] == ["--without"]:
        answer(sys.argv[2])
    else:
        given, chosen = sys.argv[1:], list(IDEAS)
        if given[:1] == ["--tuning"]:
            starts = tuple(given[1].split(","))
            given, chosen = given[2:], [name for name in CHANGED if name.startswith(starts)]
        main(chosen, int(given[0]) if given else 15, tuple(given[1:]) or ("",))
