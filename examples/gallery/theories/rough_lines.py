"""
A hundred rough lines on springs
================================

The method of dimensionality reduction replaces a self-affine surface by a rough line on springs. The heights
only need to be sorted. The mean stiffness of many lines grows as F^(1/(H+1)).
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact.mdr import line_curves, random_lines, rough_line

grid, modulus, forces = rc.Grid(8192, 1e-7), 1e9, np.geomspace(1e-4, 5e-2, 30)
spectrum = rc.SelfAffineSpectrum(0.7, dimension=1)
batches = random_lines.rough_lines(grid, spectrum, np.random.default_rng(1), 100, rms=1e-6)
curves = line_curves.LineCurves.joined(
    rough_line.loading_curves(heights, 1e-7, modulus, forces=forces) for heights in batches
)
law = curves.fit()

axes = plt.subplots()[1]
axes.loglog(curves.dimensionless_force, curves.stiffness.T / curves.stiffness_scale, "0.8", linewidth=0.5)
axes.loglog(curves.dimensionless_force, curves.mean_stiffness() / curves.stiffness_scale, "o")
axes.set(xlabel="F / (E* h L)", ylabel="k / (E* L)")

print(f"exponent {law.exponent:.3f} +- {law.exponent_error:.3f}, 1/(H+1) = {1 / 1.7:.3f}")
assert abs(law.exponent - 1 / 1.7) < 3 * law.exponent_error
