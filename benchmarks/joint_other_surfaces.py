"""How often the intervals of `rc.infer_joint` hold the truth, on joints of other surfaces than those of its model.

    python benchmarks/joint_other_surfaces.py [curves.nc]  # a file keeps the curves; 15 minutes of a core

The first 50 designs of `joint_calibration.py`, on each kind of surface. All kinds have the same rms heights, roll-off
wavelengths, moduli and errors of measurement.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import numpy.typing as npt
import xarray
from joint_calibration import LOADS, inferred, measured, specimens

import roughcontact as rc

JOINTS = 50
HEIGHT = 1e-3  # rms height over roll-off wavelength; the equations are linear in it
LOGNORMAL = 0.31416  # standard deviation of the logarithm of a lognormal number whose skewness is 1

Array = npt.NDArray[np.float64]


def gaussian(grid: rc.Grid, hurst: float, band: float, seed: int) -> rc.Surface:
    """Return a surface of the model."""
    return rc.self_affine(grid, hurst, HEIGHT, seed, rolloff=1, short_cutoff=1 / band, amplitudes="gaussian")


def skewed(sign: int, *design: rc.Grid | float) -> rc.Surface:
    """Return the surface of the model with its heights made lognormal, of skewness +1 or -1 and the same rms height."""
    rough = gaussian(*design)  # type: ignore[arg-type]
    z, growth = sign * rough.heights / HEIGHT, np.exp(LOGNORMAL**2)
    heights = sign * HEIGHT * (np.exp(LOGNORMAL * z) - np.sqrt(growth)) / np.sqrt(growth * (growth - 1))
    return rc.Surface(heights, rough.grid)


def stretched(grid: rc.Grid, hurst: float, band: float, seed: int) -> rc.Surface:
    """Return a surface of the model, stretched along x and shrunk along y by the root of two."""
    limits = {"rolloff": 1, "short_cutoff": 1 / band}
    return rc.self_affine(grid, hurst, HEIGHT, seed, anisotropy=(2, 0), amplitudes="gaussian", **limits)


def smooth(kind: str, grid: rc.Grid, _: float, band: float, seed: int) -> rc.Surface:
    """Return a surface with a Gaussian or an exponential autocorrelation, without waves below l/band."""

    def spectrum(q: Array) -> Array:
        x = (q / (2 * np.pi)) ** 2  # 1 at the roll-off
        shape = np.exp(-x) if kind == "Gaussian" else (1 + x) ** -1.5
        return np.where(x <= band**2, shape, 0.0)

    return rc.synthesise(grid, spectrum, seed, rms=HEIGHT, amplitudes="gaussian")


KINDS = {
    "as the model": gaussian,
    "skewness +1": lambda *design: skewed(1, *design),
    "skewness -1": lambda *design: skewed(-1, *design),
    "anisotropy 2": stretched,
    "Gaussian autocorrelation": lambda *design: smooth("Gaussian", *design),
    "exponential autocorrelation": lambda *design: smooth("exponential", *design),
}


def computed(designs: xarray.Dataset, nodes: Array) -> xarray.DataArray:
    """Return K l/(E* A0) of all kinds, shape (kind, joint, load)."""
    found = np.empty((len(KINDS), JOINTS, nodes.size))
    for k, make in enumerate(KINDS.values()):
        for j in range(JOINTS):
            points, side, hurst, band = (
                designs[name].values[j] for name in ("points", "side", "hurst", "band")
            )
            grid = rc.Grid((points, points), side / points, periodic=True)
            surface = make(grid, float(hurst), float(band), j)
            curve = rc.loading_curve(surface, 1.0, pressures=nodes * HEIGHT)
            found[k, j] = curve.interfacial_stiffness_per_area
        print(f"computed: {list(KINDS)[k]}", flush=True)
    return xarray.DataArray(found, dims=("kind", "joint", "load"), coords={"kind": list(KINDS)})


def row(sides: Array, curves: Array, nodes: Array) -> list[float]:
    """Return flagged share, coverage of 50 and 90 %, bias of ln h_eff with its standard error, and its scatter."""
    rng = np.random.default_rng(1)  # the same measurements of all kinds
    ranks, departures = [], []
    for side, curve in zip(sides, curves, strict=True):
        truth, p, stiffness = measured(float(side), curve, nodes, rng)
        try:
            found = inferred(p, stiffness)
        except rc.InputError:
            continue  # beyond the emulator
        if found.fits:
            height = float(np.exp(np.array([found.exponent, 1 - found.exponent]) @ truth))
            ranks.append(found.share_below(height))
            departures.append(np.log(found.effective_height / height))
    inside = [np.mean(abs(np.array(ranks) - 0.5) < share / 2) for share in (0.5, 0.9)]
    spread = np.std(departures, ddof=1)
    return [1 - len(ranks) / len(sides), *inside, np.mean(departures), spread / len(ranks) ** 0.5, spread]


def main() -> None:
    """Run it."""
    parser = argparse.ArgumentParser()
    parser.add_argument("curves", type=Path, nargs="?")
    kept = parser.parse_args().curves
    designs = specimens(None).isel(row=slice(JOINTS))
    nodes = designs["pressure"].to_numpy()[LOADS].astype(float)
    if kept is not None and kept.exists():
        curves = xarray.load_dataarray(kept, engine="h5netcdf")
    else:
        curves = computed(designs, nodes)
        if kept is not None:
            curves.to_netcdf(kept, engine="h5netcdf")
    print("| surface | refused | 50 % | 90 % | bias of ln h_eff | scatter |\n|---|---|---|---|---|---|")
    for name in KINDS:
        refused, half, most, bias, error, spread = row(
            designs["side"].to_numpy(), curves.sel(kind=name).to_numpy(), nodes
        )
        print(
            f"| {name} | {refused:.0%} | {half:.0%} | {most:.0%} | {bias:+.3f} ± {error:.3f} | {spread:.3f} |"
        )


if __name__ == "__main__":
    main()
