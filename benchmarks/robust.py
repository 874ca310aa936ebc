"""Random problems from cold starts, and loads that follow one another: whether every answer is right.

    python benchmarks/robust.py [--count 5000] [--first 0]

Free, periodic, and periodic along one axis; elastic, and with a hardness; rough surfaces with Hurst exponents from -0.5
to 2.5 and patterns of two levels; single cells to full contact and beyond; ragged masks of missing cells, stretched
surfaces and cells, any units; one of fifty of 512 x 512 cells or more. `certificate.py` judges pressure, force and
depth of every load by a product, and the stiffness by a full matrix where that is not too large. Each problem depends
on its number alone. Prints a row for each kind; ends with 1 if an answer that says it has converged has not.

certified: to 1e-8 and rounding. missed: the status says so. wrong: converged by its status, not by the judge; or no
answer at all.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
from suite.certificate import KERNEL, Judge

import roughcontact as rc

TOLERANCE = 1e-8
STIFFNESS = 1e-7  # error of the unit displacement with which the library finds a stiffness
FORCE = 1e-12  # relative: a sum over up to 1e6 cells
LARGE = 0.02  # of the problems
MATRIX = 1500  # cells up to which a region's stiffness is judged
BOUNDARIES = {
    "free": [(False, False)],
    "periodic": [(True, True)],
    "singly periodic": [(True, False), (False, True)],
}

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Problem:
    """One problem: what it is called, and one load or some that follow one another."""

    kind: str
    surface: rc.Surface
    modulus: float
    hardness: float
    control: str
    loads: Array

    def solutions(self) -> Iterator[rc.Solution]:
        """Return the answers, missed ones too."""
        loads = {self.control + "s": self.loads}
        strength = None if self.hardness == math.inf else self.hardness
        if len(self.loads) > 1:
            yield from rc.loading_path(
                self.surface, self.modulus, **loads, tolerance=TOLERANCE, hardness=strength
            )
            return
        load = {self.control: float(self.loads[0])}
        try:
            yield rc.press(self.surface, self.modulus, **load, tolerance=TOLERANCE, hardness=strength)
        except rc.ConvergenceError as error:
            yield error.solution


@dataclass
class Tally:
    """What became of the problems of one kind."""

    problems: int = 0
    loads: int = 0
    certified: int = 0
    missed: int = 0
    wrong: int = 0
    stiffnesses: int = 0
    worst: float = 0.0  # of what is allowed
    products: int = 0
    seeds: list[int] = field(default_factory=list)


def problem(seed: int) -> Problem:
    """Return a problem that depends on its number alone."""
    rng = np.random.default_rng(seed)
    boundary = ("free", "periodic", "singly periodic")[rng.integers(3)]
    levels, hard = rng.random() < 0.4, rng.random() < 0.5
    large = boundary != "singly periodic" and rng.random() < LARGE
    shape = tuple(int(n) for n in (rng.integers(512, 768, 2) if large else rng.integers(16, 97, 2)))
    if rng.random() < 0.2:
        shape = (512, 512) if large else (2 ** int(rng.integers(4, 7)),) * 2
    unit = 10 ** rng.uniform(-9, 1)  # [m]
    spacing = unit * (rng.uniform(0.3, 3.0, 2) if rng.random() < 0.2 else np.ones(2))
    sides = BOUNDARIES[boundary][rng.integers(len(BOUNDARIES[boundary]))]
    grid = rc.Grid(shape, tuple(spacing), sides)
    heights = 10 ** rng.uniform(-3, 1) * unit * (_pattern(shape, rng) if levels else _rough(shape, rng))
    missing = rng.random() < 0.25
    if missing:
        _punch_holes(heights, rng)
    surface, modulus = rc.Surface(heights, grid), 10 ** rng.uniform(0, 11)
    hardness = _hardness(surface, modulus, rng) if hard else math.inf
    control, loads = _loads(surface, modulus, hardness, rng)
    body, what = "hardness" if hard else "elastic", "two levels" if levels else "rough"
    words = [boundary, body, what] + (["missing cells"] if missing else [])
    return Problem(", ".join(words), surface, modulus, hardness, control, loads)


def _rough(shape: tuple[int, ...], rng: np.random.Generator) -> Array:
    """Return a self-affine surface, at times drawn out along y."""
    heights = rc.self_affine(rc.Grid(shape, 1.0, True), rng.uniform(-0.5, 2.5), 1.0, rng).heights.copy()
    return np.repeat(heights, int(rng.integers(2, 8)), axis=0)[: shape[0]] if rng.random() < 0.2 else heights


def _pattern(shape: tuple[int, ...], rng: np.random.Generator) -> Array:
    """Return heights of zero and one: boards, stripes, single cells, or a rough surface cut at a level."""
    y, x = np.indices(shape)
    kind = rng.integers(4)
    if kind == 0:
        high = (y // int(rng.integers(1, 9)) + x // int(rng.integers(1, 9))) % 2 > 0
    elif kind == 1:
        high = x // int(rng.integers(1, 9)) % 2 > 0
    elif kind == 2:
        high = rng.random(shape) < rng.choice([0.5, 0.02, rng.uniform(0.02, 0.98)])
    else:
        high = rc.self_affine(rc.Grid(shape, 1.0, True), 0.8, 1.0, rng).heights > rng.uniform(-1.5, 1.5)
    heights = high * 1.0
    heights[0, 0] = 1 - heights[-1, -1]  # two levels there are
    return heights


def _punch_holes(heights: Array, rng: np.random.Generator) -> None:
    """Leave out some discs and single cells, never all."""
    y, x = np.indices(heights.shape)
    keep = tuple(rng.integers(heights.shape))
    kept = heights[keep]
    for _ in range(int(rng.integers(1, 6))):
        row, column = rng.integers(heights.shape)
        heights[(y - row) ** 2 + (x - column) ** 2 < rng.uniform(0.5, 0.2 * min(heights.shape)) ** 2] = np.nan
    heights[rng.random(heights.shape) < 0.02] = np.nan
    heights[keep] = kept


def _slope(surface: rc.Surface) -> float:
    """Return the root mean square slope; flat surfaces count as nearly flat."""
    steps = [np.diff(surface.heights, axis=a) / d for a, d in enumerate(surface.grid.spacing)]
    squares = [float(np.nanmean(s**2)) for s in steps if np.isfinite(s).any()]
    return math.sqrt(sum(squares)) or 1e-6


def _hardness(surface: rc.Surface, modulus: float, rng: np.random.Generator) -> float:
    """Return from a thousandth to some times the pressure of an elastic surface in full contact."""
    return float(modulus * _slope(surface) * 10 ** rng.uniform(-3, 0.7))


def _loads(
    surface: rc.Surface, modulus: float, hardness: float, rng: np.random.Generator
) -> tuple[str, Array]:
    """Return what is prescribed, and one value, or three that increase."""
    grid, heights = surface.grid, surface.heights
    measured = np.isfinite(heights)
    mean = float(np.nanmax(heights) - heights[measured].mean())
    share = np.sort(rng.uniform(0.05, 1.0, 3))
    share = share / share[-1] if rng.random() < 0.25 else np.ones(1)
    if rng.random() < 0.25 and mean > 0:
        # No elastic period goes deeper than its mean separation; those that give way do.
        most = 0.98 if hardness == math.inf else 1.5
        near = hardness < math.inf and rng.random() < 0.3
        depth = 1 + rng.choice([-1, 1]) * 10 ** rng.uniform(-9, -1) if near else rng.uniform(0.01, most)
        return "depth", mean * depth * share
    if hardness == math.inf:
        # From a single cell to full contact: what every wave at full contact takes is about E* h q/2.
        scale = modulus * np.nanstd(heights) * min(grid.lengths)
        largest = max(3.0 * scale * (1.0 + 0.1 * min(grid.shape)), 1e-6 * modulus * grid.cell_area)
        return "force", 10 ** rng.uniform(-6, 1) * largest * share
    strongest = hardness * grid.cell_area * int(measured.sum())
    part = [10 ** rng.uniform(-4, 0), rng.uniform(0.01, 1.0), 1 - 10 ** rng.uniform(-9, 0)][rng.integers(3)]
    return "force", min(part, 1 - 1e-9) * strongest * share


def judge_pressure(one: Problem, judge: Judge, solution: rc.Solution, load: float) -> float:
    """Return the error of a pressure as a part of what is allowed."""
    depth = load if one.control == "depth" else None
    force = load if depth is None else solution.force
    heights, pressure = one.surface.heights, solution.pressure
    found = judge.certify(heights, pressure, force, depth=depth, hardness=one.hardness)
    scale = float(np.abs(judge.displacement(pressure)).max())
    allowed = TOLERANCE + 2 * KERNEL + (judge.rounding(pressure) / scale if scale > 0 else 0.0)
    # The depth is told to its last place; where much flows, that is more than the displacements.
    off = abs(solution.depth - found.depth) - allowed * scale - 4 * np.finfo(float).eps * abs(found.depth)
    within = 0.0 if off <= 0 else math.inf
    return max(found.residual / allowed, found.force_error / FORCE, within)


def judge_stiffness(one: Problem, judge: Judge, solution: rc.Solution) -> float | None:
    """Return the error of a stiffness as a part of what is allowed; None where the matrix would be too large.

    Cells whose pressure and gap are both less than the certificate tells may be free, or not: the stiffness lies
    between that with none and that with all of them.
    """
    pressure, hardness = solution.pressure, one.hardness
    heights, displacement = one.surface.heights, judge.displacement(solution.pressure)
    gap = displacement + (np.nanmax(heights) - heights - solution.depth)
    told = TOLERANCE * float(np.abs(displacement).max()) + judge.rounding(pressure)
    own, there = judge.own(), np.isfinite(heights)
    at_zero = (own * pressure <= told) & (np.abs(gap) <= told)
    at_hardness = (own * (hardness - pressure) <= told) & (np.abs(gap) <= told)
    edge = there & (at_zero | at_hardness)
    free = (pressure > 0) & (pressure < hardness)
    most = free | edge
    if int(most.sum()) > MATRIX:
        return None
    low, high = judge.punch(free & ~edge, STIFFNESS), judge.punch(most, STIFFNESS)
    k = solution.stiffness
    if low.stiffness <= k <= high.stiffness:
        return 0.0
    nearest = low if k < low.stiffness else high
    return abs(k - nearest.stiffness) / nearest.error if nearest.error > 0 else math.inf


def examine(seed: int, tallies: dict[str, Tally]) -> None:
    """Solve and judge one problem, and add what became of it."""
    one = problem(seed)
    grid, tally = one.surface.grid, tallies[one.kind]
    judge = Judge(grid.shape, grid.spacing, grid.periodic, one.modulus)
    tally.problems += 1
    try:
        solutions = list(one.solutions())
    except Exception as fault:  # whatever it is, there is no answer
        tally.loads, tally.wrong = tally.loads + 1, tally.wrong + 1
        print(f"{seed}: {one.kind}, {grid.shape}: {type(fault).__name__}: {fault}", flush=True)
        return
    for load, solution in zip(one.loads, solutions, strict=True):
        tally.loads += 1
        tally.products = max(tally.products, solution.steps)
        where = f"{seed}: {one.kind}, {grid.shape}, {one.control} {load:.3g}, hardness {one.hardness:.3g}"
        if not solution.status.converged:
            tally.missed += 1
            print(f"{where}: missed, {solution.residual:.1e} after {solution.steps}", flush=True)
            continue
        error, stiffness = judge_pressure(one, judge, solution, load), judge_stiffness(one, judge, solution)
        tally.stiffnesses += stiffness is not None
        worst = max(error, stiffness or 0.0)
        tally.worst = max(tally.worst, worst)
        right = worst <= 1
        tally.certified, tally.wrong = tally.certified + right, tally.wrong + (not right)
        if not right:
            print(
                f"{where}: wrong, pressure {error:.2g}, stiffness {stiffness} of what is allowed", flush=True
            )


def table(tallies: dict[str, Tally]) -> Iterator[str]:
    """Return the lines of the table."""
    yield (
        "| kind | problems | loads | certified | missed | wrong | stiffnesses compared | largest error of what is "
        "allowed | most products |"
    )
    yield "|---|---|---|---|---|---|---|---|---|"
    names = ("problems", "loads", "certified", "missed", "wrong", "stiffnesses")
    rows = sorted(tallies.items())
    total = Tally(**{name: sum(getattr(t, name) for t in tallies.values()) for name in names})
    total.worst = max(t.worst for t in tallies.values())
    total.products = max(t.products for t in tallies.values())
    for kind, t in [*rows, ("all", total)]:
        numbers = " | ".join(str(getattr(t, name)) for name in names)
        yield f"| {kind} | {numbers} | {t.worst:.2g} | {t.products} |"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=5000, help="problems")
    parser.add_argument("--first", type=int, default=0, help="number of the first one")
    given = parser.parse_args()
    tallies: dict[str, Tally] = defaultdict(Tally)
    start = time.perf_counter()
    for seed in range(given.first, given.first + given.count):
        examine(seed, tallies)
    print("\n".join(table(tallies)))
    print(f"\n{given.count} problems from number {given.first} on, {time.perf_counter() - start:.0f} s")
    return int(any(t.wrong for t in tallies.values()))


if __name__ == "__main__":
    sys.exit(main())
