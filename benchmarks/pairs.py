"""What an idea saves that is too small for one run to show: loads with and without it in turn, many times.

    python benchmarks/pairs.py [n] [rounds]

The median of the seconds of one load, from heights to a certified pressure, and by how much more it takes without: the
median of the ratios of neighbours. What disturbs the machine disturbs both.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from cases import CASES, Problem

import roughcontact as rc
from roughcontact.kernels import buffers as room
from roughcontact.solver.optimality import Iterate

# The names of what is taken away, and what each replaces: where, which name, and by what.
IDEAS: dict[str, tuple[Any, str, Any]] = {
    "memory that is kept": (room, "SMALL", room.LARGE),
    "judging in one pass": (Iterate, "fits_machine_code", lambda *_: False),
}
SHOWN = ("fractal-0.8-0.046", "flat-free", "flat-periodic", "flat-half", "sphere")


@contextmanager
def without(where: Any, name: str, other: Any) -> Iterator[None]:
    """Do without an idea meanwhile."""
    before = getattr(where, name)
    setattr(where, name, other)
    try:
        yield
    finally:
        setattr(where, name, before)


def seconds(problem: Problem) -> float:
    """Return what one load takes [s]."""
    start = time.perf_counter()
    grid = rc.Grid(problem.heights.shape, problem.spacing, periodic=problem.periodic)
    rc.press(rc.Surface(problem.heights, grid), problem.modulus, force=problem.force)
    return time.perf_counter() - start


def in_turn(one: Callable[[], float], other: Callable[[], float], rounds: int) -> tuple[float, float]:
    """Return the median of one time [s], and of the ratio of another to it, taken in turn."""
    one(), other()
    pairs = []
    for k in range(rounds):
        first, second = (one, other) if k % 2 else (other, one)
        a, b = first(), second()
        pairs.append((a, b) if k % 2 else (b, a))
    return statistics.median(a for a, _ in pairs), statistics.median(b / a for a, b in pairs)


def main(n: int, rounds: int) -> None:
    print(
        f"| n = {n}, {rounds} rounds | with all | " + " | ".join(f"without {name}" for name in IDEAS) + " |"
    )
    print("|---" * (2 + len(IDEAS)) + "|")
    for name in SHOWN:
        problem, columns, alone = CASES[name](n, 0), [], 0.0
        for idea in IDEAS.values():

            def changed(idea: tuple[Any, str, Any] = idea, problem: Problem = problem) -> float:
                with without(*idea):
                    return seconds(problem)

            alone, ratio = in_turn(lambda problem=problem: seconds(problem), changed, rounds)
            columns.append(f"{ratio:.2f}")
        print(f"| {name} | {alone:.3f} s | " + " | ".join(columns) + " |", flush=True)


if __name__ == "__main__":
    given = [int(text) for text in sys.argv[1:]]
    main(*(given + [512, 40][len(given) :]))
