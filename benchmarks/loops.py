"""Random loops of loads under a hardness: whether every state is right, and what unloading leaves of the assumptions.

    python benchmarks/loops.py [--count 1000] [--first 0]

The problems of `robust.py` that have a hardness and are pressed by a force: up in two steps, down in three, and up
again. `certificate.py` judges pressure, force and depth of every state by a product of its own: on first loading of the
surface under the hardness, on unloading and reloading of the elastic surface without what flowed. Prints a row for each
boundary; ends with 1 if a state that says it has converged has not.

beyond: the largest pressure of unloading and reloading over the hardness, less one. again: the largest difference of
pressure between unloading and reloading, over the largest pressure of the loop. steps: that between the largest load
reached in two steps and in one.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, fields

import numpy as np
from robust import FORCE, TOLERANCE, Array, Problem, problem
from suite.certificate import KERNEL, Judge

import roughcontact as rc

LOADS = np.array([0.4, 1.0, 1.0, 0.6, 0.2, 0.6, 1.0])  # of the largest
TOP, PAIRS = 1, ((2, 6), (3, 5))  # the turn; unloading and reloading under the same load
UNITS = 4 * float(np.finfo(np.float64).eps)


@dataclass
class LoopTally:
    """What became of the loops of one kind."""

    loops: int = 0
    states: int = 0
    certified: int = 0
    missed: int = 0
    wrong: int = 0
    worst: float = 0.0  # of what is allowed
    beyond: float = 0.0
    again: float = 0.0
    steps: float = 0.0


def states_of(one: Problem, loads: Array) -> list[rc.Solution]:
    """Return the states of a problem under forces [N]."""
    given = {"hardness": one.hardness, "tolerance": TOLERANCE}
    return list(rc.loading_path(one.surface, one.modulus, forces=loads, **given))


def error_of(one: Problem, judge: Judge, solution: rc.Solution, flowed: Array, load: float) -> float:
    """Return the error of a state as a part of what is allowed, where so much has `flowed` before [m]."""
    heights, pressure = one.surface.heights - flowed, solution.pressure
    limit = math.inf if flowed.any() else one.hardness
    found = judge.certify(heights, pressure, load, hardness=limit)
    scale = float(np.abs(judge.displacement(pressure)).max())
    allowed = TOLERANCE + 2 * KERNEL + (judge.rounding(pressure) / scale if scale > 0 else 0.0)
    top = float(np.nanmax(one.surface.heights))
    depth = found.depth + (top - float(np.nanmax(heights)))
    # What has flowed is known to the last place of the depth; where much flows, that is more than displacements.
    slack = UNITS * abs(depth) / scale if scale > 0 else 0.0
    off = abs(solution.depth - depth) / scale if scale > 0 else math.inf
    return max(found.residual / (allowed + slack), found.force_error / FORCE, off / (2 * (allowed + slack)))


def examine(one: Problem, where: str, tally: LoopTally) -> None:
    """Solve and judge one loop, and add what became of it."""
    grid, force = one.surface.grid, float(one.loads.max())
    judge = Judge(grid.shape, grid.spacing, grid.periodic, one.modulus)
    tally.loops += 1
    try:
        found = states_of(one, force * LOADS)
    except Exception as fault:  # whatever it is, there is no answer
        tally.wrong += 1
        print(f"{where}: {type(fault).__name__}: {fault}", flush=True)
        return
    top = found[TOP]
    assert top.flow is not None
    for place, (load, solution) in enumerate(zip(force * LOADS, found, strict=True)):
        tally.states += 1
        if not solution.status.converged:
            tally.missed += 1
            print(f"{where}: state {place} missed, {solution.residual:.1e}", flush=True)
            continue
        flowed = top.flow.depth if place > TOP else np.zeros(grid.shape)
        error = error_of(one, judge, solution, flowed, load)
        tally.worst = max(tally.worst, error)
        right = error <= 1
        tally.certified, tally.wrong = tally.certified + right, tally.wrong + (not right)
        if not right:
            print(f"{where}: state {place} wrong, {error:.2g} of what is allowed", flush=True)
        if place > TOP:
            tally.beyond = max(tally.beyond, float(solution.pressure.max()) / one.hardness - 1)
    if all(each.status.converged for each in found):
        most = float(top.pressure.max())
        for down, up in PAIRS:
            tally.again = max(tally.again, _apart(found[down], found[up]) / most)
        [once] = states_of(one, np.array([force]))
        if once.status.converged:
            tally.steps = max(tally.steps, _apart(top, once) / most)


def _apart(one: rc.Solution, other: rc.Solution) -> float:
    return float(np.abs(one.pressure - other.pressure).max())


def loops(first: int) -> Iterator[tuple[int, Problem]]:
    """Yield the problems that have a hardness and a force, by their numbers, from the first one on."""
    seed = first
    while True:
        one = problem(seed)
        if one.hardness < math.inf and one.control == "force":
            yield seed, one
        seed += 1


def table(tallies: dict[str, LoopTally]) -> Iterator[str]:
    """Return the lines of the table."""
    names = [each.name for each in fields(LoopTally)]
    yield "| kind | " + " | ".join(names) + " |"
    yield "|---" * (len(names) + 1) + "|"
    total = LoopTally()
    for tally in tallies.values():
        for name in names:
            both = getattr(total, name), getattr(tally, name)
            setattr(total, name, sum(both) if isinstance(both[1], int) else max(both))
    for kind, tally in [*sorted(tallies.items()), ("all", total)]:
        numbers = (getattr(tally, name) for name in names)
        words = (str(n) if isinstance(n, int) else f"{n:.1e}" for n in numbers)
        yield f"| {kind} | " + " | ".join(words) + " |"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=1000, help="loops")
    parser.add_argument("--first", type=int, default=0, help="number of the first problem")
    given = parser.parse_args()
    tallies: dict[str, LoopTally] = defaultdict(LoopTally)
    for done, (seed, one) in enumerate(loops(given.first)):
        if done == given.count:
            break
        kind = one.kind.split(",")[0]
        examine(one, f"{seed}: {one.kind}, {one.surface.grid.shape}", tallies[kind])
    print("\n".join(table(tallies)))
    return int(any(t.wrong for t in tallies.values()))


if __name__ == "__main__":
    sys.exit(main())
