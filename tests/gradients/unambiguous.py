"""Curves of 12 x 12 cells of 1 m that are smooth for changes of the heights below 1e-4 m: no cell nearly touches.

Derivatives of such a curve by central differences of 1e-6 m in double precision are uncertain by the error of a value
over the step. Loads are solved to 1e-13 of a depth below 0.4 m, and the stiffness is below 20 N/m. So the values have
errors below 8e-13 (N, m and J), and the difference quotients errors below 8e-7.
"""

import numpy as np

import roughcontact as rc

STEP, UNCERTAIN = 1e-6, 8e-7
FORCES = (0.4, 1.0)


def rough(periodic):
    grid = rc.Grid((12, 12), 1.0, periodic=True)
    heights = rc.self_affine(grid, hurst=0.8, rms=0.1, rng=11, short_cutoff=3.0).heights
    return rc.Surface(heights, rc.Grid((12, 12), 1.0, periodic=periodic))


def smooth_curve(surface, *, held="force", reference="first touch"):
    """Return a curve of two loads, after a check that its cells are clearly open or in contact."""
    path = list(rc.loading_path(surface, 1.0, forces=FORCES, tolerance=1e-13))
    for solution in path:
        assert solution.gap[~solution.contact].min() > 5e-4
        assert solution.pressure[solution.contact].min() > 5e-4
        assert solution.stiffness < 20
        assert solution.depth < 0.4
    assert np.diff(np.sort(surface.heights, axis=None)[-2:]) > 1e-2  # one cell is the highest
    level = surface.heights.max() if reference == "level" else 0.0
    loads = {"forces": FORCES} if held == "force" else {"depths": [each.depth - level for each in path]}
    return rc.differentiable_curve(surface.grid, 1.0, tolerance=1e-13, reference=reference, **loads)
