"""
A ball on a flat
================

The computed pressure under a smooth ball agrees with that of Hertz in every cell.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

radius, modulus, force = 1e-2, 110e9, 1.0  # m, Pa, N
grid = rc.Grid((101, 101), 1e-6)
solution = rc.press(rc.shapes.paraboloid(grid, radius), modulus, force=force)
hertz = rc.theory.hertz.point(modulus=modulus, radius=radius, force=force)

x = (np.arange(101) - 50) * 1e-6
axes = plt.subplots()[1]
axes.plot(x * 1e6, solution.pressure[50] / 1e6, "o", markersize=3, label="computed")
axes.plot(x * 1e6, hertz.pressure(np.abs(x)) / 1e6, label="Hertz")
axes.set(xlabel="x [µm]", ylabel="pressure [MPa]")
axes.legend()

ratio = solution.depth / hertz.depth
print(f"depth relative to Hertz: {ratio:.3f}")
assert f"{ratio:.2f}" == "1.00"
