"""How many products problems take: `python tests/products.py` stores it, where a change of method is meant.

Once as it is, and once with `ROUGHCONTACT_CPU=off`: without machine code the numbers are others. A product is the
displacement of cells under a pressure on them. Solves are made of products, and unlike seconds their number is the same
everywhere, but for rounding: `python tests/products.py 100 projected` tells how far it moves those of the cases named
so, in a hundred draws. Surfaces are made by NumPy alone, see `references.py`: of rms height 1, on cells of side 1. The
modulus is 1.
"""

import csv
import inspect
import sys
from collections.abc import Callable
from contextlib import contextmanager
from functools import wraps
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

import roughcontact as rc
from references import rough
from roughcontact.kernels import loader

STORE = Path(__file__).with_suffix(".csv")
ITERATED = {"solver": rc.ActiveSet(dense_limit=0)}
PROJECTED = {"solver": rc.PolonskyKeer()}
STEEL = rc.Solid(1.0, 0.3)
LOADS = np.geomspace(1e-3, 0.2, 10)
DEPTHS = np.linspace(0.5, 2.5, 10)


class Count(NamedTuple):
    """What a task takes.

    Attributes
    ----------
    products : int
        On cells of the size that was asked for, on any part of them.
    coarse : int
        On larger cells.
    matrices : int
        Between two cells or more: one for each factorisation that begins from nothing.
    cells : int
        Of all those products that are not on larger cells, together: too large a window is a cost.
    """

    products: int
    coarse: int
    matrices: int
    cells: int


class Task(NamedTuple):
    """What is to be done with an operator."""

    run: Callable[[Any], Any]
    operator: Any


def linear_maps():
    """Return the classes of the library that displace cells under a pressure: they have weights."""
    for name, module in list(sys.modules.items()):
        for kind in list(vars(module).values()) if name.startswith("roughcontact.") else ():
            own = inspect.isclass(kind) and kind.__module__ == name and "apply" in vars(kind)
            if own and "weights" in {*dir(kind), *getattr(kind, "__dataclass_fields__", ())}:
                yield kind


def cell_area(operator):
    """Return the area of a cell, by which larger cells are told; None of rings, which have no larger ones."""
    return float(operator.weights) if np.ndim(operator.weights) == 0 else None


@contextmanager
def noted():
    """Note the area of a cell and the number of cells of each product and each matrix, not of those within others."""
    products, matrices, inside = [], [], False

    def noting(method, notes):
        @wraps(method)
        def wrapper(operator, *given):
            nonlocal inside
            if inside:
                return method(operator, *given)
            notes.append((cell_area(operator), np.size(given[0]) if given else operator.grid.size))
            inside = True
            try:
                return method(operator, *given)
            finally:
                inside = False

        return wrapper

    with pytest.MonkeyPatch.context() as patch:
        for kind in linear_maps():
            for name, notes in (("apply", products), ("as_matrix", matrices)):
                if name in vars(kind):
                    patch.setattr(kind, name, noting(vars(kind)[name], notes))
        yield products, matrices


def count(task):
    """Return what a task takes."""
    with noted() as (products, matrices):
        task.run(task.operator)
    fine = [cells for area, cells in products if area == cell_area(task.operator)]
    return Count(len(fine), len(products) - len(fine), sum(cells > 1 for _, cells in matrices), sum(fine))


def body(grid, operator, hurst=0.8):
    """Return a rough surface and an operator on a grid."""
    kind = rc.RadialProfile if isinstance(grid, rc.RadialGrid) else rc.Surface
    return kind(-rough(grid.shape, hurst, np.random.default_rng([20, *grid.shape])), grid), operator(grid)


def plane(n, hurst=0.8, periodic=False, method="fft"):
    return body(rc.Grid((n, n), 1.0, periodic), lambda grid: rc.half_space(grid, 1.0, method=method), hurst)


def singly_periodic():
    return body(rc.Grid((24, 40), 1.0, (True, False)), lambda grid: rc.singly_periodic(grid, 1.0))


def layer(base):
    return body(rc.Grid((40, 40), 1.0), lambda grid: rc.layer(grid, STEEL, 5.0, base=base))


def line(periodic=False):
    return body(rc.Grid(900, 1.0, periodic), lambda grid: rc.line(grid, 1.0))


def rings():
    return body(rc.RadialGrid.uniform(200, 1.0), lambda grid: rc.ring(grid, 1.0))


def press(body, **given):
    surface, operator = body
    return Task(lambda operator: rc.press(surface, 1.0, operator=operator, **given), operator)


def curve(body, **given):
    surface, operator = body
    return Task(lambda operator: rc.loading_curve(surface, 1.0, operator=operator, **given), operator)


def loop(body, **given):
    surface, operator = body
    return Task(lambda operator: rc.loading_loop(surface, 1.0, operator=operator, **given), operator)


def full(body):
    """Return the depth at which all cells of a periodic surface are in contact."""
    return -float(body[0].heights.mean())


def punch(body):
    """Find the stiffness of half of the cells, the higher ones."""
    (surface, operator), grid = body, body[0].grid
    region = surface.heights > np.median(surface.heights)
    return Task(lambda operator: rc.contact_stiffness(region, grid, 1.0, operator=operator), operator)


def slide():
    """Pull at a pressed contact, more and more."""
    surface, _ = plane(48)
    pressed, forces = rc.press(surface, STEEL, force=1.0), 0.3 * np.linspace(0.1, 0.9, 9)
    given = {"friction": 0.3, "forces": forces}
    operator = rc.shear_half_space(surface.grid, STEEL)
    return Task(lambda operator: rc.slide_curve(pressed, STEEL, operator=operator, **given), operator)


# From a cell in a thousand to nearly all of them in contact: all ways to solve have their turn.
CASES = {
    "free by force": lambda: press(plane(256), force=77.0),
    "free by depth": lambda: press(plane(256), depth=3.0),
    "free with few cells": lambda: press(plane(256), force=5.0),
    "free and rougher": lambda: press(plane(200, 0.3), force=20.0),
    "free iterated": lambda: press(plane(64), force=3.2, **ITERATED),
    "free projected": lambda: press(plane(64), force=3.2, **PROJECTED),
    "free under a hardness": lambda: press(plane(64), force=3.2, hardness=0.1),
    "free on levels": lambda: press(plane(64, method="multilevel"), force=3.2),
    "periodic by pressure": lambda: press(plane(256, periodic=True), pressure=8e-4),
    "periodic by depth": lambda: press(whole := plane(256, periodic=True), depth=0.6 * full(whole)),
    "periodic nearly full": lambda: press(whole := plane(256, 0.2, True), depth=0.9 * full(whole)),
    "small periodic nearly full": lambda: press(whole := plane(128, 0.2, True), depth=0.9 * full(whole)),
    "singly periodic": lambda: press(singly_periodic(), force=3.0),
    "singly periodic iterated": lambda: press(singly_periodic(), force=3.0, **ITERATED),
    "layer": lambda: press(layer("bonded"), force=2.0),
    "layer iterated": lambda: press(layer("bonded"), force=2.0, **ITERATED),
    "line": lambda: press(line(), force=0.3),
    "line iterated": lambda: press(line(), force=0.3, **ITERATED),
    "periodic line iterated": lambda: press(line(periodic=True), force=0.3, **ITERATED),
    "rings": lambda: press(rings(), force=20.0),
    "rings iterated": lambda: press(rings(), force=20.0, **ITERATED),
    "free punch": lambda: punch(plane(96)),
    "periodic punch": lambda: punch(plane(96, periodic=True)),
    "curve by forces": lambda: curve(plane(128), forces=128 * LOADS),
    "curve by depths": lambda: curve(plane(128), depths=DEPTHS),
    "curve by forces iterated": lambda: curve(plane(64), forces=64 * LOADS, **ITERATED),
    "curve by depths iterated": lambda: curve(plane(64), depths=DEPTHS, **ITERATED),
    "curve by depths projected": lambda: curve(plane(64), depths=DEPTHS, **PROJECTED),
    "curve under a hardness": lambda: curve(plane(64), forces=64 * LOADS, hardness=0.1),
    "loop": lambda: loop(plane(64), forces=64 * LOADS, hardness=0.1),
    "periodic curve by pressures": lambda: curve(plane(128, periodic=True), pressures=LOADS / 20),
    "periodic curve by depths": lambda: curve(
        whole := plane(128, periodic=True), depths=np.linspace(0.25, 0.95, 10) * full(whole)
    ),
    "singly periodic curve": lambda: curve(singly_periodic(), forces=32 * LOADS),
    "layer curve": lambda: curve(layer("rigid-frictionless"), forces=40 * LOADS),
    "line curve": lambda: curve(line(), forces=10 * LOADS),
    "line curve iterated": lambda: curve(line(), forces=10 * LOADS, **ITERATED),
    "rings curve": lambda: curve(rings(), forces=200 * LOADS),
    "sliding curve": slide,
}


def machine_code():
    """Return the column of the table that tells whether there is machine code: without, there are no tiles."""
    return "yes" if loader.is_available() else "no"


def spread(case, draws):
    """Return the least and the most counts of a case where heights move by a transform's rounding."""
    exact, counts = rough, []
    for draw in range(draws):
        signs = np.random.default_rng(draw)

        def rounded(*given, signs=signs):
            heights = exact(*given)
            return heights * (1 + 16 * np.finfo(float).eps * signs.integers(-1, 2, heights.shape))

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(sys.modules[__name__], "rough", rounded)
            counts.append(count(CASES[case]()))
    return Count(*map(min, *counts)), Count(*map(max, *counts))


def stored():
    """Return the table: counts by case and machine code."""
    with STORE.open(encoding="utf-8", newline="") as file:
        return {(case, code): Count(*map(int, counts)) for case, code, *counts in list(csv.reader(file))[1:]}


def store():
    """Count anew, and store the table."""
    table = stored() if STORE.exists() else {}
    table |= {(case, machine_code()): count(make()) for case, make in CASES.items()}
    with STORE.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["case", "machine code", *Count._fields])
        writer.writerows([*row, *table[row]] for row in sorted(table) if row[0] in CASES)


if __name__ == "__main__":
    if given := sys.argv[1:]:
        for case in CASES:
            if all(word in case for word in given[1:]):
                least, most = spread(case, int(given[0]))
                sys.stdout.write(f"{case}\n    {least}\n    {most}\n")
    else:
        store()
