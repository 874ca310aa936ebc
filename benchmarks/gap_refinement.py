"""Flow through one gap on ever smaller cells, from light contact to the threshold: docs/evidence/gap-flow-evidence.md.

python benchmarks/gap_refinement.py                      64 to 512 cells a side
python benchmarks/gap_refinement.py --finest 1024 --seed 4
"""

from __future__ import annotations

import argparse
import math

import numpy as np
from gap_flow import pressure_for, rough

import roughcontact as rc
from roughcontact.validation import Array

AREAS, COARSEST = (0.10, 0.25, 0.35, 0.40, 0.50), 64


def half_trace(tensor: Array) -> float:
    """Return the mean of both principal values."""
    return float(np.trace(tensor)) / 2


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--finest", type=int, default=512)
    parser.add_argument("--seed", type=int, default=3)
    parser.add_argument("--areas", type=float, nargs="+", default=AREAS)
    given = parser.parse_args()
    sides = [COARSEST * 2**k for k in range(round(math.log2(given.finest / COARSEST)) + 1)]
    surfaces = {cells: rough(cells, given.seed) for cells in sides}
    print("| p/E* | cells | A/A0 | transmissivity [L^3] | change | interval | across | width/L | share |")
    print("|---|---|---|---|---|---|---|---|---|")
    for area in given.areas:
        pressure = pressure_for(surfaces[sides[-1]], area)
        before = math.nan
        for cells, surface in surfaces.items():
            solution = rc.press(surface, 1.0, pressure=pressure)
            flow = rc.gap_flow(solution)
            value, place = half_trace(flow.transmissivity), flow.constriction
            low, high = (half_trace(each) / value - 1 for each in flow.interval) if value else (0.0, 0.0)
            cells_across = f"{place.cells} | {place.width:.3f} | {place.share:.0%}" if place else "- | - | -"
            change = "" if math.isnan(before) else f"{value / before - 1:+.1%}"
            print(
                f"| {pressure:.4f} | {cells} | {solution.contact_fraction:.4f} | {value:.4g} | {change} "
                f"| {low:+.1%} to {high:+.1%} | {cells_across} |",
                flush=True,
            )
            before = value
    for cells, surface in surfaces.items():
        low, high = (sealed := rc.sealing_load(surface, 1.0, ratio=1e-3)).pressures
        print(
            f"{cells} cells: closes at p/E* = {low:.5f} to {high:.5f}, A/A0 = {sealed.contact_fractions[0]:.4f}"
        )


if __name__ == "__main__":
    main()
