"""
How fine a mesh?
================

The same surface, whose shortest wave is 16 µm, on finer and finer grids. A few cells per wave are enough for
the stiffness. The contact area exceeds its limit by an error proportional to the cell size, because the rim
of each spot is counted in whole cells. `rms_band` makes the surface the same on all grids.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

counts, areas, stiffnesses = np.array([64, 128, 256, 512]), [], []
waves = {"hurst": 0.8, "rms": 1e-7, "rms_band": (256e-6, 16e-6), "rolloff": 64e-6, "short_cutoff": 16e-6}
for count in counts:
    grid = rc.Grid((int(count),) * 2, 256e-6 / count, periodic=True)
    surface = rc.self_affine(grid, **waves, rng=np.random.default_rng(1))
    solution = rc.press(surface, 110e9, pressure=2e7)
    areas.append(solution.contact_fraction)
    stiffnesses.append(solution.stiffness)

limit = 2 * areas[-1] - areas[-2]  # an error of the first order in the cell
axes = plt.subplots()[1]
cells = 16e-6 / (256e-6 / counts)  # per wave
axes.semilogx(cells, np.array(areas) / limit, "o-", base=2, label="area / its limit")
axes.semilogx(
    cells, np.array(stiffnesses) / stiffnesses[-1], "s-", base=2, label="stiffness / that on the finest grid"
)
axes.set(xlabel="cells per wave", ylim=(0.9, None))
axes.legend()

order = np.log2((areas[1] - areas[2]) / (areas[2] - areas[3]))
print(f"order of the area {order:.1f}; the stiffness changes by {np.ptp(stiffnesses) / stiffnesses[-1]:.1%}")
assert f"{order:.0f}" == "1"
