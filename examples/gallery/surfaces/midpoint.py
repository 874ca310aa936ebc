"""
Random midpoint displacement
============================

A fractal landscape, made by displacing the middles of ever smaller squares.
"""

import numpy as np

import roughcontact as rc

grid = rc.Grid((129, 129), 1e-6)
surface = rc.midpoint_surface(grid, 0.7, np.random.default_rng(1), rms=1e-7)
surface.plot()

print(f"rms height {surface.rms * 1e9:.0f} nm")
assert f"{surface.rms * 1e9:.0f}" == "100"
