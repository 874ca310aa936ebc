"""The flow through the same gaps by ReynoldsFlow (BSD-3-Clause): docs/evidence/gap-flow-evidence.md.

It solves the flow along axis 0 with harmonic means of g^3 at the faces, as roughcontact does, and computes no contact.
pip install reynoldsflow in an environment that holds roughcontact; then python benchmarks/flow_peer.py 128
"""

from __future__ import annotations

import sys

import numpy as np
from gap_flow import rough
from suite.peer_reynoldsflow import transmissivity

import roughcontact as rc

PRESSURES = (0.005, 0.02, 0.035, 0.045, 0.055)  # over E*


def main(cells: int) -> None:
    """Print the table."""
    print("| p/E* | A/A0 | sides | roughcontact | ReynoldsFlow | difference | interval |")
    print("|---|---|---|---|---|---|---|")
    for mode, periodic in (("periodic", (True, True)), ("pressure", (False, True))):
        grid = rc.Grid((cells, cells), 1 / cells, periodic=periodic)
        surface = rc.Surface(rough(cells, 3).heights, grid)
        for pressure in PRESSURES:
            solution = rc.press(surface, 1.0, pressure=pressure)
            flow = rc.gap_flow(solution, axis=None if all(periodic) else 0, tolerance=1e-9)
            unit = float(flow.gap.mean()) ** 3
            own, (low, high) = flow.transmissivity[0, 0] / unit, (each[0, 0] / unit for each in flow.interval)
            other = transmissivity(np.array(flow.gap), mode)
            print(
                f"| {pressure:g} | {solution.contact_fraction:.3f} | {mode} | {own:.6g} | {other:.6g} "
                f"| {other / own - 1:+.0e} | {low:.4g} to {high:.4g} |",
                flush=True,
            )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 128)
