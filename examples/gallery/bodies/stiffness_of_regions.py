"""
Stiffness of contact regions
============================

The stiffness of a region depends on its extent, not only on its area: two discs apart are stiffer than one
disc of the same total area.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid = rc.Grid((128, 128), 1e-6)
y, x = np.indices(grid.shape) - 63.5
one = x**2 + y**2 < 20**2
two = ((x - 30) ** 2 + y**2 < 200) | ((x + 30) ** 2 + y**2 < 200)
stiffness = [rc.contact_stiffness(mask, grid, 110e9) for mask in (one, two)]

panels = plt.subplots(1, 2, layout="constrained")[1]
for axes, mask, k in zip(panels, (one, two), stiffness, strict=True):
    axes.imshow(mask, cmap="Greys")
    axes.set(title=f"{k / 1e6:.2f} N/µm", xlabel="x [µm]", ylabel="y [µm]")

exact = rc.theory.punch.disc(110e9, np.sqrt(one.sum() / np.pi) * 1e-6)
print(f"one disc relative to the closed form: {stiffness[0] / exact:.3f}")
assert f"{stiffness[0] / exact:.3f}" == "0.994"
