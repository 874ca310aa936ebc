"""Loops of an interface under shear: forty from the normal curve, and one by partial slip beside them.

python benchmarks/shear_cycles.py [cells [Poisson's ratio [steps]]]   by default 256 cells a side, 0.3, 10 steps

The map is periodic, with an eighth of the side as the longest wave and four cells as the shortest, at 5 % contact. A
cycle by partial slip has five times the given number of steps.
"""

from __future__ import annotations

import sys
import time

import numpy as np

import roughcontact as rc

FRICTION, AREA, AMPLITUDE = 0.3, 0.05, 0.5
PER_DECADE = 10


def main(cells: int, nu: float, steps: int) -> None:
    """Print times, losses and differences."""
    grid = rc.Grid((cells, cells), 1.0 / cells, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-3, rng=1, rolloff=1 / 8, short_cutoff=4 / cells)
    bodies = (rc.Solid(1.0, nu), rc.Solid(1.0, nu))
    pressure = 1e-3
    for _ in range(3):  # the area is nearly proportional to the pressure
        pressure *= AREA / rc.press(surface, bodies, pressure=pressure).contact_fraction

    start = time.perf_counter()
    loads = pressure * np.append(np.logspace(-2, 0, 2 * PER_DECADE + 1), 1 - AMPLITUDE)
    law = rc.shear_law(rc.loading_curve(surface, bodies, pressures=np.sort(loads)), bodies, friction=FRICTION)
    print(f"{len(loads)} loads: {time.perf_counter() - start:.1f} s")
    start = time.perf_counter()
    pressures, shares = pressure * np.linspace(0.3, 1, 8), np.linspace(0.3, 0.9, 5)
    loops = [law.cycle(p, traction=part * FRICTION * p) for p in pressures for part in shares]
    print(f"{len(loops)} loops from the normal curve: {time.perf_counter() - start:.2f} s")

    solution = rc.press(surface, bodies, pressure=pressure)
    start = time.perf_counter()
    cycle = rc.shear_cycle(
        solution, bodies, friction=FRICTION, traction=AMPLITUDE * FRICTION * pressure, steps=steps, law=law
    )
    seconds = time.perf_counter() - start
    print(
        f"first loading and a loop of {4 * steps} steps by partial slip at {100 * solution.contact_fraction:.1f} % "
        f"contact: {seconds:.1f} s, loss {cycle.loop.loss:.5g}, damping {cycle.loop.damping:.5f}, "
        f"K/K_t {cycle.stiffness_ratio:.4f}, balance {cycle.balance:.0e}, closure {cycle.closure:.0e}"
    )
    differences = ", ".join(f"{name} {100 * value:.2f} %" for name, value in cycle.differences.items())
    print(f"the law from the normal curve differs: {differences}")


if __name__ == "__main__":
    given = dict(enumerate(sys.argv[1:]))
    main(int(given.get(0, 256)), float(given.get(1, 0.3)), int(given.get(2, 10)))
