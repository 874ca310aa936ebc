"""
Mask, fill and crop
===================

A mask removes a region, and a crop keeps only a region. Missing points can be filled for a step that
requires them.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid = rc.Grid((128, 128), 1e-6)
surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
masked = surface.masked(ellipse=(slice(30, 70), slice(50, 110)))
steps = {
    "masked": masked,
    "filled": masked.filled("harmonic"),
    "cropped": surface.cropped(slice(0, 64), slice(32, 128)),
}

panels = plt.subplots(1, 3, figsize=(11, 3), layout="constrained")[1]
for axes, (name, step) in zip(panels, steps.items(), strict=True):
    step.plot(axes)
    axes.set_title(name)

print(*masked.provenance[-1:])
area = np.pi * 20 * 30
assert abs(masked.missing / area - 1) < 0.02  # a cell belongs to the ellipse by its centre
assert steps["filled"].missing == 0
