"""Flow through the gaps of six maps: the numbers of docs/concepts/gap-flow.md.

python benchmarks/gap_flow.py             anisotropy, two theories, and the area at which the path closes
python benchmarks/gap_flow.py wide        the same with waves of L/4 to L/32, on 256 x 256 cells
python benchmarks/gap_flow.py 1024        seconds of one direction with both bounds, on that many cells a side, at 10
                                          and at 40 % contact
"""

from __future__ import annotations

import sys
import time

import numpy as np

import roughcontact as rc
from roughcontact.theory.joints.leakage import bruggeman, critical_constriction

SEEDS = range(6)
# Cells a side, shortest wave over L, and pressures over E* at an rms height of 0.01 L.
NARROW, WIDE = (64, 1 / 8, (0.005, 0.02, 0.035)), (256, 1 / 32, (0.01, 0.035, 0.06))


def rough(cells: int, seed: int, periodic: bool = True, shortest: float = 1 / 8) -> rc.Surface:
    """Return a surface of H = 0.8 with waves from L/4, L = 1."""
    rng, grid = np.random.default_rng(seed), rc.Grid((cells, cells), 1 / cells, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=0.01, rng=rng, rolloff=0.25, short_cutoff=shortest)
    return surface if periodic else rc.Surface(surface.heights, rc.Grid(grid.shape, grid.spacing))


def statistics(cells: int, shortest: float, pressures: tuple[float, ...]) -> None:
    """Print means and standard deviations over the maps."""
    surfaces = [rough(cells, seed, shortest=shortest) for seed in SEEDS]
    print(
        "| P/E* | A/A0 | ratio along both axes | Bruggeman/computation | threshold 0.42 | Persson/computation |"
    )
    print("|---|---|---|---|---|---|")
    for pressure in pressures:
        rows = []
        for surface in surfaces:
            solution = rc.press(surface, 1.0, pressure=pressure)
            flow = rc.gap_flow(solution)
            exact = sum(np.trace(each) for each in flow.interval) / 4
            theory = [bruggeman(flow.gap**3, threshold=each) / exact for each in (0.5, 0.42)]
            place = critical_constriction(pressure, 1.0, rc.power_spectrum(surface))
            theory.append(0.0 if place is None else place.transmissivity / exact)
            tensor = flow.transmissivity
            rows.append((solution.contact_fraction, tensor[0, 0] / tensor[1, 1], *theory))
        mean, scatter = np.mean(rows, axis=0), np.std(rows, axis=0, ddof=1)
        texts = [f"{a:.2f} +- {b:.2f}" for a, b in zip(mean, scatter, strict=True)]
        print(f"| {pressure:g} | {' | '.join(texts)} |", flush=True)
    closing = [rc.sealing_load(surface, 1.0, ratio=1e-3).contact_fractions[0] for surface in surfaces]
    print("the path closes at A/A0 =", ", ".join(f"{area:.3f}" for area in closing))


def pressure_for(surface: rc.Surface, area: float, within: float = 1e-4) -> float:
    """Return the pressure over E* at which the relative contact area has a value, by bisection."""
    low, high = 0.001, 0.2
    while True:
        middle = (low * high) ** 0.5
        found = rc.press(surface, 1.0, pressure=middle).contact_fraction
        if abs(found - area) <= within or high < 1.0001 * low:
            return middle
        low, high = (middle, high) if found < area else (low, middle)


def seconds(cells: int) -> None:
    """Print the time of one direction at two contact areas."""
    surface = rough(cells, 3, periodic=False)
    for area in (0.1, 0.4):
        pressure = pressure_for(rough(min(cells, 256), 3, periodic=False), area)
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
    match sys.argv[1:]:
        case []:
            statistics(*NARROW)
        case ["wide"]:
            statistics(*WIDE)
        case [cells]:
            seconds(int(cells))
