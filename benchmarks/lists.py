"""Exact products between the cells that overlap: tile by tile, and by transforms of the box that holds them.

    python benchmarks/lists.py [cells a side]...

A self-affine surface, H = 0.8, pressed by growing forces; milliseconds, least of some runs, on the cores there are.
Where direct sums over tiles cost less is what `SUMS` in `roughcontact/halfspace/operators/cell_list.py` says.
See README.md beside this file.
"""

from __future__ import annotations

import sys

import numpy as np
from transforms import best

import roughcontact as rc
from roughcontact.halfspace.operators.cell_list import CellsOperator
from roughcontact.halfspace.sums.tiles import Tiles
from roughcontact.solver.subdomain import bounding_box
from roughcontact.threads import one_blas_thread

SIZES = (512, 1024, 2048)
RMS = 0.01
FORCES = (0.001, 0.003, 0.01, 0.03, 0.07)  # over E* h L


def line(solution: rc.Solution) -> str:
    """Return the numbers of one contact."""
    separation, box = solution.problem.separation, bounding_box(solution.problem.separation < solution.depth)
    assert box is not None  # a contact overlaps
    pressure = solution.pressure[box]
    overlap = separation[box] < solution.depth
    plane = solution.problem.operator.restrict(box)
    cells = np.flatnonzero(overlap)
    listed = plane.submatrix(cells)
    assert isinstance(listed, CellsOperator)
    given, loaded = pressure.ravel()[cells], np.flatnonzero(pressure.ravel()[cells])
    tiles = len(Tiles.of(overlap))
    by_tiles = best(lambda: listed._tiles.scatter(listed._sum.apply(listed._tiles.gather(given))))
    by_plane = best(lambda: listed._by_the_plane(given, loaded))
    pairs = len(loaded) * tiles / pressure.size
    return (
        f"{len(loaded)} | {len(cells)} | {tiles} | {pressure.shape[0]} x {pressure.shape[1]} | {pairs:.2g} | "
        f"{by_tiles:.2f} | {by_plane:.2f} |"
    )


def main() -> None:
    print(
        "| cells | force | in contact | overlap | tiles | box | pairs a cell of the box | by tiles | by the box |"
    )
    print("|---" * 9 + "|")
    for n in [int(a) for a in sys.argv[1:]] or SIZES:
        surface = rc.self_affine(rc.Grid((n, n), 1 / n), 0.8, RMS, np.random.default_rng(0))
        for force in FORCES:
            print(f"| {n}^2 | {force} | {line(rc.press(surface, 1.0, force=force * RMS))}", flush=True)


if __name__ == "__main__":
    with one_blas_thread():
        main()
