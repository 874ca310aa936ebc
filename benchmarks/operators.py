"""The ways to sum a half-space over its cells: error, time, memory, and how time grows with the number of cells.

python benchmarks/operators.py [--sizes 256,512,1024,2048] [--lines 4096,65536,1048576] [--repeats 7]

Under pressure on a plane and on a line, and under tangential traction (shear: two components, nu = 0.3).

One thread. A time is the median processor time of a product: what other programs do meanwhile is not in it, nor is the
first product, for which tables are made. Memory is the most that is allocated at a time, as Python and NumPy tell it,
from before the operator is made to after its first product. Every measurement runs in a process of its own. The error
is the largest of several pressures that do not vanish at the edges, relative to the largest displacement: against the
matrix where there is one, else against the transforms. The matrix and the moving grid are measured on few cells, and
their times on many follow from the square of the number.
"""

import argparse
import json
import os
import subprocess
import sys
import time
import tracemalloc
from dataclasses import replace

os.environ |= {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}

import numpy as np
from pairs import without

import roughcontact as rc
from roughcontact.halfspace.operators.dense import DenseOperator
from roughcontact.halfspace.sums import levels, near_sum
from roughcontact.halfspace.sums.multilevel import Multilevel

# For the matrix, and for the moving grid.
SMALL = {"plane": (16, 32, 64), "shear": (16, 32, 48), "line": (256, 1024, 4096)}
MIDDLE = {"plane": (64, 128, 256), "shear": (48, 96, 144), "line": (4096, 16384, 65536)}
SETTINGS = ((4, 4), (6, 6), (8, 8), (8, 10), (10, 14), (12, 16))


def operator(geometry, method, n):
    if geometry == "plane":
        return rc.half_space(rc.Grid((n, n), 1.0), 1.0, method=method)
    if geometry == "shear":
        return rc.shear_half_space(rc.Grid((n, n), 1.0), rc.Solid(1.0, 0.3), method=method)
    if method == "dense":
        return DenseOperator(rc.Grid(n, 1.0), rc.line(rc.Grid(n, 1.0), 1.0).as_matrix())
    return rc.line(rc.Grid(n, 1.0), 1.0, method=method)


def shape_of(geometry, n):
    return {"plane": (n, n), "shear": (2, n, n), "line": (n,)}[geometry]


def pressures(shape):
    rng = np.random.default_rng(0)
    edges = np.zeros(shape)
    for axis in range(-min(2, len(shape)), 0):
        np.moveaxis(edges, axis, 0)[[0, -1]] = 1.0
    slope = sum(np.meshgrid(*(np.linspace(1, 2, n) for n in shape), indexing="ij"))
    scattered = np.where(rng.random(shape) < 0.01, rng.random(shape), 0.0)
    return [rng.random(shape), np.ones(shape), slope, edges, scattered]


def seconds(function, argument, repeats):
    times = []
    for _ in range(repeats):
        start = time.thread_time()
        function(argument)
        times.append(time.thread_time() - start)
    return float(np.median(times))


def measure(geometry, method, n, repeats):
    """Print what is found as JSON, in a process of its own."""
    few = 600 if geometry == "line" else 32
    operator(geometry, method, few).apply(np.ones(shape_of(geometry, few)))  # to load what is loaded late
    pressure = np.random.default_rng(0).random(shape_of(geometry, n))
    tracemalloc.start()
    operator(geometry, method, n).apply(pressure)
    found = {"bytes": tracemalloc.get_traced_memory()[1]}
    tracemalloc.stop()
    start = time.thread_time()
    subject = operator(geometry, method, n)
    subject.apply(pressure)
    found["first"] = time.thread_time() - start
    found["seconds"] = seconds(subject.apply, pressure, repeats)
    reference = operator(geometry, "dense" if n in SMALL[geometry] else "fft", n)
    if n in SMALL[geometry] or method == "multilevel":
        found["error"] = max(error(subject, reference, p) for p in pressures(pressure.shape))
    print(json.dumps(found))


def error(subject, reference, pressure):
    exact = reference.apply(pressure)
    return float(np.abs(subject.apply(pressure) - exact).max() / np.abs(exact).max())


def table(geometry, sizes, repeats):
    print(f"\n{geometry:12s}      n       cells   product [s]    first [s]  bytes/cell      error")
    for method in ("dense", "moving-grid", "multilevel", "fft"):
        few = {"dense": SMALL, "moving-grid": MIDDLE}.get(method)
        own = few[geometry] if few else sorted({SMALL[geometry][-1], *sizes})
        cells, times = [], []
        for n in own:
            arguments = [
                sys.executable,
                __file__,
                "--one",
                geometry,
                method,
                str(n),
                "--repeats",
                str(repeats),
            ]
            answer = subprocess.run(arguments, capture_output=True, text=True, check=True).stdout
            found = json.loads(answer)
            count = n if geometry == "line" else n * n
            off = f"{found['error']:10.1e}" if "error" in found else "         -"
            print(
                f"{method:12s}{n:8d}{count:12d}{found['seconds']:14.3e}{found['first']:13.3e}"
                f"{found['bytes'] / count:12.0f} {off}"
            )
            if few or n in sizes:
                cells.append(count)
                times.append(found["seconds"])
        exponent = np.polyfit(np.log(cells), np.log(times), 1)[0]
        line = f"{'':12s}grows as the number of cells to the {exponent:.2f}"
        if few:
            largest = max(sizes) ** (1 if geometry == "line" else 2)
            line += f"; by the square, from {cells[-1]} to {largest}: {times[-1] * (largest / cells[-1]) ** 2:.1e} s"
        print(line)


def settings(n, repeats):
    print(
        f"\nmultilevel at {n} x {n}: error against the transforms, a product with and without machine code [s]"
    )
    free = rc.half_space(rc.Grid((n, n), 1.0), 1.0)
    fields = pressures(free.grid.shape)
    for order, near in SETTINGS:
        subject = replace(free, summation=Multilevel(order, near))
        off = max(error(subject, free, p) for p in fields)
        fast = seconds(subject.apply, fields[0], repeats)
        with without(levels, "add_near", near_sum.add_near_by_products):
            slow = seconds(subject.apply, fields[0], repeats)
        print(f"order {order:2d}, near {near:2d}: {off:.1e}   {fast:.3e}   {slow:.3e}")


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--sizes", default="256,512,1024,2048")
    parser.add_argument("--lines", default="4096,65536,1048576")
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--one", nargs=3, help=argparse.SUPPRESS)
    chosen = parser.parse_args()
    if chosen.one:
        geometry, method, n = chosen.one
        measure(geometry, method, int(n), chosen.repeats)
        return
    for geometry in ("plane", "shear"):
        table(geometry, [int(n) for n in chosen.sizes.split(",")], chosen.repeats)
    table("line", [int(n) for n in chosen.lines.split(",")], chosen.repeats)
    settings(512, chosen.repeats)


if __name__ == "__main__":
    main()
