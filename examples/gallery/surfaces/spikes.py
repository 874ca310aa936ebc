"""
Find and remove spikes
======================

A flat first touches the few faulty points that stand far out of a map. These spikes are found, listed and
removed.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid, modulus = rc.Grid((128, 128), 1e-6), 110e9
clean = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
heights = clean.heights.copy()
heights[20, 30] += 3e-6
heights[90, 100] += 4e-6
scan = rc.Surface(heights, grid)
spikes = rc.find_spikes(scan)
mended = scan.despiked("filled")

left, right = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")[1]
scan.plot(left, spikes=spikes)
forces = np.geomspace(0.1, 10, 9)
for surface, name in (scan, "with spikes"), (mended, "mended"), (clean, "before"):
    curve = rc.loading_curve(surface, modulus, forces=forces)
    right.loglog(forces, curve.stiffness / 1e6, "o--" if surface is clean else "-", label=name)
right.set(xlabel="force [N]", ylabel="stiffness [N/µm]")
right.legend()

print(spikes)
assert spikes.count == 2
assert np.abs(mended.heights - clean.heights).max() < 1e-7
