"""
Constriction resistance of a periodic array of spots
====================================================

The resistance of a round spot in its cell, relative to that of a single spot between half-spaces: computed
on a periodic map, and by the two formulae that theories of thermal joints use.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact.theory import thermal

grid = rc.Grid((128, 128), 1e-6, periodic=True)
y, x = np.indices(grid.shape) - 64
shares, computed = [], []
for radius in 4.5, 8.5, 16.5, 24.5, 32.5, 40.5, 48.5:
    spot = x**2 + y**2 < radius**2
    equal = np.sqrt(spot.sum() / np.pi) * 1e-6
    shares.append(equal / np.sqrt(grid.area / np.pi))
    computed.append(2 * equal / rc.contact_stiffness(spot, grid, 1.0))

axes = plt.subplots()[1]
axes.plot(shares, computed, "ko", label="computed, square cells")
fine = np.linspace(0.01, 0.9, 100)
for form in "power", "tube":
    axes.plot(fine, thermal.constriction(fine, form), label=f"psi, {form}")
axes.set(xlabel="radius of the spot / radius of its cell", ylabel="resistance / that of a single spot")
axes.legend()

tube = thermal.constriction(np.array(shares), "tube")
ratio = computed[3] / tube[3]
print(f"resistance relative to the tube, at a third of the radius: {ratio:.2f}")
assert f"{ratio:.2f}" == "1.02"
