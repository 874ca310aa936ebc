"""
A contact that grows under a held force
=======================================

Under a constant force, a viscoelastic contact grows. Lee and Radok's transfer computes this history from one
elastic curve. It is valid while the contact grows.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact import viscoelastic

grid = rc.Grid((128, 128), 1e-6)
surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
curve = rc.loading_curve(surface, 1e6, forces=np.geomspace(1e-7, 1e-3, 25))
# Equilibrium and instantaneous E* [Pa], relaxation time [s]
rubber = viscoelastic.standard_solid(1e6, 1e7, 0.5)
times = np.linspace(0, 30, 60)
history = viscoelastic.transfer(curve, rubber, times, forces=np.full(60, 1e-4))

axes = plt.subplots()[1]
axes.plot(times, history.contact_area * 1e12)
rest = np.interp(1e-4, curve.force, curve.contact_area)
axes.axhline(rest * 1e12, color="k", linestyle="--", label="elastic, E* of equilibrium")
axes.set(xlabel="time [s]", ylabel="contact area [µm²]")
axes.legend()

ratio = history.contact_area[-1] / rest
print(f"area after 30 s relative to that of equilibrium: {ratio:.3f}")
assert abs(ratio - 1) < np.exp(-6) * 2  # retardation time 5 s: 0.5 s times the ratio of moduli
