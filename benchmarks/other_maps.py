"""Whether one map shows how much others differ: python benchmarks/other_maps.py. A table of docs/concepts/errors.md.

For each kind of surface, 40 maps are pressed by one nominal pressure. Their relative standard deviation is what the
line "sampling" of an error budget estimates from the four quarters of each.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

import roughcontact as rc
from roughcontact.evaluation import other_maps
from roughcontact.evaluation.error_numbers import NUMBERS, number_table

MODULUS, SIDE, CELLS, SEEDS = 1e9, 1e-3, 128, 40
SHORTEST = 8  # cells
NAMES = {
    "interfacial_stiffness": "K",
    "stiffness": "k",
    "contact_area": "A",
    "mean_gap": "mean gap",
    "elastic_energy": "energy",
    "depth": "depth",
}
ROWS = [NUMBERS.index(name) for name in NAMES]


def maps(hurst: float, waves: int, periodic: bool, area: float) -> Iterator[rc.Solution]:
    """Yield maps of one surface with so many of its longest waves along a side, under one nominal pressure."""
    pressure = 0.0
    for seed in range(SEEDS):
        grid = rc.Grid((CELLS, CELLS), SIDE / CELLS, periodic=periodic)
        cuts = {"rolloff": SIDE / waves if waves > 1 else None, "short_cutoff": SHORTEST * SIDE / CELLS}
        surface = rc.self_affine(grid, hurst, 1e-6, np.random.default_rng(seed), **cuts)
        if not periodic:
            surface = surface.levelled()
        if seed == 0:  # A/A0 = 2 p/(E* h')
            slopes = np.gradient(surface.heights, *grid.spacing)
            pressure = area / 2 * MODULUS * math.sqrt(sum(np.mean(each**2) for each in slopes))
        yield rc.press(surface, MODULUS, pressure=pressure)


def main() -> None:
    """Print for each kind of surface the scatter between maps and that which single maps show."""
    other_maps.SPOTS = 1  # to show why there is a limit
    print(f"| surface | spots | {' | '.join(NAMES.values())} | K within a factor of 3 | bias of size of K |")
    print(f"|{'---|' * (4 + len(NAMES))}")
    ratios: dict[bool, list[float]] = {False: [], True: []}
    for waves in (1, 4, 8):
        for hurst in (0.8, 0.3):
            for periodic in (False, True):
                for area in (0.005, 0.03):
                    solutions = list(maps(hurst, waves, periodic, area))
                    numbers = number_table(solutions)[ROWS]
                    true = numbers.std(axis=1, ddof=1) / numbers.mean(axis=1)
                    found = [other_maps.sampling_of(each) for each in solutions]
                    shown = np.transpose([each.parts[ROWS] for each in found]) / numbers
                    usual = np.sqrt(np.mean(shown**2, axis=1))
                    for solution, ratio in zip(solutions, shown[0] / true[0], strict=True):
                        ratios[solution.spots.count >= 10].append(float(ratio))
                    near = np.mean((shown[0] > true[0] / 3) & (shown[0] < 3 * true[0]))
                    bias = np.mean([each.bias_of_size["interfacial_stiffness_per_area"] for each in found])
                    spots = np.median([each.spots.count for each in solutions])
                    cells = [f"{100 * a:.0f}, {100 * b:.0f}" for a, b in zip(true, usual, strict=True)]
                    kind = f"H = {hurst:g}, {'periodic' if periodic else 'free'}, {waves} waves, {area:g}"
                    print(
                        f"| {kind} | {spots:.0f} | {' | '.join(cells)} | {100 * near:.0f} % | {100 * bias:+.0f} % |",
                        flush=True,
                    )
    for many, each in ratios.items():
        low, middle, high = np.quantile(each, (0.1, 0.5, 0.9))
        rms, near = (
            math.sqrt(np.mean(np.square(each))),
            np.mean((np.array(each) > 1 / 3) & (np.array(each) < 3)),
        )
        print(
            f"\n{len(each)} maps with {'ten spots and more' if many else 'fewer than ten spots'}: K shown over true, "
            f"root mean square {rms:.2f}, median {middle:.2f}, a tenth below {low:.2f}, a tenth above {high:.2f}, "
            f"within a factor of 3 {100 * near:.0f} %"
        )


if __name__ == "__main__":
    main()
