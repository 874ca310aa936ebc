"""A large joint from a small map, both ways: python benchmarks/joint.py. The numbers of docs/concepts/joints.md.

Steel on aluminium, pressed as a periodic map, and as free patches of several sizes that are cut from the same map.
"""

from __future__ import annotations

import math

import numpy as np

import roughcontact as rc

CELLS, CELL = 512, 2e-6  # a map of 1.024 mm
STEEL, ALUMINIUM = rc.Solid(210e9, 0.3), rc.Solid(70e9, 0.33)
MODULUS = rc.reduced_modulus(STEEL, ALUMINIUM)
CONDUCTIVITIES = (50.0, 160.0)  # [W/(m K)]
PRESSURES = np.array([1e6, 3e6, 10e6, 30e6, 100e6])  # [Pa]
PATCHES = {128: 16, 192: 9, 256: 9, 384: 9, 512: 9}  # cells along a side, and how many of them
FLANGE = 600e-6  # its nominal area [m^2]
UNIT = 1e12  # N/um/mm^2 in Pa/m
# E* L (1/k - 1/K) of a square: force at a corner, evenly over it, at its centre.
CORNER = 2 * math.log(1 + math.sqrt(2)) / math.pi
BODY = (CORNER, rc.theory.interaction.SQUARE, 2 * CORNER)


def joint() -> rc.Surface:
    """Return the roughness of both sides together: rms 1 um, rolled off at 128 um, no waves below 16 um."""
    rng, grid = np.random.default_rng(0), rc.Grid((CELLS, CELLS), CELL, periodic=True)
    return rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=rng, rolloff=128e-6, short_cutoff=16e-6)


def patches(surface: rc.Surface, side: int) -> list[rc.Surface]:
    """Return free patches from anywhere on the periodic map, without their tilt."""
    rng, found = np.random.default_rng(side), []
    for _ in range(PATCHES[side]):
        heights = np.roll(surface.heights, rng.integers(0, CELLS, 2), (0, 1))[:side, :side]
        found.append(rc.Surface(heights, rc.Grid((side, side), CELL)).levelled("plane"))
    return found


def mean_and_error(values: np.ndarray) -> str:
    """Return the mean of several patches and its standard error."""
    return f"{values.mean():.1f} ± {values.std(ddof=1) / math.sqrt(values.size):.1f}"


def periodic(surface: rc.Surface) -> rc.Curve:
    """Press the map as it is, print what the joint has per area, and return the curve."""
    curve = rc.loading_curve(surface, MODULUS, pressures=PRESSURES)
    heat = rc.conductance(curve, conductivities=CONDUCTIVITIES)["thermal_conductance_per_area"]
    stiffness = curve.interfacial_stiffness_per_area
    print("| p [MPa] | A/A0 [%] | mean gap [µm] | K/A0 [N/µm/mm²] | h_c [kW/m²/K] |\n|---|---|---|---|---|")
    columns = (
        PRESSURES / 1e6,
        curve.contact_fraction * 100,
        curve.mean_gap * 1e6,
        stiffness / UNIT,
        heat / 1e3,
    )
    for pressure, area, gap, k, h in zip(*columns, strict=True):
        print(f"| {pressure:g} | {area:.2f} | {gap:.2f} | {k:.1f} | {h:.1f} |")
    flange = (
        f"{FLANGE * 1e6:g} mm² at 10 MPa: {stiffness[2] * FLANGE / 1e9:.1f} kN/µm, {heat[2] * FLANGE:.1f} W/K"
    )
    print(f"\nE* = {MODULUS / 1e9:.1f} GPa; {flange}\n")
    return curve


def free(surface: rc.Surface, whole: rc.Curve) -> None:
    """Press the patches, and print what each size says of the joint."""
    steps = [int(np.argmin(abs(PRESSURES - pressure))) for pressure in (10e6, 100e6)]
    names = [f"{name} at {PRESSURES[i] / 1e6:g} MPa" for i in steps for name in ("K/A0", "k/A0")]
    print(f"| patches | {' | '.join(names)} |\n|{'---|' * (1 + len(names))}")
    for side, count in PATCHES.items():
        curves = [rc.loading_curve(each, MODULUS, pressures=PRESSURES) for each in patches(surface, side)]
        area, length = curves[0].nominal_area, curves[0].length
        interface = np.array([curve.interfacial_stiffness for curve in curves]) / area / UNIT
        patch = np.array([curve.stiffness for curve in curves]) / area / UNIT
        cells = [mean_and_error(each[:, i]) for i in steps for each in (interface, patch)]
        print(f"| {count} of {length * 1e3:.3f} mm | {' | '.join(cells)} |", flush=True)
    cells = [f"{whole.interfacial_stiffness_per_area[i] / UNIT:.1f}" for i in steps]
    print(f"| periodic | {' | | '.join(cells)} | |\n")
    print("| 1/K = 1/k - c/(E* L) | " + " | ".join(f"c = {c:.4f}" for c in BODY) + " |\n|---|---|---|---|")
    for i in steps:
        compliance = 1 / (patch[:, i].mean() * UNIT * area)
        taken = [1 / (compliance - c / (MODULUS * length)) / area / UNIT for c in BODY]
        print(f"| {PRESSURES[i] / 1e6:g} MPa | " + " | ".join(f"{k:.1f}" for k in taken) + " |")


def uneven(surface: rc.Surface) -> None:
    """Print how the pressure on a free patch is spread: in a border of a sixteenth of its side, and in its middle."""
    side = max(PATCHES)
    inner = [slice(part * side // 16, (16 - part) * side // 16) for part in (1, 4)]
    found = []
    for each in patches(surface, side):
        pressure = rc.press(each, MODULUS, pressure=PRESSURES[-1]).pressure / PRESSURES[-1]
        within, middle = (pressure[part, part] for part in inner)
        border = (pressure.sum() - within.sum()) / (pressure.size - within.size)
        found.append((border, middle.mean()))
    border, middle = np.mean(found, axis=0)
    print(f"\nat {PRESSURES[-1] / 1e6:g} MPa p/p0 = {border:.2f} at the border, {middle:.2f} in the middle")


if __name__ == "__main__":
    surface = joint()
    free(surface, periodic(surface))
    uneven(surface)
