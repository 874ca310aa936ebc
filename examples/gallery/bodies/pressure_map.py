"""
Pressure on a rough surface
===========================

A self-affine square carries its load on a few spots.
"""

import numpy as np

import roughcontact as rc

grid = rc.Grid((128, 128), 1e-6)
surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
solution = rc.press(surface, 110e9, force=0.5)
solution.plot()

share = solution.contact_area / grid.area
print(f"{100 * share:.1f} % of the square is in contact")
assert f"{100 * share:.1f}" == "3.5"
