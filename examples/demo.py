"""From a rough surface to its stiffness curve: a landscape, then a fractal square; or --file part.x3p."""

import argparse
import math
import sys
from pathlib import Path

import numpy as np
from matplotlib.cbook import get_sample_data

import roughcontact as rc
from roughcontact.files.write import WriteError, output_folder, write_csv, write_netcdf
from roughcontact.plot.figures import curve_figure, save, solution_figure

GRANITE = rc.Solid(young_modulus=60e9, poisson_ratio=0.25)
METRES_PER_DEGREE = 6371e3 * math.pi / 180  # of latitude, on a sphere of the Earth's mean radius
LOADS = np.geomspace(1e-4, 0.07, 30)  # without dimension: F / (E* h L)
SHOWN = 20  # which of the loads is drawn as a map
TOLERANCE = 1e-8


def landscape():
    """Return the elevation model that comes with matplotlib: the fault of Jacksboro, Tennessee."""
    data = get_sample_data("jacksboro_fault_dem.npz")
    latitude = math.radians((data["ymin"] + data["ymax"]) / 2)
    spacing = (data["dy"] * METRES_PER_DEGREE, data["dx"] * METRES_PER_DEGREE * math.cos(latitude))
    return rc.Surface(data["elevation"], rc.Grid(data["elevation"].shape, spacing), ("Jacksboro fault",))


def fractal():
    """Return a self-affine square of 512 x 512 cells."""
    grid = rc.Grid(shape=(512, 512), spacing=(1e-6, 1e-6))
    return rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))


def demonstrate(name, surface, folder):
    """Press `surface` by rising loads; print, write and draw; return whether every answer is certified."""
    modulus = rc.reduced_modulus(GRANITE, GRANITE)
    forces = LOADS * modulus * surface.rms * math.sqrt(surface.grid.area)

    curve = rc.loading_curve(surface, modulus, forces=forces, tolerance=TOLERANCE)
    solution = rc.press(surface, modulus, force=forces[SHOWN], tolerance=TOLERANCE)

    ny, nx = surface.grid.shape
    print(f"\n{name}: {ny} x {nx} cells, rms height {surface.rms:.3g} m ({surface.provenance[-1]})")
    print("   force [N]   depth [m]  stiffness [N/m]  contact area  spots  certificate  resolved")
    share = curve.contact_area / surface.grid.area
    columns = (curve.force, curve.depth, curve.stiffness, share, curve.spots, curve.residual)
    for resolved, *numbers in zip(curve.resolved, *columns, strict=True):
        line = "{:12.4g}{:12.4g}{:17.5g}{:14.3%}{:7d}{:13.1e}".format(*numbers)
        print(f"{line}  {'yes' if resolved else 'no':>8}")
    law = power_law(curve)

    write_csv(curve.to_dataset(), folder / f"{name}_curve.csv")
    write_netcdf(curve.to_dataset(), folder / f"{name}_curve.nc")
    save(curve_figure(curve, law), folder / f"{name}_curve.png")
    write_netcdf(solution.to_dataset(), folder / f"{name}_pressure.nc")
    save(solution_figure(solution), folder / f"{name}_pressure.png")
    return bool((curve.residual <= TOLERANCE).all()) and solution.residual <= TOLERANCE


def power_law(curve):
    """Return the power law through the resolved points, and print it; None where they are too few."""
    try:
        law = curve.fit()
    except ValueError as error:
        print(f"no power law: {error}")
        return None
    formula = f"k / (E* L) = {law.prefactor:.3f} (F / (E* h L))^{law.exponent:.3f}"
    print(f"power law: {formula}, {law.count} resolved loads, scatter {law.scatter:.3f}")
    return law


def main():
    """Press the two surfaces of the demonstration, or the user's."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--file", help="a measured surface to press instead")
    parser.add_argument("--unit", help="unit of its heights, where the file has none, such as um")
    parser.add_argument("--size", help="its width, where the file has none, such as 1mm")
    parser.add_argument("--out", type=Path, default=Path("out/demo"), help="folder for files and pictures")
    given = parser.parse_args()
    if given.file:
        cases = {"surface": rc.read(given.file, unit=given.unit, size=given.size).levelled("plane")}
    else:
        cases = {"landscape": landscape().levelled("plane"), "fractal": fractal()}
    with output_folder(given.out) as folder:
        certified = [demonstrate(name, surface, folder) for name, surface in cases.items()]
    answers = len(cases) * (LOADS.size + 1)
    if not all(certified):
        sys.exit(f"\nNot every one of {answers} answers met its tolerance of {TOLERANCE:g}")
    print(f"\nEvery one of {answers} answers is certified to {TOLERANCE:g}; files and pictures: {given.out}")


if __name__ == "__main__":
    try:
        main()
    except (rc.ReadError, rc.ConvergenceError, WriteError) as error:
        sys.exit(f"Error: {error}")
