"""Flow through the gaps of six maps: the numbers of docs/concepts/gap-flow.md.

python benchmarks/gap_flow.py           anisotropy, Bruggeman's theory, and the area at which the path closes
python benchmarks/gap_flow.py 1024      seconds of one direction with both bounds, on that many cells a side
"""

from __future__ import annotations

import sys
import time

import numpy as np

import roughcontact as rc
from roughcontact.theory.joints.leakage import bruggeman

SEEDS, CELLS, PRESSURES = range(6), 64, (0.005, 0.02, 0.035)  # pressures over E*, at an rms height of 0.01 L


def rough(cells: int, seed: int, periodic: bool = True) -> rc.Surface:
    """Return a surface of H = 0.8 with waves of L/4 to L/8, L = 1."""
    rng, grid = np.random.default_rng(seed), rc.Grid((cells, cells), 1 / cells, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=rng, rolloff=0.25, short_cutoff=1 / 8)
    return surface if periodic else rc.Surface(surface.heights, rc.Grid(grid.shape, grid.spacing))


def closing(surface: rc.Surface) -> float:
    """Return the relative contact area at which the open cells cease to percolate, by bisection of the pressure."""
    low, high, area = 0.03, 0.2, 0.0
    while high - low > 1e-4:
        middle = 0.5 * (low + high)
        solution = rc.press(surface, 1.0, pressure=middle)
        if rc.gap_flow(solution).percolates:
            low, area = middle, solution.contact_fraction
        else:
            high = middle
    return area


def statistics() -> None:
    """Print means and standard deviations over the maps."""
    surfaces = [rough(CELLS, seed) for seed in SEEDS]
    print("| P/E* | A/A0 | ratio along both axes | theory/computation | the same, threshold 0.42 |")
    print("|---|---|---|---|---|")
    for pressure in PRESSURES:
        rows = []
        for surface in surfaces:
            solution = rc.press(surface, 1.0, pressure=pressure)
            flow = rc.gap_flow(solution)
            exact = sum(np.trace(each) for each in flow.interval) / 4
            theory = [bruggeman(flow.gap**3, threshold=each) / exact for each in (0.5, 0.42)]
            tensor = flow.transmissivity
            rows.append((solution.contact_fraction, tensor[0, 0] / tensor[1, 1], *theory))
        mean, scatter = np.mean(rows, axis=0), np.std(rows, axis=0, ddof=1)
        texts = [f"{a:.2f} +- {b:.2f}" for a, b in zip(mean, scatter, strict=True)]
        print(f"| {pressure:g} | {' | '.join(texts)} |", flush=True)
    print("the path closes at A/A0 =", ", ".join(f"{closing(surface):.3f}" for surface in surfaces))


def seconds(cells: int) -> None:
    """Print the time of one direction at two contact areas."""
    surface = rough(cells, 3, periodic=False)
    for pressure in (0.012, 0.055):
        solution = rc.press(surface, 1.0, pressure=pressure)
        _ = solution.gap
        start = time.perf_counter()
        flow = rc.gap_flow(solution, axis=0)
        print(
            f"A/A0 {solution.contact_fraction:.2f}: transmissivity {flow.transmissivity[0, 0]:.4g} m^3, bounds within "
            f"{flow.residual:.0e}, {time.perf_counter() - start:.1f} s",
            flush=True,
        )


if __name__ == "__main__":
    seconds(int(sys.argv[1])) if len(sys.argv) > 1 else statistics()
