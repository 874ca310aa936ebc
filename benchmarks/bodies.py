"""Random contacts of other bodies than half-spaces by transforms, iterated throughout: how many products they take.

    python benchmarks/bodies.py [problems of each kind] [first]

Rings, lines, layers, springs and full matrices. Small contacts of these are factorised; here that is forbidden, so that
preconditioners and steps have to do without. Prints the hardest of each kind; ends with 1 if one missed its tolerance.
"""

from __future__ import annotations

import sys
from collections.abc import Callable

import numpy as np

import roughcontact as rc

ITERATED = rc.ActiveSet(dense_limit=0)
Random = np.random.Generator


def pressed(surface: rc.Surface, operator: rc.Operator, force: float) -> rc.Solution:
    """Press without a factorisation; E* is that of the operator, one."""
    return rc.press(surface, 1.0, force=force, operator=operator, solver=ITERATED)


def rings(rng: Random) -> rc.Solution:
    """Press a ball, a cone or a wavy body of revolution."""
    grid = rc.RadialGrid.uniform(int(rng.integers(20, 500)), 1.0)
    wavy = 0.02 * rng.standard_normal(len(grid.radii)).cumsum() / np.sqrt(len(grid.radii))
    shapes = (-(grid.radii**2) / 2, -grid.radii, wavy - grid.radii**2 / rng.uniform(1, 100))
    profile = rc.RadialProfile(shapes[rng.integers(3)], grid)
    return rc.press(profile, 1.0, force=10 ** rng.uniform(-4, 1), solver=ITERATED)


def line(rng: Random, *, periodic: bool) -> rc.Solution:
    """Press a rough line."""
    cells = int(rng.integers(30, 3000))
    rough = rc.self_affine(rc.Grid(cells, 1 / cells, periodic), rng.uniform(-0.5, 2.0), 0.01, rng)
    return pressed(rough, rc.line(rough.grid, 1.0), 10 ** rng.uniform(-4, 0))


def springs(rng: Random) -> rc.Solution:
    """Press a rough line on springs."""
    cells = int(rng.integers(30, 3000))
    rough = rc.self_affine(rc.Grid(cells, 1 / cells), rng.uniform(0.0, 1.0), 0.01, rng)
    return pressed(rough, rc.foundation(rough.grid, 1.0), 10 ** rng.uniform(-5, -1))


def layer(rng: Random) -> rc.Solution:
    """Press a rough surface on a layer, thin to thick."""
    cells, solid = int(rng.integers(16, 100)), rc.Solid(1.0, 0.3)
    grid = rc.Grid((cells, cells), 1 / cells, bool(rng.integers(2)))
    rough = rc.self_affine(grid, rng.uniform(-0.5, 2.0), 0.01, rng)
    base = ("bonded", "rigid-frictionless")[rng.integers(2)]
    body = rc.layer(grid, solid, 10 ** rng.uniform(-2, 0), base=base)
    return rc.press(rough, solid, force=10 ** rng.uniform(-5, 0), operator=body, solver=ITERATED)


def matrix(rng: Random) -> rc.Solution:
    """Press a rough surface whose influences are all there."""
    cells = int(rng.integers(8, 40))
    grid = rc.Grid((cells, cells), 1 / cells)
    rough = rc.self_affine(grid, rng.uniform(-0.5, 2.0), 0.01, rng)
    return pressed(rough, rc.half_space(grid, 1.0, method="dense"), 10 ** rng.uniform(-5, 0))


KINDS: dict[str, Callable[[Random], rc.Solution]] = {
    "rings": rings,
    "line": lambda rng: line(rng, periodic=False),
    "periodic line": lambda rng: line(rng, periodic=True),
    "springs": springs,
    "layer": layer,
    "full matrix": matrix,
}


def main() -> int:
    given = [int(text) for text in sys.argv[1:]]
    count, first = given + [500, 0][len(given) :]
    failed = 0
    for kind, press in KINDS.items():
        steps: list[tuple[int, int]] = []
        for seed in range(first, first + count):
            try:
                steps.append((press(np.random.default_rng(seed)).steps, seed))
            except rc.ConvergenceError as error:
                failed += 1
                print(f"{kind}, problem {seed}: {error}")
        if steps:
            most, hardest = max(steps)
            middle = np.median([taken for taken, _ in steps])
            print(f"{most:6d} products at most, {middle:.0f} in the middle: {kind} (problem {hardest})")
    print(f"{count} of each kind, {failed} missed their tolerance")
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
