"""
Why is my curve unresolved?
===========================

Open points are not resolved by the grid. Below twenty times the stiffness of one cell, the result depends on
the cell size. Above nine tenths of the stiffness of all cells, it depends on the size of the map. The
example shows one surface with coarse and with fine cells: fine cells resolve lighter loads.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

side, forces, resolved = 128e-6, np.geomspace(1e-3, 10, 17), []
panels = plt.subplots(1, 2, figsize=(9, 3.6), sharey=True, layout="constrained")[1]
for axes, count in zip(panels, (32, 256), strict=True):
    grid = rc.Grid((count, count), side / count)
    rng = np.random.default_rng(1)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rms_band=(side, 10e-6), rng=rng)
    curve = rc.loading_curve(surface, 110e9, forces=forces)
    curve.plot(axes)
    axes.set_title(f"{count} x {count} cells: {curve.resolved.sum()} of {len(forces)} resolved")
    resolved.append(curve.resolved.sum())
    print(curve)

assert resolved[0] < resolved[1]
