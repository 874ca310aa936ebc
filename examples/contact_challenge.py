"""The surface of the contact-mechanics challenge, pressed and let go while it sticks: a recipe with a seed.

Mueser and others, Tribol. Lett. 65, 118 (2017): a periodic square of 0.1 mm, whose spectrum is flat down to waves of
20 um and falls with the Hurst exponent 0.8 to waves of 0.1 um, of rms slope 1, against a solid of E* = 25 MPa; work
of adhesion 50 mJ/m^2, range 2.07 nm, nominal pressure 250 kPa. Irwin's length is 0.7 nm, for which 0.1 mm would take
220 000 cells a side. So two things differ here, and are told: a periodic square of --side takes the place of the
whole, with those waves of its spectrum that fit; and the range is at least the shortest that the cells resolve.

    python examples/contact_challenge.py [--side 5e-7] [--cells 128] [--seed 1] [--range 2.07e-9]
    python examples/contact_challenge.py --file published.nc    # any file that roughcontact reads
"""

import argparse
import math

import numpy as np

import roughcontact as rc
from roughcontact.theory import pastewka_robbins, persson_tosatti, waves

MODULUS, WORK, RANGE, PRESSURE = 25e6, 0.05, 2.07e-9, 250e3  # Pa, J/m^2, m, Pa
RESOLVED = 1.501  # cells in Irwin's length, of the 1.5 that are asked for


def recipe(side, cells, seed):
    """Return a periodic square [m] with those waves of the challenge that fit into it."""
    shape = rc.SelfAffineSpectrum(0.8, rolloff=20e-6, long_cutoff=1e-4, short_cutoff=1e-7)
    spectrum = shape.scaled(1e-6 / shape.scaled(1e-6).moments().rms_slope)  # rms slope 1 of the whole
    grid = rc.Grid((cells, cells), side / cells, periodic=True)
    return rc.synthesise(grid, spectrum, np.random.default_rng(seed))


def main():
    """Press the surface with and without adhesion, and print what it says."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--side", type=float, default=5e-7, help="of the square [m]")
    parser.add_argument("--cells", type=int, default=128, help="of its side")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--range", type=float, default=RANGE, help="of the attraction [m], if it is resolved")
    parser.add_argument("--file", help="a surface to take instead of the recipe's, taken for periodic")
    given = parser.parse_args()
    own = rc.read(given.file, periodic=True) if given.file else None
    surface = own or recipe(given.side, given.cells, given.seed)
    grid = surface.grid
    shortest = math.sqrt(RESOLVED * max(grid.spacing) * math.pi * WORK / MODULUS)
    adhesion = rc.Adhesion(work=WORK, range=max(given.range, shortest))
    roughness = waves.Waves.of_heights(surface.heights, grid.spacing)
    summit = 2 / math.sqrt(8 / 3 * roughness.m4)  # radius, from the rms Laplacian
    sides = " x ".join(f"{length * 1e6:.3g}" for length in grid.lengths)
    print(f"{' x '.join(map(str, grid.shape))} cells, {sides} um, rms slope {roughness.rms_slope:.3f}")
    print(
        f"range {adhesion.range * 1e9:.2f} nm, {adhesion.range / RANGE:.2f} of the challenge's: Tabor's number of a "
        f"summit {adhesion.tabor(summit, MODULUS):.3f}, not {rc.Adhesion(WORK, RANGE).tabor(summit, MODULUS):.3f}"
    )
    left = persson_tosatti.effective_work(roughness, MODULUS, WORK)
    sticky = pastewka_robbins.stickiness(roughness, MODULUS, WORK, adhesion.range)
    print(
        f"stickiness by Pastewka and Robbins {sticky:.2f}, by Persson and Tosatti {1e3 * left:.1f} mJ/m^2 left"
    )
    force = PRESSURE * grid.area
    plain = rc.press(surface, MODULUS, force=force)
    print(
        f"without adhesion {PRESSURE / 1e3:.1f} kPa: contact {plain.contact_fraction:.4f}, "
        f"mean gap {plain.mean_gap * 1e9:.2f} nm"
    )
    shares = np.array([0, 0.5, 1, 0.5, 0])
    states = rc.adhesive_path(surface, MODULUS, adhesion, forces=shares * force)
    for share, state in zip(shares, states, strict=True):
        lost = math.fsum(jump.lost for jump in state.jumps)
        print(
            f"{share * PRESSURE / 1e3:5.1f} kPa: contact {state.contact_fraction:.4f}, mean gap "
            f"{state.mean_gap * 1e9:.2f} nm, stability {state.stability:.3f}, residual {state.residual:.0e}; "
            f"{len(state.jumps)} jumps lost {lost:.1e} J"
        )


if __name__ == "__main__":
    main()
