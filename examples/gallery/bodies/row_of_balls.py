"""
A row of balls
==============

An endless row of balls under one force each. Distant balls have the pressure of a Hertzian ball. Balls that
are close together have that of a cylinder. The map contains one ball and is periodic only along x.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

modulus, radius, force = 1e9, 1e-3, 1e-3  # Pa, m, N a ball
hertz = rc.theory.hertz.point(modulus, radius=radius, force=force)
spacing = hertz.contact_radius / 8
columns = np.array([2, 4, 8, 16, 24, 32, 64, 128])
largest = []
for count in columns:
    grid = rc.Grid((96, int(count)), spacing, periodic=(False, True))
    row = rc.singly_periodic(grid, modulus)
    ball = rc.shapes.paraboloid(grid, radius)
    largest.append(rc.press(ball, modulus, force=force, operator=row).pressure.max())
cylinder = rc.theory.hertz.line(modulus, radius=radius, force=force / (columns[:4] * spacing))

ratio = np.array(largest) / hertz.max_pressure
axes = plt.subplots()[1]
axes.semilogx(columns / 8, ratio, "o", label="computed")
axes.semilogx(columns[:4] / 8, cylinder.max_pressure / hertz.max_pressure, "--", label="cylinder")
axes.axhline(1, color="k", linestyle="--", label="ball")
axes.set(
    xlabel="pitch / contact radius of a single ball",
    ylabel="largest pressure / that of a single ball",
    ylim=(0, None),
)
axes.legend()

print("largest pressure relative to a single ball:", np.round(ratio, 3))
assert abs(ratio[-1] - 1) < 0.01  # (cell / contact radius)^2 is 0.016; the error of a mean is a third of it
