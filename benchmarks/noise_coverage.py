"""How often the truth lies within the errors by noise: the numbers of docs/concepts/noise-errors.md.

Known surfaces are pressed without noise, which gives the truth, and with noise. For each number the program prints the
true bias over the error that is stated without a correction, and the share of surfaces whose truth lies within one and
two errors: from the spread only, and from spread and bias of `rc.error_budget`.
"""

from __future__ import annotations

import sys

import numpy as np

import roughcontact as rc
from roughcontact.evaluation.error_noise import errors_of_noise
from roughcontact.evaluation.error_numbers import NUMBERS, number_table
from roughcontact.validation import Array

CELLS, SHORTEST, RMS = 48, 6, 1e-7  # cells along a side and of the shortest wave; rms height [m]
NOISE = (0.003, 0.01, 0.03, 0.1)  # of the rms height
SHOWN = (
    "depth",
    "mean_gap",
    "elastic_energy",
    "interfacial_stiffness",
    "contact_area",
    "corrected_contact_area",
)
# Boundary, correlation length of the noise [cells], and pressure [Pa], at which A/A0 is about 0.2 or 0.05.
CASES = ((True, 0.0, 4e6), (False, 0.0, 1e6), (True, 3.0, 4e6))


def one(seed: int, periodic: bool, noise: rc.Noise, pressure: float) -> Array:
    """Return truth, value of the noisy map, correction, spread and part of the bias, shape (5, numbers)."""
    grid = rc.Grid((CELLS, CELLS), 1e-6, periodic=periodic)
    waves = {"rolloff": CELLS / 4 * 1e-6, "short_cutoff": SHORTEST * 1e-6}
    surface = rc.self_affine(grid, hurst=0.8, rms=RMS, rng=np.random.default_rng(seed), **waves)
    noisy = rc.Surface(surface.heights + noise.draw(grid, np.random.default_rng([seed, 1])), grid)
    solutions = [rc.press(each, 1e9, pressure=pressure) for each in (surface, noisy)]
    found = errors_of_noise(solutions[1:], noise)
    return np.array([*number_table(solutions).T, found.correction, *found.parts])


def coverage(truth: Array, value: Array, error: Array) -> str:
    """Return the shares of truths within one and two errors [%]."""
    within = np.abs(value - truth) / error
    return " / ".join(f"{100 * np.mean(within < many):.0f}" for many in (1, 2))


def main(surfaces: int) -> None:
    """Print a table for each case: nominal shares are 68 and 95 %."""
    for periodic, cells, pressure in CASES:
        length = f", correlation length {cells:g} cells" if cells else ""
        print(f"\n{'periodic' if periodic else 'free'}, {pressure:.0e} Pa{length}, {surfaces} surfaces")
        print(
            "| noise [% of rms] | number | error [%] | true bias [errors] | corrected | spread only | with bias |"
        )
        print("|---|---|---|---|---|---|---|", flush=True)
        for part in NOISE:
            noise = rc.Noise(part * RMS, cells * 1e-6)
            found = np.array([one(seed, periodic, noise, pressure) for seed in range(surfaces)])
            for name in SHOWN:
                truth, value, correction, spread, left = found[:, :, NUMBERS.index(name)].T
                error = np.hypot(spread, left)
                texts = (
                    f"{100 * part:g}",
                    name.replace("_", " "),
                    f"{100 * np.mean(error / value):.2g}",
                    f"{np.mean(value - truth) / np.mean(spread):+.1f}",
                    f"{100 * np.mean(correction != 0):.0f} %",
                    coverage(truth, value, spread),
                    coverage(truth, value + correction, error),
                )
                print(f"| {' | '.join(texts)} |", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100)
