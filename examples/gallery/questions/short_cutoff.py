"""
Which cut-off?
==============

Shorter and shorter waves are added to one surface. The stiffness of the joint soon stops changing. The rms
slope continues to grow, and the contact area continues to fall, approximately as 1 / rms slope. For a
stiffness, use any cut-off below that at which it stops changing. Always state a contact area together with
its cut-off.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

modulus, grid = 60e9, rc.Grid((256, 256), 2e-6, periodic=True)
cutoffs, rows = np.array([64, 32, 16, 8, 6]) * 1e-6, []
waves = {"hurst": 0.8, "rms": 1e-6, "rms_band": (512e-6, 64e-6), "rolloff": 128e-6}
for cutoff in cutoffs:
    surface = rc.self_affine(grid, **waves, short_cutoff=cutoff, rng=np.random.default_rng(1))
    solution = rc.press(surface, modulus, pressure=1e8)
    slope = rc.surface_moments(surface).rms_slope
    rows.append((solution.stiffness, solution.contact_area, 1 / slope))

stiffness, area, inverse = np.array(rows).T
axes = plt.subplots()[1]
for values, name in (stiffness, "stiffness"), (area, "contact area"), (inverse, "1 / rms slope"):
    axes.semilogx(cutoffs * 1e6, values / values[0], "o-", base=2, label=name)
axes.set(xlabel="short cut-off [µm]", ylabel="value / that with waves above 64 µm", ylim=(0, None))
axes.invert_xaxis()
axes.legend()

stiffer, smaller = (np.abs(values[3:] / values[2] - 1) for values in (stiffness, area))
print(f"below 16 µm the stiffness changes by {stiffer.max():.1%}, the area by {smaller.max():.0%}")
assert np.all(stiffer < smaller)
assert np.all(np.diff(area) < 0)
