"""Constants of two criteria of stickiness, against contacts without attraction and Persson's theory.

    python benchmarks/stickiness.py [--points 1024] [--waves 16 32]

Of Pastewka and Robbins, for contact fractions of some 2 and 5 %: kappa; the mean chord of the spots times h''/h',
which they take for 4; the area whose gap is below a range over the length of the edge and the width d_att of that
mean chord; and the ratio of attracted area to contact over that of the criterion with d_rep = 4 h'/h''. The edge
is that of cells, times pi/4. Of Ciavarella's model: the constant of the reaction, p/(E* q0 h) exp(u/u0), and u0/h,
by Persson's theory.
"""

from __future__ import annotations

import argparse
import math

import numpy as np

import roughcontact as rc
from roughcontact.theory.adhesive import pastewka_robbins
from roughcontact.theory.persson_theory import persson_separation
from roughcontact.theory.random_surfaces.waves import Waves

RANGES = (0.01, 0.03, 0.1)  # over h' d_rep


def edge(contact: np.ndarray) -> float:
    """Return the length of the edges of contact, in cells: that along rows and columns, times pi/4."""
    sides = sum(np.count_nonzero(contact != np.roll(contact, 1, axis)) for axis in (0, 1))
    return math.pi / 4 * sides


def contacts(points: int, wave: int) -> None:
    """Print the constants of Pastewka and Robbins on one surface."""
    grid = rc.Grid((points, points), 1.0, periodic=True)
    generator = np.random.default_rng(wave)
    surface = rc.self_affine(
        grid, hurst=0.8, rms=1.0, long_cutoff=points / 8, short_cutoff=wave, rng=generator
    )
    waves = Waves.of_heights(surface.heights, grid.spacing)
    slope, chord = waves.rms_slope, pastewka_robbins.contact_diameter(waves)
    for share in (0.02, 0.05):
        pressure = share * slope / 2
        solution = rc.press(surface, 1.0, force=pressure * points**2)
        area, length = np.count_nonzero(solution.contact), edge(solution.contact)
        diameter = math.pi * area / length
        kappa = area / points**2 * slope / pressure
        print(f"{wave:5d} {share:5.2f} {kappa:7.2f} {4 * diameter / chord:12.2f}", end="  ")
        for ratio in RANGES:
            reach = ratio * slope * diameter
            band = np.count_nonzero((solution.gap < reach) & ~solution.contact)
            width = pastewka_robbins.attracted_width(slope, diameter, reach)
            criterion = math.pi * pastewka_robbins.attracted_width(slope, chord, reach) / chord
            print(f"  {band / (length * width):5.2f} {band / area / criterion:5.2f}", end="")
        print()


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--points", type=int, default=1024)
    parser.add_argument("--waves", type=int, nargs="+", default=[16, 32], help="shortest wave, in cells")
    given = parser.parse_args()
    print("wave  load   kappa  d_rep h''/h'   width and attracted area over the criterion's:", RANGES)
    for wave in given.waves:
        contacts(given.points, wave)
    for gamma in (0.45, 0.5, 1.0):
        spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1.0, short_cutoff=0.01).scaled(1e-3)
        prefactor = persson_separation.reference_pressure(1.0, spectrum, gamma=gamma) / (2 * math.pi * 1e-3)
        decay = persson_separation.decay_length(spectrum, gamma=gamma) / 1e-3
        print(f"gamma {gamma}: {prefactor:.2f} E* q0 h exp(-u/({decay:.2f} h))")


if __name__ == "__main__":
    main()
