"""A joint that flows when it is first pressed: python benchmarks/plastic.py [PICTURE].

It computes the numbers of docs/evidence/plastic-evidence.md.

The map of `joint.py`, ground steel on ground aluminium, under the hardness of aluminium: as it is pressed first, turned
back from each load, and unloaded from the largest; with both readings of flow, and with a hardness by the size of
spots. With a PICTURE the loop is drawn.
"""

from __future__ import annotations

import sys

import numpy as np
from joint import MODULUS, PRESSURES, UNIT, joint

import roughcontact as rc

HARDNESS = rc.handbook("aluminium").hardness
SMALL = rc.NixGao(hardness=HARDNESS, radius=5e-6)
TIGHT = 1e-10


def stiffnesses(loop: rc.Loop, elastic: rc.Curve) -> None:
    """Print the stiffness per area of each branch."""
    flow, loading = loop.loading.flow, loop.loading
    assert flow is not None
    area = loading.nominal_area
    columns = (
        PRESSURES / 1e6,
        100 * loading.contact_fraction,
        100 * flow.plastic_area / loading.contact_area,
        loading.interfacial_stiffness_per_area / UNIT,
        flow.unloading_interfacial_stiffness / area / UNIT,
        loop.unloading.interfacial_stiffness_per_area[::-1] / UNIT,
        elastic.interfacial_stiffness_per_area / UNIT,
    )
    print(
        "| p [MPa] | A/A0 [%] | of it plastic [%] | first loading | where unloading begins | unloaded from 100 MPa "
        "| elastic |"
    )
    print("|---" * 7 + "|")
    for p, a, part, *k in zip(*columns, strict=True):
        print(f"| {p:g} | {a:.2f} | {part:.0f} | " + " | ".join(f"{each:.1f}" for each in k) + " |")


def depths(removed: rc.Loop, raised: rc.Loop) -> None:
    """Print what the two readings of flow differ in."""
    print(
        "\n| flow | largest depth [µm] | residual depth [µm] | work [mJ] | dissipated [mJ] |\n|---|---|---|---|---|"
    )
    for name, loop in (("removed", removed), ("raised", raised)):
        energy = loop.work * 1e3, loop.dissipated_work * 1e3
        lengths = loop.loading.depth[-1] * 1e6, loop.residual_depth * 1e6
        print(f"| {name} | {lengths[0]:.3f} | {lengths[1]:.3f} | {energy[0]:.4f} | {energy[1]:.4f} |")
    apart = np.abs(raised.loading.mean_gap / removed.loading.mean_gap - 1).max()
    volume = removed.flow.volume / removed.loading.nominal_area
    print(f"\nflow {volume * 1e9:.1f} nm over the area; the mean gaps differ by {apart:.0e}")


def checks(loop: rc.Loop, surface: rc.Surface) -> None:
    """Print how far unloading and reloading, and two ways up, are apart."""
    again = max(
        float(np.abs(getattr(loop.reloading, name) / getattr(loop.unloading, name)[::-1] - 1).max())
        for name in ("depth", "stiffness", "contact_area", "mean_gap", "elastic_energy")
    )
    given = {"hardness": HARDNESS, "tolerance": TIGHT}
    [once] = rc.loading_path(surface, MODULUS, pressures=PRESSURES[-1:], **given)
    assert once.flow is not None
    steps = max(abs(once.depth / loop.loading.depth[-1] - 1), abs(once.flow.volume / loop.flow.volume - 1))
    print(f"reloading and unloading differ by {again:.0e}, one step up and five by {steps:.0e}")


def small_spots(surface: rc.Surface) -> None:
    """Print what a hardness by the size of spots changes."""
    print("\n| p [MPa] | A/A0, H [%] | A/A0, H(a) [%] | K/A0 at unloading, H | K/A0 at unloading, H(a) |")
    print("|---" * 5 + "|")
    one, law = (
        rc.loading_curve(surface, MODULUS, pressures=PRESSURES, hardness=h) for h in (HARDNESS, SMALL)
    )
    for i, p in enumerate(PRESSURES):
        areas = [100 * curve.contact_fraction[i] for curve in (one, law)]
        turned = [
            curve.flow.unloading_interfacial_stiffness[i] / curve.nominal_area / UNIT
            for curve in (one, law)
            if curve.flow is not None
        ]
        print(f"| {p / 1e6:g} | {areas[0]:.2f} | {areas[1]:.2f} | {turned[0]:.1f} | {turned[1]:.1f} |")


def main() -> None:
    surface = joint()
    given = {"pressures": PRESSURES, "hardness": HARDNESS, "tolerance": TIGHT}
    removed = rc.loading_loop(surface, MODULUS, **given)
    raised = rc.loading_loop(surface, MODULUS, **given, flow="raised")
    stiffnesses(removed, rc.loading_curve(surface, MODULUS, pressures=PRESSURES))
    depths(removed, raised)
    checks(removed, surface)
    small_spots(surface)
    if len(sys.argv) > 1:
        rc.plot.save(rc.plot.loop_figure(raised), sys.argv[1])


if __name__ == "__main__":
    main()
