"""
A cone on rings
===============

Bodies of revolution are computed on rings. Here the rings are narrow at the tip of the cone, where the
pressure is steep.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

slope, modulus, force = 0.1, 1e9, 1e-3  # -, Pa, N
rings = rc.RadialGrid(8e-6 * np.linspace(0, 1, 201) ** 2)
cone = rc.RadialProfile(-slope * rings.radii, rings)
solution = rc.press(cone, modulus, force=force)
exact = rc.theory.power_law_indenter.contact(modulus, exponent=1, coefficient=slope, force=force)

r = rings.radii[solution.contact]
axes = plt.subplots()[1]
axes.semilogx(r * 1e6, solution.pressure[solution.contact] / 1e6, "o", markersize=3, label="computed")
axes.semilogx(r * 1e6, exact.pressure(r) / 1e6, label="Sneddon")
axes.set(xlabel="radius [µm]", ylabel="pressure [MPa]")
axes.legend()

ratio = solution.depth / exact.depth
print(f"depth relative to Sneddon: {ratio:.3f}")
assert abs(ratio - 1) < 1e-3  # the width of a ring, over the contact radius, squared
