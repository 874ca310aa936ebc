"""
Flat punches of several shapes
==============================

The shape factor k/(2 E* sqrt(A/pi)) of four flat punches. No flat punch is softer than a disc of the same
area (Pólya and Szegő).
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid, modulus = rc.Grid((96, 96), 1e-6), 110e9
shapes = {
    "disc": rc.shapes.flat_disc(grid, 40e-6),
    "square": rc.shapes.flat_square(grid, 80e-6),
    "triangle": rc.shapes.flat_triangle(grid, 90e-6),
    "ring": rc.shapes.flat_ring(grid, 30e-6, 40e-6),
}
factors = {}
panels = plt.subplots(1, 4, figsize=(9, 2.6), layout="constrained")[1]
for axes, (name, shape) in zip(panels, shapes.items(), strict=True):
    solution = rc.press(shape, modulus, force=1.0)
    factors[name] = float(rc.theory.punch.shape_factor(solution.stiffness, modulus, solution.contact_area))
    axes.imshow(
        np.where(shape.measured, solution.pressure, np.nan), vmax=2 * solution.force / solution.contact_area
    )
    axes.set(title=f"{name}: {factors[name]:.3f}", xticks=[], yticks=[])

print(factors)
assert min(factors.values()) == factors["disc"]
assert f"{factors['square']:.2f}" == "1.02"  # 1.152298/(2/sqrt(pi))
