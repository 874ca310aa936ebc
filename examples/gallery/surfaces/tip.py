"""
Effect of the tip of a stylus
=============================

A tip does not reach the bottom of narrow valleys, so that short waves are missing from the measured
spectrum.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid = rc.Grid((256, 256), 1e-7)
surface = rc.self_affine(grid, hurst=0.6, rms=5e-8, rng=np.random.default_rng(1))
scanned = surface.scanned(2e-6)

axes = plt.subplots()[1]
for each, name in (surface, "surface"), (scanned, "scanned by a tip of 2 µm"):
    spectrum = rc.power_spectrum(each)
    axes.loglog(spectrum.wavenumber, spectrum.density, label=name)
axes.set(xlabel="wavenumber [rad/m]", ylabel="power [m$^4$]")
axes.legend()

ratio = rc.surface_moments(scanned).rms_slope / rc.surface_moments(surface).rms_slope
print(f"the rms slope falls to {ratio:.2f} of its value")
assert f"{ratio:.2f}" == "0.76"
