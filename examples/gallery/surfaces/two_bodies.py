"""
Two rough bodies as one
=======================

The contact of two rough bodies depends only on the sum of their heights. A body with this sum has the same
gap against a flat, and the same contact. The upper body is turned over like a page, so that its columns are
reversed.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid = rc.Grid((128, 128), 1e-6)
spectrum = rc.StretchedSpectrum(rc.SelfAffineSpectrum(0.8, rolloff=32e-6), 8.0)
ground = rc.synthesise(grid, spectrum, np.random.default_rng(1), rms=1e-7)
blasted = rc.self_affine(grid, hurst=0.5, rms=1e-7, rolloff=32e-6, rng=np.random.default_rng(2))
both = rc.combined(ground, blasted)

panels = plt.subplots(1, 3, figsize=(11, 3), layout="constrained")[1]
for axes, surface, name in zip(panels, (ground, blasted, both), ("lower", "upper", "both"), strict=True):
    surface.plot(axes)
    axes.set_title(f"{name}: {surface.rms * 1e9:.0f} nm rms")

apart = both.heights - (ground.heights + blasted.heights[:, ::-1])
print(f"difference from the sum of the heights: {np.ptp(apart):.0e} m")
assert np.ptp(apart) <= 4 * np.finfo(float).eps * np.abs(both.heights).max()  # rounding of one or two sums
