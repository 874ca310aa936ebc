"""
Remove tilt and form
====================

A scan of a ball: first the mean is subtracted, then the tilt, then the sphere that fits best. The roughness
remains.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid = rc.Grid((128, 128), 1e-6)
y, x = np.meshgrid(*grid.coordinates, indexing="ij")
rough = rc.self_affine(grid, hurst=0.8, rms=2e-8, rolloff=32e-6, rng=np.random.default_rng(1))
scan = rough + rc.shapes.sphere(grid, radius=2e-3) + rc.Surface(0.01 * x, grid)
stages = {
    "as scanned": scan.levelled("mean"),
    "tilt removed": scan.levelled("plane"),
    "sphere removed": scan.without_form("sphere"),
}

panels = plt.subplots(1, 3, figsize=(11, 3), layout="constrained")[1]
for axes, (name, stage) in zip(panels, stages.items(), strict=True):
    stage.plot(axes)
    axes.set_title(f"{name}: {stage.rms * 1e9:.0f} nm rms")

print(*scan.without_form("sphere").provenance[-1:])
assert f"{scan.without_form('sphere').rms * 1e9:.0f}" == f"{rough.rms * 1e9:.0f}"
