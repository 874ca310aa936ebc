"""From rough faces to stiffness curves: a flange, a ground face, a fractal square; or --file part.x3p."""

import argparse
import shlex
import sys
import textwrap
import warnings
from pathlib import Path

import numpy as np

import roughcontact as rc
from roughcontact.files.aside import WriteError, output_folder
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.provenance import provenance
from roughcontact.files.write import write_csv, write_netcdf
from roughcontact.plot.canvas import areal_figure, curve_figure, save, solution_figure

MEGAPASCAL = 1e6
PER_AREA = 1e12  # N/um/mm^2 in Pa/m
FACES = {"flange": "turned", "ground": "ground"}  # maps of rc.examples that stand for machined faces
FLANGE = {"area": 60e-4, "bolts": 4, "force": 15e3}  # m^2 of the face; N in each bolt
PRESSURES = np.geomspace(1, 100, 24) * MEGAPASCAL  # of the flange; the others get loads that suit them
TOLERANCE = 1e-8
RESOLVED = (
    "resolved: stiffer than twenty single cells and well below full contact; others say more of the grid"
)


def fractal():
    """Return a self-affine square of 512 x 512 cells."""
    grid = rc.Grid(shape=(512, 512), spacing=(1e-6, 1e-6))
    return rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))


def demonstrate(name, surface, modulus, folder, pressures=None):
    """Press `surface` by rising loads; print, write and draw; return the curve."""
    curve = rc.loading_curve(surface, modulus, pressures=pressures, tolerance=TOLERANCE)
    tell(name, surface, curve)
    if name == "flange":
        joint(curve)
    drawn = areal_figure(curve) if name in FACES else curve_figure(curve, power_law(curve))
    shown = curve.force[-5]  # a load whose contact is large enough to be seen
    solution = rc.press(surface, modulus, force=shown, tolerance=TOLERANCE)

    command = shlex.join(["demo.py", *sys.argv[1:]])
    source = provenance(surface, modulus=modulus, tolerance=TOLERANCE, command=command)
    pictures = {"curve": (curve, drawn), "pressure": (solution, solution_figure(solution))}
    for kind, (what, picture) in pictures.items():
        write_netcdf(what.to_dataset(), folder / f"{name}_{kind}.nc", source)
        save(picture, folder / f"{name}_{kind}.png")
    write_csv(curve.to_dataset(), folder / f"{name}_curve.csv")
    return curve


def tell(name, surface, curve):
    """Print one line a load."""
    ny, nx = surface.grid.shape
    about = (
        f"{name}: {ny} x {nx} cells, rms height {surface.rms * 1e6:.3g} um ({'; '.join(surface.provenance)})"
    )
    print("", textwrap.fill(about, 100, subsequent_indent="  "), sep="\n")
    print("   force [N]     p [MPa]  K/A0 [N/um/mm^2]  contact area  spots  certificate  resolved")
    pressure = curve.nominal_pressure / MEGAPASCAL
    stiffness = curve.interfacial_stiffness_per_area / PER_AREA
    columns = (curve.force, pressure, stiffness, curve.contact_fraction, curve.spots, curve.residual)
    for resolved, *numbers in zip(curve.resolved, *columns, strict=True):
        line = "{:12.4g}{:12.4g}{:18.4g}{:14.3%}{:7d}{:13.1e}".format(*numbers)
        print(f"{line}  {'yes' if resolved else 'no':>8}")
    print(RESOLVED)


def joint(curve):
    """Print what the flange does at the pressure of its bolts."""
    force = FLANGE["bolts"] * FLANGE["force"]
    pressure = force / FLANGE["area"]
    stiffness = np.interp(pressure, curve.nominal_pressure, curve.interfacial_stiffness_per_area)
    print(
        f"{FLANGE['bolts']} bolts of {FLANGE['force'] / 1e3:g} kN on {FLANGE['area'] * 1e4:g} cm^2 press by "
        f"{pressure / MEGAPASCAL:g} MPa: K/A0 = {stiffness / PER_AREA:.3g} N/um/mm^2, "
        f"the whole joint {stiffness * FLANGE['area'] / 1e9:.3g} kN/um"
    )


def power_law(curve):
    """Return the power law through the resolved points, and print it; None where they are too few."""
    try:
        law = curve.fit()
    except ValueError as error:
        print(f"no power law: {error}")
        return None
    formula = f"k / (E* L) = {law.prefactor:.3f} (F / (E* h L))^{law.exponent:.3f}"
    print(f"power law: {formula}, scatter {law.scatter:.3f}, through {law.rule}")
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
    """Return the reduced modulus of two materials by name; say which they are."""
    names = materials.split(",")
    if len(names) != 2:
        sys.exit(f"Error: --materials: name both bodies, such as steel,aluminium, not {materials!r}")
    try:
        first, second = (rc.handbook(name.strip()) for name in names)
    except ValueError as error:
        sys.exit(f"Error: --materials: {error}")
    modulus = rc.reduced_modulus(first.solid, second.solid)
    words = f"{first.name} ({first.grade}) on {second.name} ({second.grade})"
    print(
        f"Pressed with the reduced modulus E* = {modulus / 1e9:.4g} GPa of {words}; elastic at every pressure"
    )
    return modulus


def main():
    """Press the three surfaces of the demonstration, or the user's."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--file", type=Path, help="a measured surface to press instead")
    parser.add_argument("--unit", help="unit of its heights, where the file has none, such as um")
    parser.add_argument("--size", help="its width, where the file has none, such as 1mm")
    parser.add_argument("--materials", default="steel,aluminium", help="both bodies (default: %(default)s)")
    parser.add_argument("--out", type=Path, default=Path("out/demo"), help="folder for files and pictures")
    given = parser.parse_args()
    if given.file:
        cases = {"surface": measured(given.file, given.unit, given.size)}
        out = given.out / given.file.stem
    else:
        cases = {name: rc.examples.surface(face).levelled("plane") for name, face in FACES.items()}
        cases["fractal"], out = fractal(), given.out
    modulus = bodies(given.materials)
    with output_folder(out) as folder:
        curves = [
            demonstrate(name, surface, modulus, folder, PRESSURES if name == "flange" else None)
            for name, surface in cases.items()
        ]
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
