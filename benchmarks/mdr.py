"""How fast rough lines are: the thesis' run for its figure 22, one long line, and power laws of a thousand lines.

python benchmarks/mdr.py [figure22|profile|long|laws] ...; without a word all of them. Set OMP_NUM_THREADS=1.
"""

import multiprocessing
import sys
import time
from concurrent.futures import ProcessPoolExecutor

import numpy as np
from suite.quiet import waited

import roughcontact as rc
from roughcontact.mdr.lines.line_curves import LineCurves
from roughcontact.mdr.lines.random_lines import line_heights, random_waves, rough_lines
from roughcontact.mdr.lines.rough_line import loading_curves

ROUNDS = 9
BATCH = 500  # lines at a time: results that fit into memory that is there already
# Figure 22 of the thesis, "generated in 4 seconds".
HURST = np.linspace(0, 2, 11)
LINES, POINTS = 1500, 500
FORCES = np.geomspace(1e-7, 1e1, 400)  # over E* h L; the thesis does not say which


def stiffness(lines, seed, energy=False):
    """Return the sum over the lines of the springs in contact for every Hurst exponent, shape (11, 400)."""
    grid = rc.Grid(POINTS, 1 / POINTS)
    spectra = [rc.SelfAffineSpectrum(hurst, dimension=1) for hurst in HURST]
    total = np.zeros((HURST.size, FORCES.size), dtype=np.int64)
    phases = random_waves(grid, np.random.default_rng(seed), lines)
    for waves in np.array_split(phases, -(-lines // BATCH)):
        for sums, spectrum in zip(total, spectra, strict=True):
            heights = line_heights(grid, spectrum, waves, rms=1.0)
            curves = loading_curves(heights, 1 / POINTS, 1.0, forces=FORCES, energy=energy)
            sums += curves.springs.sum(axis=0)
    return total


def on_one_core():
    return stiffness(LINES, 0)


def with_energy():
    return stiffness(LINES, 0, energy=True)


def on_two_cores():
    """Half of the lines in each of two new processes."""
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("fork")) as pool:
        return sum(pool.map(stiffness, [LINES // 2] * 2, [0, 1]))


def figure22():
    print(f"figure 22: {HURST.size} Hurst exponents, {LINES} lines of {POINTS} points, {FORCES.size} forces")
    print("from random numbers to depth and stiffness of every line; the thesis reports 4 s")
    runs = (on_two_cores, on_one_core, with_energy)
    times = {run: [] for run in runs}
    for run in runs:
        run()
    for _ in range(ROUNDS):  # in turn, so that what else goes on falls on all
        for run, seconds in times.items():
            before, processor, begin = waited(), time.process_time(), time.perf_counter()
            run()
            wall = time.perf_counter() - begin
            seconds.append((wall, time.process_time() - processor, waited() - before))
    for run, seconds in times.items():
        wall, processor, waiting = np.transpose(seconds)
        print(f"  {run.__name__:13s} median {np.median(wall):.3f} s, fastest {min(wall):.3f} s", end="")
        if run is on_two_cores:
            print(", processes and all")
        else:
            print(f"; processor {np.median(processor):.3f} s, waited for it {np.median(waiting):.3f} s")


def profile():
    """Print what the parts of a run for one Hurst exponent cost on one core."""
    grid, rng = rc.Grid(POINTS, 1 / POINTS), np.random.default_rng(0)
    spectrum = rc.SelfAffineSpectrum(0.8, dimension=1)
    waves = random_waves(grid, rng, LINES)
    heights = line_heights(grid, spectrum, waves, rms=1.0)
    block = np.sort(heights[:65], axis=1)  # as much as `loading_curves` works on at once
    parts = {
        "phases": lambda: random_waves(grid, rng, LINES),
        "heights": lambda: line_heights(grid, spectrum, waves, rms=1.0),
        "curves": lambda: loading_curves(heights, 1 / POINTS, 1.0, forces=FORCES),
        "no energy": lambda: loading_curves(heights, 1 / POINTS, 1.0, forces=FORCES, energy=False),
        "  sort": lambda: [np.sort(heights[i : i + 65], axis=1) for i in range(0, LINES, 65)],
        "  one sum": lambda: [np.cumsum(block, axis=1) for _ in range(LINES // 65)],
        "  search": lambda: [line.searchsorted(FORCES[::-1]) for line in heights],
    }
    print(f"milliseconds for {LINES} lines of {POINTS} points and {FORCES.size} forces, fastest of 20")
    for name, part in parts.items():
        times = []
        for _ in range(20):
            start = time.thread_time()
            part()
            times.append(time.thread_time() - start)
        print(f"  {name:10s} {1e3 * min(times):6.1f}")


def long():
    print("one line of 1e6 points at 1000 forces, H = 0.8")
    grid = rc.Grid(10**6, 1e-6)
    spectrum = rc.SelfAffineSpectrum(0.8, dimension=1)
    times = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        [heights] = rough_lines(grid, spectrum, np.random.default_rng(0), 1, rms=1.0)
        middle = time.perf_counter()
        loading_curves(heights, 1e-6, 1.0, forces=np.geomspace(1e-7, 1e1, 1000))
        times.append((middle - start, time.perf_counter() - middle))
    made, solved = np.median(times, axis=0)
    print(f"  median: generation {made:.3f} s, curve {solved:.3f} s")


def laws():
    points, count = 2**13, 1000
    print(
        f"power laws of {count} lines of {points} points, 25 forces from 1e-5 to 0.07, more than 20 springs"
    )
    print("    H   arithmetic: alpha     zeta       geometric: alpha     zeta       scatter     s")
    grid = rc.Grid(points, 1 / points)
    forces = np.geomspace(1e-5, 0.07, 25)
    for hurst in (0, 0.2, 0.4, 0.6, 0.8, 1, 1.2, 1.4, 1.6, 1.8, 2, 2.5, 3):
        start = time.perf_counter()
        spectrum = rc.SelfAffineSpectrum(hurst, dimension=1)
        batches = rough_lines(grid, spectrum, np.random.default_rng(0), count, rms=1.0)
        curves = LineCurves.joined(
            loading_curves(heights, 1 / points, 1.0, forces=forces) for heights in batches
        )
        row = ""
        for mean in ("arithmetic", "geometric"):
            fit = curves.fit(mean)
            row += f"   {fit.exponent:.4f}({1e4 * fit.exponent_error:2.0f})"
            row += f"  {fit.prefactor:.3f}({1e3 * fit.prefactor_error:2.0f})  "
        scatter = curves.scatter[curves.resolved()]
        seconds = time.perf_counter() - start
        print(f"{hurst:5.1f} {row}  {scatter.min():.2f}..{scatter.max():.2f} {seconds:6.2f}")


if __name__ == "__main__":
    for part in sys.argv[1:] or ("figure22", "profile", "long", "laws"):
        {"figure22": figure22, "profile": profile, "long": long, "laws": laws}[part]()
