"""Shear of an interface from its normal curve: python benchmarks/joints_under_shear.py. docs/concepts/joints-shear.md.

How far the law is from partial slip that is computed in every cell, how the loss grows with the amplitude, and what
reduced models miss.
"""

from __future__ import annotations

import numpy as np

import roughcontact as rc

CELLS, CELL = 64, 1e-6  # a map of 64 um
FRICTION, PRESSURE = 0.3, 5e6  # [Pa]
MODULUS = 1e9  # E* whatever Poisson's ratio [Pa]
PARTS = np.array([0.1, 0.2, 0.5, 0.8, 0.95])  # of mu p
AMPLITUDES = np.array([0.01, 0.03, 0.1, 0.3, 1.0, 3.0])  # of the displacement at gross slip
COUNTS = (8, 16, 32, 64)


def surface() -> rc.Surface:
    """Return the roughness of both sides together: rms 0.1 um, rolled off at 20 um, no waves below 4 um."""
    grid = rc.Grid((CELLS, CELLS), CELL, periodic=True)
    return rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=20e-6, short_cutoff=4e-6)


def bodies(nu: float) -> tuple[rc.Solid, rc.Solid]:
    """Return alike bodies of Poisson's ratio nu."""
    return (rc.Solid(2 * MODULUS * (1 - nu**2), nu),) * 2


def law(nu: float, pressures: np.ndarray) -> rc.ShearLaw:
    """Return the law from the normal curve."""
    curve = rc.loading_curve(surface(), bodies(nu), pressures=pressures, tolerance=1e-10)
    return rc.shear_law(curve, bodies(nu), friction=FRICTION)


def accuracy() -> None:
    """Print the displacement of the law over that of partial slip, with both ratios K/K_t."""
    print(
        f"| nu | K/K_t | {' | '.join(f'{part:g} mu p' for part in PARTS)} |\n|---|---|{'---|' * len(PARTS)}"
    )
    for nu in (0.0, 0.3, 0.5):
        found = law(nu, PRESSURE * np.append(1 - PARTS[::-1], 1.0))
        pressed = rc.press(surface(), bodies(nu), pressure=PRESSURE, tolerance=1e-10)
        top = FRICTION * pressed.force
        moved = rc.slide_curve(pressed, bodies(nu), friction=FRICTION, forces=PARTS * top, tolerance=1e-10)
        stiff = rc.tangential_stiffness(pressed.contact, pressed.problem.grid, bodies(nu)).matrix[0, 0]
        ratios = {"disc": found.ratio, "contact": pressed.interfacial_stiffness / stiff}
        estimate = found.displacement(PARTS * FRICTION * PRESSURE, PRESSURE) / found.ratio
        for name, ratio in ratios.items() if nu else [("both", found.ratio)]:
            errors = ratio * estimate / moved.displacement[:, 0] - 1
            # For nu = 0, only the tolerance of the solves is left.
            cells = ["< 1e-9" if abs(error) < 1e-9 else f"{100 * error:+.1f} %" for error in errors]
            print(f"| {nu:g} | {ratio:.4f}, {name} | {' | '.join(cells)} |")
    print(f"\n{pressed.contact_area / pressed.nominal_area:.0%} of the map is in contact\n")


def amplitudes() -> None:
    """Print loss and damping of the fitted law against the amplitude of the displacement."""
    found = law(0.0, np.geomspace(5e3, PRESSURE, 31)).fitted
    print("| s over gross slip | tau over mu p | loss [mJ/m²] | local exponent of the loss | damping |")
    print("|---|---|---|---|---|")
    top = float(found.gross_slip(PRESSURE))
    for part in AMPLITUDES:
        s = part * top
        near = [found.loss(PRESSURE, displacement=s * factor) for factor in (0.99, 1.01)]
        slope = np.log(near[1] / near[0]) / np.log(1.01 / 0.99)
        cycle, tau = found.cycle(PRESSURE, displacement=s), float(found.traction(s, PRESSURE))
        cells = (
            f"{tau / (FRICTION * PRESSURE):.3f} | {1e3 * cycle.loss:.3g} | {slope:.2f} | {cycle.damping:.4f}"
        )
        print(f"| {part:g} | {cells} |")
    print()


def reduced() -> None:
    """Print the misfit of Jenkins elements against their number, first slip a hundredth of gross slip."""
    found = law(0.0, np.geomspace(5e3, PRESSURE, 31)).fitted
    print("| elements | traction | loss |\n|---|---|---|")
    for count in COUNTS:
        misfit = found.elements(PRESSURE, count=count).misfit
        print(f"| {count} | {misfit['traction']:.1%} | {misfit['loss']:.1%} |")


if __name__ == "__main__":
    accuracy()
    amplitudes()
    reduced()
