"""
Contact area: computed and by theories
======================================

The contact area of a nominally flat surface: computed, by Persson's theory, and by two asperity models
(Greenwood and Williamson; Bush, Gibson and Thomas).
"""

import numpy as np

import roughcontact as rc

grid = rc.Grid((128, 128), 4e-6, periodic=True)
rng = np.random.default_rng(1)
surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rolloff=128e-6, short_cutoff=32e-6, rng=rng)
curve = rc.loading_curve(surface, 57e9, pressures=np.geomspace(3e6, 3e8, 9))
theories = rc.loading_laws(surface, 57e9, ["persson", "gw", "bgt"])
axes = curve.plot(quantity="contact_area", theories=theories)
axes.legend()

share = curve.contact_fraction[-1]
print(f"at {curve.nominal_pressure[-1] / 1e6:.0f} MPa, {100 * share:.0f} % of the surface is in contact")
assert f"{100 * share:.0f}" == "16"
