"""Theories of bodies that yield, beside the computed contact of one surface: python benchmarks/plastic_theories.py."""

from __future__ import annotations

import numpy as np

import roughcontact as rc

MODULUS, CELLS, SPACING = 1e11, 128, 1e-6
NAMES = ("gw", "ceb", "kogut-etsion", "persson-plastic", "pullen-williamson")
PRESSURES = (2e7, 6e7, 1.5e8)


def main() -> None:
    """Print areas, and stiffnesses on first loading where the theory has one."""
    surface = rc.self_affine(
        rc.Grid((CELLS, CELLS), SPACING, periodic=True),
        hurst=0.8,
        rms=4e-7,
        rng=np.random.default_rng(3),
        short_cutoff=8 * SPACING,
        rolloff=40 * SPACING,
    )
    print(f"rms slope {rc.surface_moments(surface).rms_slope:.3f}; A/A0, and K/A0 [N/um/mm^2] in brackets")
    print("  ".join(f"{name:<17}" for name in ("H/E*, p [MPa]", "computed", *NAMES)))
    for hardness in (3e9, 1e9):
        laws = rc.loading_laws(surface, MODULUS, NAMES, hardness=hardness)
        curve = rc.loading_curve(surface, MODULUS, pressures=PRESSURES, hardness=hardness)
        for i, force in enumerate(curve.force):
            cells = [
                f"{curve.contact_fraction[i]:.4f} ({curve.interfacial_stiffness_per_area[i] / 1e12:.0f})"
            ]
            for law in laws:
                area = float(law.predict("contact_area", force)) / surface.grid.area
                words = f"{area:.4f}"
                if "interfacial_stiffness" in law.quantities:
                    words += f" ({float(law.predict('interfacial_stiffness', force)) / surface.grid.area / 1e12:.0f})"
                cells.append(words)
            print(
                "  ".join(
                    f"{text:<17}" for text in (f"{hardness / MODULUS:g}, {PRESSURES[i] / 1e6:g}", *cells)
                )
            )


if __name__ == "__main__":
    main()
