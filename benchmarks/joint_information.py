"""How much information stiffness holds about a surface: the numbers of `docs/concepts/what-stiffness-shows.md`.

    python benchmarks/joint_information.py

First k(F) of one free square of the ensemble E1 (800 squares, 512 x 512 cells, cut at random): Hurst exponent and rms
height by the fitted power law, and how often the interval of the fit holds the truth. Then K(p) of a joint: the width
of ln h_eff by Fisher's information of the emulator.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray

import roughcontact as rc
from roughcontact.measurement.joint_emulator import joint_emulator
from roughcontact.theory import rough_square

E1 = Path(__file__).resolve().parents[1] / "reproduction" / "data" / "law" / "e1-surfaces.nc"
HURST = (0.4, 0.7, 1.0)
Z90 = 1.645
MODULUS, RMS, ROLLOFF = 115e9, 1e-6, 1e-4


def one_square() -> None:
    """Print what k(F) of one specimen gives."""
    with xarray.open_dataset(E1, engine="h5netcdf") as data:
        log_f = np.log(data["dimensionless_force"].to_numpy().astype(float))
        curves = {
            h: np.log(data["dimensionless_stiffness"].sel(hurst=h).to_numpy().astype(float)) for h in HURST
        }
    grid = np.linspace(0.1, 2.95, 2000)
    exponents, prefactors = (
        rough_square.exponent(grid, cut="period"),
        rough_square.prefactor(grid, cut="period"),
    )
    design = np.stack([np.ones_like(log_f), log_f], axis=1)
    pseudo = np.linalg.pinv(design)
    for hurst, curve in curves.items():
        whole = np.isfinite(curve).all(axis=1)
        fits = curve[whole] @ pseudo.T
        noise = np.sqrt(((curve[whole] - fits @ design.T) ** 2).sum(axis=1) / (log_f.size - 2))
        alpha, error = fits[:, 1], noise * np.sqrt((pseudo[1] ** 2).sum())
        found = np.interp(-alpha, -exponents, grid)
        heights = (np.log(np.interp(found, grid, prefactors)) - fits[:, 0]) / alpha  # over the true one
        held = np.abs(alpha - np.interp(hurst, grid, exponents)) < Z90 * error
        low, middle, high = np.quantile(found, [0.05, 0.5, 0.95])
        print(
            f"H = {hurst}: {whole.sum()} squares, H {middle:.2f} ({low:.2f} to {high:.2f}), sd {found.std():.2f}; sd "
            f"of ln h {heights.std():.2f}; 90 % intervals of the fit hold the truth in {held.mean():.0%}"
        )


def joint() -> None:
    """Print what K(p) of a joint gives."""
    topography = rc.JointTopography(RMS, 1.0, ROLLOFF, 0.3)
    p = np.geomspace(3e-3, 0.03, 5) * MODULUS * RMS / ROLLOFF
    areas = np.array([64.1, 256.0, 1024.0]) * ROLLOFF**2
    exact = {"errors": 1e-3, "gain": 0.0, "modulus_error": 1e-3}
    for name, given in (("stiffness and modulus exact", exact), ("5 % a load, gain 3 %, modulus 2 %", None)):
        values = given or {"errors": 0.05, "gain": 0.03, "modulus_error": 0.02}
        plan = rc.plan_joint(p, modulus=MODULUS, areas=areas, specimens=(1,), profile=topography, **values)
        print(f"sd of ln h_eff at 64, 256, 1024 l^2, {name}:", np.round(plan.width[:, 0], 3))
    emulator = joint_emulator()
    at = np.log([0.01, 0.1, 1.0])
    one = np.full((1, 3), 0.0) + at
    for side in (8.0, 16.0, 32.0):
        _, covariance = emulator.at(np.array([0.8]), np.array([side]), np.array([6.0]), one)
        print(f"sd of ln K of specimens of {side**2:.0f} l^2 at p l/(E* h) = 0.01, 0.1, 1:", end=" ")
        print(np.round(np.sqrt(np.diagonal(covariance[0])), 3))


if __name__ == "__main__":
    one_square()
    joint()
