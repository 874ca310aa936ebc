"""Measured interfacial stiffness of a rough joint beside the computed one, with bands for what is not stated.

    python benchmarks/experiment.py measured.csv joint.toml [--cells 256] [--seeds 3]

`measured.csv` has lines "pressure [MPa], stiffness [N/um/mm^2]" (text after # and a line of words are passed over), of
one branch: first loading, or unloading and reloading, which are alike. `joint.toml` says what the source states; what
it leaves open is a pair, [least, most], and the band is that of the computed curves at all ends of the pairs and all
seeds:

    source = "where the numbers stand: paper, table and figure"
    branch = "unloading"        # or "loading", the elastic joint if there is no hardness
    modulus = 115e9             # reduced modulus E* [Pa]
    hardness = [1.8e9, 3.0e9]   # of the softer body [Pa]; leave out for an elastic joint
    rms = 1.2e-6                # of both surfaces together [m]
    rolloff = [50e-6, 200e-6]   # longest waves [m]
    hurst = [0.7, 0.9]
    short_cutoff = [4e-6, 8e-6] # shortest waves that count [m]

Unloading starts at the largest pressure of the file: the surface flows there, and is elastic below.
"""

from __future__ import annotations

import argparse
import itertools
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import roughcontact as rc

MEGAPASCAL, UNIT = 1e6, 1e12  # N/um/mm^2 in Pa/m
OPEN = ("modulus", "hardness", "rms", "rolloff", "hurst", "short_cutoff")
NEEDED = {"source", "branch", "modulus", "rms", "rolloff", "hurst", "short_cutoff"}

Array = npt.NDArray[np.float64]


def measured(path: Path) -> tuple[Array, Array]:
    """Return pressures [Pa] and stiffnesses per area [Pa/m], in the order of increasing pressure."""
    rows = []
    for line in path.read_text(encoding="utf-8").splitlines():
        text = line.split("#")[0].replace(";", ",").strip()
        if text and not text[0].isalpha() and not text.startswith('"'):
            rows.append([float(part) for part in text.split(",")[:2]])
    if len(rows) < 2 or min(len(row) for row in rows) < 2:
        raise SystemExit(f"{path}: at least two lines 'pressure [MPa], stiffness [N/um/mm^2]' are wanted")
    p, k = np.array(sorted(rows)).T
    return p * MEGAPASCAL, k * UNIT


def stated(path: Path) -> dict[str, Any]:
    """Return what the source states of the joint."""
    facts = tomllib.loads(path.read_text(encoding="utf-8"))
    if missing := NEEDED - facts.keys():
        raise SystemExit(f"{path}: {', '.join(sorted(missing))} missing")
    if strange := facts.keys() - NEEDED - {"hardness"}:
        raise SystemExit(f"{path}: nothing is known of {', '.join(sorted(strange))}")
    if facts["branch"] not in {"loading", "unloading"}:
        raise SystemExit(f"{path}: branch is 'loading' or 'unloading', not {facts['branch']!r}")
    return facts


def corners(facts: dict[str, Any]) -> list[dict[str, float]]:
    """Return the joints at all ends of what is left open."""
    names = [name for name in OPEN if name in facts]
    ends = [facts[name] if isinstance(facts[name], list) else [facts[name]] for name in names]
    return [dict(zip(names, values, strict=True)) for values in itertools.product(*ends)]


def computed(joint: dict[str, float], branch: str, pressure: Array, cells: int, seed: int) -> Array:
    """Return the interfacial stiffness per area at the pressures [Pa/m]; NaN where the grid does not resolve it."""
    # Eight of the longest waves along the side.
    grid = rc.Grid((cells, cells), 8 * joint["rolloff"] / cells, periodic=True)
    if joint["short_cutoff"] < 2 * grid.spacing[0]:
        raise SystemExit(
            f"a short cut-off of {joint['short_cutoff']:g} m needs {16 * joint['rolloff'] / joint['short_cutoff']:.0f} "
            "cells along the side: --cells"
        )
    surface = rc.self_affine(
        grid,
        hurst=joint["hurst"],
        rms=joint["rms"],
        rng=np.random.default_rng(seed),
        rolloff=joint["rolloff"],
        short_cutoff=joint["short_cutoff"],
    )
    limit = {"hardness": joint["hardness"]} if "hardness" in joint else {}
    if branch == "unloading" and limit:
        top = rc.press(surface, joint["modulus"], pressure=float(pressure[-1]), **limit)
        flow = np.where(top.pressure >= joint["hardness"] * (1 - 1e-9), np.maximum(-top.gap, 0.0), 0.0)
        surface, limit = rc.Surface(surface.heights - flow, grid), {}
    curve = rc.loading_curve(surface, joint["modulus"], pressures=pressure, **limit)
    return np.where(curve.resolved, curve.interfacial_stiffness_per_area, np.nan)


def main() -> None:
    """Print measured values beside the band of computed ones."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("measured", type=Path)
    parser.add_argument("joint", type=Path)
    parser.add_argument("--cells", type=int, default=256)
    parser.add_argument("--seeds", type=int, default=3)
    given = parser.parse_args()
    pressure, stiffness = measured(given.measured)
    facts = stated(given.joint)
    joints = corners(facts)
    print(f"{facts['source']}; {facts['branch']}")
    print(f"{len(joints)} joints, {given.seeds} surfaces of each, {given.cells} x {given.cells} cells")
    found = np.array(
        [
            computed(joint, facts["branch"], pressure, given.cells, seed)
            for joint in joints
            for seed in range(given.seeds)
        ]
    )
    print("p [MPa]   measured   computed, least to most [N/um/mm^2]   measured is")
    for p, k, values in zip(pressure, stiffness, found.T, strict=True):
        there = values[np.isfinite(values)]
        if not there.size:
            print(f"{p / MEGAPASCAL:<9.4g} {k / UNIT:<10.4g} not resolved")
            continue
        low, high = there.min(), there.max()
        where = (
            "within"
            if low <= k <= high
            else f"{k / low:.2f} of the least"
            if k < low
            else f"{k / high:.2f} of the most"
        )
        print(f"{p / MEGAPASCAL:<9.4g} {k / UNIT:<10.4g} {low / UNIT:<8.4g} to {high / UNIT:<24.4g} {where}")


if __name__ == "__main__":
    main()
