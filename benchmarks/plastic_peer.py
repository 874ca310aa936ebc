"""Plastic contact beside ContactMechanics' plastic topography: at the largest load, and after unloading to half of it.

    python benchmarks/plastic_peer.py [cells] [seed]

Both read flow alike: where the pressure is at the hardness, the surface loses what the flat stands below it. The
surface is pressed once, flattened by that, and pressed again elastically.
"""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import numpy.typing as npt
from ContactMechanics import PeriodicFFTElasticHalfSpace
from ContactMechanics.Factory import make_plastic_system
from ContactMechanics.Optimization import constrained_conjugate_gradients
from SurfaceTopography import PlasticTopography, Topography

import roughcontact as rc

MODULUS, SPACING = 1e11, 1e-6
PRESSURE = 1e8
HARDNESSES = (1e9, 3e9, 8e9)
PENETRATION = 1e-9  # of the rms height: what the other may leave open

Array = npt.NDArray[np.float64]


def ours(surface: rc.Surface, hardness: float) -> tuple[Array, Array, Array]:
    """Return the pressure at the largest load, the flattened heights, and the pressure at half the load [Pa], [m]."""
    loaded = rc.press(surface, MODULUS, pressure=PRESSURE, hardness=hardness)
    depth = np.where(loaded.pressure >= hardness * (1 - 1e-9), np.maximum(-loaded.gap, 0.0), 0.0)
    flattened = rc.Surface(surface.heights - depth, surface.grid)
    unloaded = rc.press(flattened, MODULUS, pressure=PRESSURE / 2)
    return loaded.pressure, flattened.heights, unloaded.pressure


def theirs(surface: rc.Surface, hardness: float) -> tuple[Array, Array, Array]:
    """Return the same of ContactMechanics."""
    lengths = tuple(n * SPACING for n in surface.grid.shape)
    area = surface.grid.area
    settings: dict[str, Any] = {
        "pentol": PENETRATION * surface.rms,
        "forcetol": np.inf,
        "maxiter": 20_000,
    }
    substrate = PeriodicFFTElasticHalfSpace(surface.grid.shape, MODULUS, lengths)
    plastic = PlasticTopography(Topography(surface.heights, lengths, periodic=True), hardness)
    loaded = make_plastic_system(substrate=substrate, surface=plastic).minimize_proxy(
        external_force=PRESSURE * area, **settings
    )
    flattened = np.asarray(plastic.heights())
    unloaded = constrained_conjugate_gradients(
        PeriodicFFTElasticHalfSpace(surface.grid.shape, MODULUS, lengths),
        Topography(flattened, lengths, periodic=True),
        external_force=PRESSURE / 2 * area,
        **settings,
    )
    if not (loaded.success and unloaded.success):
        print(f"ContactMechanics: {loaded.message}; {unloaded.message}")
    cell = SPACING**2
    return np.maximum(loaded.jac, 0) / cell, flattened, np.maximum(unloaded.jac, 0) / cell


def main(cells: int, seed: int) -> None:
    """Print how far both are apart."""
    grid = rc.Grid((cells, cells), SPACING, periodic=True)
    surface = rc.self_affine(
        grid,
        hurst=0.8,
        rms=4e-7,
        rng=np.random.default_rng(seed),
        short_cutoff=8 * SPACING,
        rolloff=cells * SPACING / 4,
    )
    print(
        f"{cells} x {cells}, rms slope {rc.surface_moments(surface).rms_slope:.3f}, p = E*/{MODULUS / PRESSURE:g}"
    )
    print(
        "hardness/E*   plastic cells   state      cells in contact   largest difference of pressure / mean in contact"
    )
    for hardness in HARDNESSES:
        a, b = ours(surface, hardness), theirs(surface, hardness)
        flowed = int((surface.heights - a[1] > 0).sum())
        for state, p, q in (("loaded", a[0], b[0]), ("unloaded", a[2], b[2])):
            in_contact = f"{int((p > 0).sum())} and {int((q > 0).sum())}"
            apart = float(np.abs(p - q).max() / p[p > 0].mean())
            print(f"{hardness / MODULUS:<13.3g} {flowed:<15d} {state:<10} {in_contact:<18} {apart:.1e}")
        change = surface.heights - a[1]
        apart = float(np.abs(a[1] - b[1]).max() / change.max())
        print(
            f"{'':29} flattened: largest difference {apart:.1e} of the deepest flow, "
            f"{change.max() / surface.rms:.3f} rms"
        )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 128, int(sys.argv[2]) if len(sys.argv) > 2 else 1)
