"""Leak curves of measured maps: python benchmarks/leak_maps.py FOLDER --out DIR; docs/evidence/gap-flow-evidence.md.

Every map of a folder is levelled and pressed against a flat up to the load at which its path along y closes. The table
holds the transmissivity at six parts of this load, or the reason why there is none; DIR gets a picture of each flow.
"""

from __future__ import annotations

import argparse
import math
import warnings
from collections.abc import Callable
from pathlib import Path

import matplotlib.figure

import roughcontact as rc
from roughcontact.fluid.gap_flow import Missing

PARTS = (0.01, 0.03, 0.1, 0.3, 0.6, 0.9)  # of the sealing load
DRAWN = 0.3
ADDED = {"unit": "nm", "size": 1e-5}  # for files that do not hold them


def read(file: Path) -> rc.Surface:
    """Return the levelled surface of a file."""
    more: dict[str, object] = {}
    while True:
        try:
            return rc.read(file, **more).levelled()
        except rc.InputError as error:
            asked = next((name for name in ADDED if f"{name}=" in f"{error}" and name not in more), None)
            if asked is None:
                raise
            more[asked] = ADDED[asked]


def sealing(surface: rc.Surface) -> tuple[rc.Surface, rc.SealingLoad, Missing, str]:
    """Return the surface and its sealing load; where missing cells decide, these are open or filled."""
    tries: list[tuple[Callable[[], rc.Surface], Missing, str]] = [
        (lambda: surface, "closed", ""),
        (lambda: surface, "open", ", holes open"),
        (surface.filled, "closed", ", holes filled"),
    ]
    for changed, missing, words in tries:
        try:
            used = changed()
            return used, rc.sealing_load(used, 1.0, axis=0, ratio=0.02, missing=missing), missing, words
        except rc.InputError as error:
            if error.place != "missing":
                raise
    raise AssertionError


def row(file: Path, out: Path) -> str:
    """Return a line of the table, and draw the flow."""
    surface, sealed, missing, done = sealing(read(file))
    first = math.sqrt(math.prod(sealed.pressures))
    values = []
    for part, solution in zip(
        PARTS, rc.loading_path(surface, 1.0, pressures=[part * first for part in PARTS]), strict=True
    ):
        flow = rc.gap_flow(solution, axis=0, missing=missing)
        gap, place = flow.hydraulic_gap, flow.constriction
        values.append(f"{1e9 * gap:.3g}" + ("" if place is not None and place.resolved else "*"))
        if part == DRAWN:
            height, width = solution.problem.grid.lengths
            size = 6.4, min(max(1.0 + 4.2 * height / width, 2.6), 9.0)
            figure = matplotlib.figure.Figure(figsize=size, layout="constrained")
            flow.plot(figure.subplots())
            figure.savefig(out / f"{file.name}.png", dpi=110)
    cells = " x ".join(str(n) for n in surface.grid.shape) + done
    area = f"{sealed.contact_fractions[0]:.3f}"
    return (
        f"| {file.name} | {cells} | {1e9 * surface.rms:.3g} | {first:.2g} | {area} | {' | '.join(values)} |"
    )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    warnings.simplefilter("ignore")
    parts = " | ".join(f"{part:g}" for part in PARTS)
    print(f"| map | cells | rms [nm] | sealing p/E* | A/A0 there | {parts} |")
    print("|" + "---|" * (5 + len(PARTS)))
    for file in sorted(given.folder.iterdir()):
        if file.name == "MANIFEST.csv" or file.name.startswith("derived_"):
            continue
        try:
            print(row(file, given.out), flush=True)
        except rc.InputError as error:
            print(f"| {file.name} | {error} |", flush=True)


if __name__ == "__main__":
    main()
