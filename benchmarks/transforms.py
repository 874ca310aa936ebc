"""What a product costs: machine code and slabs against plain transforms, and direct sums against transforms.

OMP_NUM_THREADS=1 python benchmarks/transforms.py; single-threaded, best of several runs, in milliseconds.

python benchmarks/transforms.py --threads: large periodic products on one thread and on two, by SciPy, by ducc0 if it is
installed, and in machine code.
"""

import importlib.util
import sys
import time

import numpy as np
import scipy.fft

from roughcontact import transforms
from roughcontact.grid import Grid
from roughcontact.halfspace.influence.tables import Love, Tables
from roughcontact.halfspace.operators.cell_list import CellsOperator
from roughcontact.threads import limit_threads
from roughcontact.transforms import Convolution, padded_length


def best(function, *arguments, repeats=7):
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        function(*arguments)
        times.append(time.perf_counter() - start)
    return 1e3 * min(times)


def plain(field, whole, padded):
    spectrum = scipy.fft.rfft2(field, padded)
    return scipy.fft.irfft2(spectrum * whole, padded)[: field.shape[0], : field.shape[1]]


def slabs():
    print("a product with an n x n field: plain transforms, and slabs of columns of several widths")
    rng = np.random.default_rng(0)
    for n in (64, 128, 256, 512, 1024):
        padded = (transforms.fast_even_length(2 * n - 2),) * 2
        field, table = rng.random((n, n)), rng.random((n, n))
        multiplier = transforms.even_multiplier(table, padded)
        whole = np.concatenate([multiplier, multiplier[-2:0:-1]])
        row = [f"plain {best(plain, field, whole, padded):7.2f}"]
        for width in (8, 16, 32, 64, 128):
            transforms.SLAB = width
            row.append(f"{width}: {best(transforms.convolve, field, multiplier, padded):7.2f}")
        print(f"{n:6d}  " + "   ".join(row))


def machine():
    print("a product with an n x n field, by SciPy and in machine code: periodic, and padded to 2n")
    rng = np.random.default_rng(0)
    for precision in ("float32", "float64"):
        for n in (64, 128, 256, 512, 1024, 2048):
            row, field = [], rng.random((n, n)).astype(precision)
            for length in (n, 2 * n):
                multiplier = rng.random((length // 2 + 1,) * 2)
                compiled = Convolution(multiplier, (length, length))
                factors = multiplier.astype(precision)
                slow = best(transforms.convolve, field, factors, (length, length))
                row.append(f"{slow:8.2f} {best(compiled.apply, field):8.2f}")
            print(f"{precision} {n:6d}  " + "   ".join(row))


def lookups():
    print("look-ups of the influence table in the time of one cell of the padded box")
    rng = np.random.default_rng(0)
    transforms.SLAB = 32
    for n in (128, 256, 512, 1024):
        padded = (padded_length(n),) * 2
        multiplier = transforms.even_multiplier(rng.random((n, n)), padded)
        transform = best(Convolution(multiplier, padded).apply, rng.random((n, n))) / (4 * n * n)
        influence = Tables(Love((1.0, 1.0), 1.0), (n, n))
        influence.table((n, n))
        cells = np.sort(rng.choice(n * n, 1000, replace=False))
        operator = CellsOperator.of(Grid((n, n), 1.0), influence, cells, True)
        pressure = np.where(rng.random(1000) < 0.25, 1.0, 0.0)
        loaded = np.flatnonzero(pressure)
        lookup = best(operator._by_cells, pressure, loaded) / (1000 * len(loaded))
        print(f"{n:6d}  {transform / lookup:5.2f}")


def threads():
    print("a product with a periodic n x n field, on one thread and on two")
    rng = np.random.default_rng(0)
    for n in (1024, 2048, 4096):
        field, quadrant = rng.random((n, n)), rng.random((n // 2 + 1, n // 2 + 1))
        whole = quadrant[np.minimum(np.arange(n), n - np.arange(n))]
        compiled = Convolution(quadrant, (n, n))

        def by_scipy(count, field=field, whole=whole):
            with scipy.fft.set_workers(count):
                return plain(field, whole, field.shape)

        def by_ducc0(count, field=field, whole=whole):
            import ducc0

            spectrum = ducc0.fft.r2c(field, axes=(0, 1), nthreads=count)
            spectrum *= whole
            back = {"lastsize": field.shape[1], "forward": False, "inorm": 2, "nthreads": count}
            return ducc0.fft.c2r(spectrum, axes=(0, 1), **back)

        def here(count, field=field, compiled=compiled):
            with limit_threads(count):
                return compiled.apply(field)

        ways = {"SciPy": by_scipy, "machine code": here}
        if importlib.util.find_spec("ducc0") is not None:
            ways["ducc0"] = by_ducc0
        row = []
        for name, way in ways.items():
            np.testing.assert_allclose(way(2), here(1), atol=1e-9)
            one, two = best(way, 1), best(way, 2)
            row.append(f"{name} {one:6.1f} {two:6.1f} ({one / two:.2f} times)")
        print(f"{n:6d}  " + "   ".join(row))


if __name__ == "__main__":
    if "--threads" in sys.argv:
        threads()
    else:
        machine()
        slabs()
        lookups()
