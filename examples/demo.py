"""From a rough surface to its stiffness curve: a fractal square and a landscape; or --file part.x3p."""

import argparse
import math
import shlex
import sys
import warnings
from pathlib import Path

import numpy as np
from matplotlib.cbook import get_sample_data

import roughcontact as rc
from roughcontact.files.aside import WriteError, output_folder
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.provenance import provenance
from roughcontact.files.write import write_csv, write_netcdf
from roughcontact.plot.canvas import curve_figure, save, solution_figure

GRANITE = rc.Solid(young_modulus=60e9, poisson_ratio=0.25)
ON_GRANITE = "granite on granite (both 60 GPa, Poisson's ratio 0.25)"
METRES_PER_DEGREE = 6371e3 * math.pi / 180  # of latitude, on a sphere of the Earth's mean radius
SHOWN = 20  # which of the thirty loads is drawn as a map
TOLERANCE = 1e-8
RESOLVED = (
    "resolved: stiffer than twenty single cells and well below full contact; others say more of the grid"
)


def fractal():
    """Return a self-affine square of 512 x 512 cells."""
    grid = rc.Grid(shape=(512, 512), spacing=(1e-6, 1e-6))
    return rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))


def landscape():
    """Return the elevation model that comes with matplotlib: the fault of Jacksboro, Tennessee."""
    data = get_sample_data("jacksboro_fault_dem.npz")
    latitude = math.radians((data["ymin"] + data["ymax"]) / 2)
    spacing = (data["dy"] * METRES_PER_DEGREE, data["dx"] * METRES_PER_DEGREE * math.cos(latitude))
    return rc.Surface(data["elevation"], rc.Grid(data["elevation"].shape, spacing), ("Jacksboro fault",))


def demonstrate(name, surface, modulus, folder):
    """Press `surface` by rising loads; print, write and draw; return the curve."""
    curve = rc.loading_curve(surface, modulus, tolerance=TOLERANCE)
    solution = rc.press(surface, modulus, force=curve.force[SHOWN], tolerance=TOLERANCE)
    tell(name, surface, curve)
    law = power_law(curve)

    command = shlex.join(["demo.py", *sys.argv[1:]])
    source = provenance(surface, modulus=modulus, tolerance=TOLERANCE, command=command)
    pictures = {"curve": (curve, curve_figure(curve, law)), "pressure": (solution, solution_figure(solution))}
    for kind, (what, picture) in pictures.items():
        write_netcdf(what.to_dataset(), folder / f"{name}_{kind}.nc", source)
        save(picture, folder / f"{name}_{kind}.png")
    write_csv(curve.to_dataset(), folder / f"{name}_curve.csv")
    return curve


def tell(name, surface, curve):
    """Print one line a load."""
    ny, nx = surface.grid.shape
    print(f"\n{name}: {ny} x {nx} cells, rms height {surface.rms:.3g} m ({'; '.join(surface.provenance)})")
    print("   force [N]   depth [m]  stiffness [N/m]  contact area  spots  certificate  resolved")
    share = curve.contact_area / surface.grid.area
    columns = (curve.force, curve.depth, curve.stiffness, share, curve.spots, curve.residual)
    for resolved, *numbers in zip(curve.resolved, *columns, strict=True):
        line = "{:12.4g}{:12.4g}{:17.5g}{:14.3%}{:7d}{:13.1e}".format(*numbers)
        print(f"{line}  {'yes' if resolved else 'no':>8}")
    print(RESOLVED)


def power_law(curve):
    """Return the power law through the resolved points, and print it; None where they are too few."""
    try:
        law = curve.fit()
    except ValueError as error:
        print(f"no power law: {error}")
        return None
    formula = f"k / (E* L) = {law.prefactor:.3f} (F / (E* h L))^{law.exponent:.3f}"
    print(f"power law: {formula}, {law.count} resolved loads, scatter {law.scatter:.3f}")
    if not law.straight:
        low, high = law.ends
        print(f"but no single one: its exponent goes from {low:.2f} to {high:.2f} over these loads")
    return law


def measured(file, unit, size):
    """Return the user's surface, levelled; end with one line where there is none to press."""
    try:
        raw = rc.read(file, unit=unit, size=size)
    except ValueError as error:
        hint = (
            '; with make: ARGS="--unit nm --size 10um"'
            if "unit=" in str(error) or "size=" in str(error)
            else ""
        )
        sys.exit(f"Error: {error}{hint}")
    surface = raw.levelled("plane")
    if surface.rms <= 1e-12 * np.nanmax(np.abs(raw.heights)):  # less is the rounding of the heights
        sys.exit(f"Error: {file} is flat: without roughness there is nothing to show; give a rough surface")
    return surface


def bodies(materials):
    """Return the reduced modulus of two materials by name, of granite without names; say which it is."""
    if materials is None:
        modulus, words = rc.reduced_modulus(GRANITE, GRANITE), ON_GRANITE
    else:
        names = materials.split(",")
        if len(names) != 2:
            sys.exit(f"Error: --materials: name both bodies, such as steel,aluminium, not {materials!r}")
        try:
            first, second = (rc.handbook(name.strip()) for name in names)
        except ValueError as error:
            sys.exit(f"Error: --materials: {error}")
        modulus = rc.reduced_modulus(first.solid, second.solid)
        words = f"{first.name} ({first.grade}) on {second.name} ({second.grade})"
    other = " (--materials steel,aluminium for others)" if materials is None else ""
    print(f"Pressed with the reduced modulus E* = {modulus / 1e9:.4g} GPa of {words}{other}")
    return modulus


def main():
    """Press the two surfaces of the demonstration, or the user's."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--file", type=Path, help="a measured surface to press instead")
    parser.add_argument("--unit", help="unit of its heights, where the file has none, such as um")
    parser.add_argument("--size", help="its width, where the file has none, such as 1mm")
    parser.add_argument(
        "--materials", help="both bodies, such as steel,aluminium (default: granite on granite)"
    )
    parser.add_argument("--out", type=Path, default=Path("out/demo"), help="folder for files and pictures")
    given = parser.parse_args()
    if given.file:
        cases = {"surface": measured(given.file, given.unit, given.size)}
        out = given.out / given.file.stem
    else:
        cases = {"fractal": fractal(), "landscape": landscape().levelled("plane")}
        out = given.out
    modulus = bodies(given.materials)
    with output_folder(out) as folder:
        curves = [demonstrate(name, surface, modulus, folder) for name, surface in cases.items()]
    loads, resolved = sum(map(len, curves)), sum(int(curve.resolved.sum()) for curve in curves)
    answers = loads + len(curves)  # and a map of each
    if max(curve.residual.max() for curve in curves) > TOLERANCE:
        sys.exit(f"\nNot every one of {answers} answers met its tolerance of {TOLERANCE:g}")
    print(
        f"\nEvery one of {answers} answers is certified to {TOLERANCE:g}; {resolved} of {loads} loads are resolved"
    )
    print(f"Files and pictures: {out}")


if __name__ == "__main__":
    warnings.simplefilter("always", SurfaceWarning)
    warnings.showwarning = lambda message, *_: print(f"Note: {message}", file=sys.stderr)
    try:
        main()
    except KeyboardInterrupt:
        print("Interrupted: no file was left half-written.", file=sys.stderr)
        sys.exit(130)  # what a shell reports for Ctrl-C
    except (rc.ConvergenceError, WriteError) as error:
        sys.exit(f"Error: {error}")
