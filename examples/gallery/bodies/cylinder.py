"""
A cylinder on a flat
====================

A line contact: nothing varies along the cylinder, and forces are per length. The pressure is that of Hertz.
"""

import numpy as np

import roughcontact as rc

grid = rc.Grid(401, 1e-6)
x = (np.arange(401) - 200) * 1e-6
cylinder = rc.Surface(-(x**2) / (2 * 0.02), grid)
solution = rc.press(cylinder, 110e9, force=2e4, operator=rc.line(grid, 110e9))  # N/m
axes = rc.plot.pressure_profile(solution)
hertz = rc.theory.hertz.line(110e9, radius=0.02, force=2e4)

ratio = solution.pressure.max() / hertz.max_pressure
print(f"largest pressure relative to Hertz: {ratio:.3f}")
assert f"{ratio:.2f}" == "1.00"
