"""
Summits: counted and predicted
==============================

The number and the heights of the summits of a Gaussian surface: found on a map, and by Nayak's theory from
three moments of the spectrum.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact.theory import nayak

grid = rc.Grid((1024, 1024), 1e-6, periodic=True)
surface = rc.self_affine(
    grid, hurst=0.8, rms=1e-7, rolloff=64e-6, short_cutoff=8e-6, rng=np.random.default_rng(1)
)
moments, found = rc.surface_moments(surface), rc.find_summits(surface)
predicted = nayak.summits(moments)

axes = plt.subplots()[1]
axes.hist(found.height * 1e9, bins=50, density=True, alpha=0.5, label="found")
heights = np.linspace(-200, 400, 200)
normal = np.exp(-(((heights - predicted.mean_height * 1e9) / (predicted.std * 1e9)) ** 2) / 2)
axes.plot(heights, normal / (np.sqrt(2 * np.pi) * predicted.std * 1e9), label="mean and deviation of Nayak")
axes.set(xlabel="height of a summit [nm]", ylabel="density [1/nm]")
axes.legend()

ratio = found.density / predicted.density
off = (found.height.mean() - predicted.mean_height) / predicted.std * np.sqrt(found.count)
print(
    f"{found.count} summits, {ratio:.2f} of the predicted number; mean height {off:.1f} standard errors off"
)
# Three standard errors. A count N of random points has sqrt(N); summits repel each other, and scatter less.
assert abs(ratio - 1) < 3 / np.sqrt(found.count)
assert abs(off) < 3
