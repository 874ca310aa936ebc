"""What more cores bring: one load of a periodic plane by one thread and by several, in turn.

    python benchmarks/cores.py [--sizes 1024 2048 4096] [--threads 2] [--rounds 5]

Waves of a quarter of the side down to eight cells, about 4 % in contact. Each round has a process for each number of
threads; the seconds are medians, in brackets the least. Beside them SciPy's transform of a plane of that size and back,
in single precision, which shows what the machine gives to several threads that share its memory.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np
import scipy.fft

import roughcontact as rc

PRESSURE = 0.02  # over E*, with an rms height of a hundredth of the side
TIMES = 3


def least(work: Callable[[], object]) -> float:
    seconds = []
    for _ in range(TIMES):
        start = time.perf_counter()
        work()
        seconds.append(time.perf_counter() - start)
    return min(seconds)


def measure(n: int, threads: int) -> tuple[float, float]:
    """Return the seconds of a load and of a transform and back."""
    rng = np.random.default_rng(0)
    rc.press(rc.self_affine(rc.Grid((256, 256), 1 / 256, True), 0.8, 0.01, rng), 1.0, pressure=1e-3)
    surface = rc.self_affine(
        rc.Grid((n, n), 1 / n, True), 0.8, 0.01, rng, long_cutoff=0.25, short_cutoff=8 / n
    )
    plane = surface.heights.astype(np.float32)

    def there_and_back() -> object:
        return scipy.fft.irfft2(scipy.fft.rfft2(plane, workers=threads), workers=threads)

    return least(lambda: rc.press(surface, 1.0, pressure=PRESSURE)), least(there_and_back)


def main() -> None:
    """Measure in processes of their own."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--sizes", type=int, nargs="+", default=[1024, 2048, 4096])
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--one", type=int, nargs=2, metavar=("SIZE", "THREADS"), help=argparse.SUPPRESS)
    asked = parser.parse_args()
    if asked.one:
        print(*measure(*asked.one))
        return
    for n in asked.sizes:
        found: dict[int, list[list[float]]] = {1: [], asked.threads: []}
        for _ in range(asked.rounds):
            for threads, seconds in found.items():
                one = [sys.executable, __file__, "--one", str(n), str(threads)]
                environment = os.environ | {"OMP_NUM_THREADS": str(threads)}
                told = subprocess.run(one, env=environment, capture_output=True, text=True, check=True)
                seconds.append([float(word) for word in told.stdout.split()])
        rows = [list(zip(*seconds, strict=True)) for seconds in found.values()]
        (alone, several), (fft_alone, fft_several) = zip(*rows, strict=True)
        print(
            f"{n}^2: {statistics.median(alone):.2f} ({min(alone):.2f}) s by one thread,"
            f" {statistics.median(several):.2f} ({min(several):.2f}) s by {asked.threads},"
            f" {statistics.median(alone) / statistics.median(several):.2f} times as fast; SciPy's transform"
            f" {statistics.median(fft_alone) / statistics.median(fft_several):.2f}",
            flush=True,
        )


if __name__ == "__main__":
    main()
