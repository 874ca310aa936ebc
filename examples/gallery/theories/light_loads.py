"""
Contact area at light loads
===========================

All theories predict A/A0 = kappa p/(E* g) with the rms slope g. The theory of Bush, Gibson and Thomas has
kappa = 2.5, and Persson's has 1.6. The example compares both with a computation.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

modulus = 110e9
grid = rc.Grid((512, 512), 1e-6, periodic=True)
surface = rc.self_affine(
    grid, hurst=0.8, rms=1e-7, rolloff=64e-6, short_cutoff=12e-6, rng=np.random.default_rng(1)
)
moments = rc.surface_moments(surface)
scale = modulus * moments.rms_slope
pressures = scale * np.geomspace(2e-3, 0.1, 7)
curve = rc.loading_curve(surface, modulus, pressures=pressures)
laws = rc.loading_laws(surface, modulus, ["bgt", "gw", "persson"])

axes = plt.subplots()[1]
axes.semilogx(pressures / scale, curve.contact_fraction * scale / pressures, "ko", label="computed")
for law in laws:
    area = law.predict("contact_area", curve.force)
    axes.semilogx(pressures / scale, area / grid.area * scale / pressures, label=law.name)
axes.set(xlabel="p / (E* g)", ylabel="kappa = A/A0 E* g / p", ylim=(0, 3))
axes.legend()

kappa = curve.contact_fraction * scale / pressures
print("computed:", np.round(kappa, 2))
assert np.all((kappa > np.sqrt(8 / np.pi)) & (kappa < np.sqrt(2 * np.pi)))  # between Persson and BGT
