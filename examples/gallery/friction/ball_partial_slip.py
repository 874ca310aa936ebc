"""
Partial slip of a ball
======================

A ball is pressed on a flat and pulled tangentially. A ring at the edge slips and the middle sticks (Cattaneo
1938, Mindlin 1949).
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

solid, friction = rc.Solid(1e7, 0.0), 0.5  # without lateral contraction the closed form is exact
grid = rc.Grid((101, 101), 4e-6)
pressed = rc.press(rc.shapes.paraboloid(grid, radius=1e-3), (solid, solid), force=1e-3)
slid = rc.slide(pressed, (solid, solid), friction=friction, force=(0.3e-3, 0.0))
modulus, ratio = rc.reduced_modulus(solid, solid), rc.theory.mindlin.pair_ratio(solid, solid)
exact = rc.theory.cattaneo.SlippingSphere(1e-3, 1e-3, modulus, friction, ratio)

x = (np.arange(101) - 50) * 4e-6
axes = plt.subplots()[1]
axes.plot(x * 1e6, slid.traction[0, 50] / 1e3, "o", markersize=3, label="computed")
axes.plot(x * 1e6, exact.traction(np.abs(x), 0.3e-3) / 1e3, label="Cattaneo")
axes.plot(x * 1e6, friction * pressed.pressure[50] / 1e3, "k:", label="friction times pressure")
axes.set(xlabel="x [µm]", ylabel="traction [kPa]")
axes.legend()

radius = np.sqrt(slid.stick_area / np.pi) / float(exact.stick_radius(0.3e-3))
print(f"stick radius relative to Cattaneo: {radius:.3f}")
assert abs(radius - 1) < 0.5 * 4e-6 / float(exact.stick_radius(0.3e-3))  # half a cell
