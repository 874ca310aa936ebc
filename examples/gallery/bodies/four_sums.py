"""
Four methods of summation: matrix, transform, moving grid, multilevel
=====================================================================

The displacement under a pressure is a sum over all cells, which can be computed by four methods. The moving grid
shifts the displacement under one cell to each loaded cell and adds them up, without a transform. If a method is
inexact, the exact sum certifies its answer. All four methods therefore give the same pressure.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid = rc.Grid((48, 48), 1e-6)
surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
solutions = {}
for method in "dense", "fft", "moving-grid", "multilevel":
    body = rc.half_space(grid, 110e9, method=method)
    solutions[method] = rc.press(surface, 110e9, force=0.5, operator=body)
dense = solutions.pop("dense").pressure

axes = plt.subplots()[1]
for method, solution in solutions.items():
    difference = np.abs(solution.pressure - dense)[dense > 0] / dense.max()
    axes.semilogy(np.maximum(difference, 1e-17), ".", label=method)
axes.set(xlabel="cell in contact", ylabel="difference from the dense sum / largest pressure")
axes.legend()

worst = max(solution.residual for solution in solutions.values())
print(f"largest residual {worst:.0e}")
assert worst <= 1e-8
