"""Peak memory of loads beyond their surface, in bytes a cell (on Linux): the table of `memory_needed`.

python benchmarks/memory.py [n [body]]

Each case is pressed in a process of its own, on n x n cells, on a line of as many cells, or on n rings. Light loads
touch in one cell or a few, heavy ones everywhere.
"""

import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import roughcontact as rc

Body = Callable[[rc.Grid], Any]
PLANES: dict[str, tuple[Any, Body | None]] = {
    "free": (False, None),
    "periodic": (True, None),
    "singly periodic": ((True, False), None),
    "layer, free": (False, lambda grid: rc.layer(grid, 1.0, 0.1, base="rigid-frictionless")),
    "layer, periodic": (True, lambda grid: rc.layer(grid, 1.0, 0.1, base="rigid-frictionless")),
}
LINES: dict[str, tuple[Any, Body | None]] = {
    "line, free": (False, lambda grid: rc.line(grid, 1.0)),
    "line, periodic": (True, lambda grid: rc.line(grid, 1.0)),
    "foundation": (False, lambda grid: rc.foundation(grid, 1.0)),
}
BODIES = PLANES | LINES | {"rings": (False, None)}
LIGHT, HEAVY = 1e-9, 10.0  # nominal pressure over E* [-]


def peak() -> int:
    found = re.search(r"VmHWM:\s*(\d+) kB", Path("/proc/self/status").read_text())
    assert found is not None
    return int(found[1]) * 1024


def rough(body: str, n: int) -> rc.Surface | rc.RadialProfile:
    if body == "rings":
        rings = rc.RadialGrid.uniform(n, radius=1.0)
        return rc.RadialProfile(-(rings.radii**2) / 20, rings)
    periodic, _ = BODIES[body]
    grid = rc.Grid(n * n, 1 / n**2, periodic) if body in LINES else rc.Grid((n, n), 1 / n, periodic)
    return rc.self_affine(grid, 0.8, 0.01, np.random.default_rng(0))


def load(body: str, surface: rc.Surface | rc.RadialProfile, pressures: list[float]) -> rc.Solution | rc.Curve:
    make = BODIES[body][1]
    operator = None if make is None else make(surface.grid)
    if len(pressures) == 1:
        return rc.press(surface, 1.0, pressure=pressures[0], operator=operator)
    return rc.loading_curve(surface, 1.0, pressures=pressures, operator=operator)


def measure(body: str, n: int, pressures: list[float]) -> None:
    load(body, rough(body, 16), pressures)  # whatever is loaded late is loaded now
    surface = rough(body, n)
    Path("/proc/self/clear_refs").write_text("5")  # what the making of the surface took does not count
    before = peak()
    answer = load(body, surface, pressures)
    used = peak() - before
    touching = float(np.max(answer.contact_area)) / surface.grid.area
    what = "press" if len(pressures) == 1 else "curve"
    print(f"{body:16s} {what} {touching:9.2%} in contact: {used / n**2:5.0f} bytes a cell", flush=True)


if __name__ == "__main__":
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 1024
    if len(sys.argv) > 3:
        measure(sys.argv[2], n, [float(word) for word in sys.argv[3:]])
    for body in BODIES if len(sys.argv) == 2 else sys.argv[2:3]:
        for loads in ([LIGHT], [HEAVY], [LIGHT, 2 * LIGHT], [HEAVY / 2, HEAVY]):
            command = [sys.executable, __file__, str(n), body, *map(str, loads)]
            if len(sys.argv) <= 3:
                subprocess.run(command, check=True)
