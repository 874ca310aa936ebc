"""
Electrical resistance of a contact
==================================

The conductance of a contact is proportional to its stiffness. This example computes the resistance of copper
on copper from the stiffness and plots it against pressure.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

copper = rc.handbook("copper")
grid = rc.Grid((128, 128), 4e-6, periodic=True)
rng = np.random.default_rng(1)
surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rolloff=128e-6, short_cutoff=32e-6, rng=rng)
curve = rc.loading_curve(surface, rc.reduced_modulus(copper, copper), pressures=np.geomspace(1e6, 1e8, 7))
resistance = rc.conductance(curve, resistivities=(1.7e-8, 1.7e-8))["electrical_resistance"]

axes = plt.subplots()[1]
axes.loglog(curve.nominal_pressure / 1e6, resistance, "o-")
axes.set(xlabel="pressure [MPa]", ylabel="resistance [ohm m$^2$]")

slope = np.polyfit(np.log(curve.nominal_pressure), np.log(resistance), 1)[0]
print(f"resistance ~ pressure^{slope:.2f}")
assert f"{slope:.2f}" == "-0.78"
