"""
An elliptic contact
===================

Crossed cylinders of different radii touch in an ellipse. If one radius is four times the other, the ellipse
is 2.5 times as long as wide.
"""

import numpy as np
from matplotlib.patches import Ellipse

import roughcontact as rc

modulus, force, radii = 110e9, 1.0, (4e-3, 1e-3)  # Pa, N, m along x and along y
grid = rc.Grid((81, 161), 5e-7)
y, x = np.meshgrid(*(each - each.mean() for each in grid.coordinates), indexing="ij")
surface = rc.Surface(-(x**2) / (2 * radii[0]) - y**2 / (2 * radii[1]), grid)
solution = rc.press(surface, modulus, force=force)
hertz = rc.theory.hertz.elliptic(modulus, radii=radii, force=force)

axes = solution.plot()
middle = [0.5e6 * length for length in reversed(grid.lengths)]
sides = [2e6 * float(each) for each in sorted(hertz.semi_axes, reverse=True)]
axes.add_patch(Ellipse(middle, *sides, fill=False, edgecolor="k", linestyle="--"))

ratio = solution.depth / hertz.depth
print(f"semi-axes {sides[0] / 2:.1f} and {sides[1] / 2:.1f} µm; depth relative to Hertz {ratio:.4f}")
assert abs(ratio - 1) < (5e-7 / hertz.semi_axes[1]) ** 2  # the cell over the shorter semi-axis, squared
