"""
Indenters of a power law
========================

Bodies of revolution z = Q r^n: a cone, a ball and a blunter body. Their stiffness grows as the force to the
power of 1/(n + 1).
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact.theory import power_law_indenter

grid, modulus, forces = rc.Grid((101, 101), 1e-6), 1e9, np.geomspace(1e-3, 1e-1, 7)
axes = plt.subplots()[1]
worst = 0.0
for exponent, edge in (1, 8e-6), (2, 3e-6), (4, 2e-6):  # height at 40 µm from the axis
    coefficient = edge / 40e-6**exponent
    body = rc.shapes.power_law(grid, exponent, coefficient)
    curve = rc.loading_curve(body, modulus, forces=forces)
    exact = power_law_indenter.contact(modulus, exponent=exponent, coefficient=coefficient, force=forces)
    line = axes.loglog(forces, exact.stiffness, label=f"n = {exponent}")[0]
    axes.loglog(forces, curve.stiffness, "o", color=line.get_color())
    deviation = np.abs(curve.stiffness / exact.stiffness - 1)
    worst = max(worst, (deviation / (0.5e-6 / exact.contact_radius)).max())
axes.set(xlabel="force [N]", ylabel="stiffness [N/m]")
axes.legend()

print(f"the largest deviation corresponds to an error of the radius of {worst / 2:.2f} cells")
assert worst < 1  # an edge is found to half a cell
