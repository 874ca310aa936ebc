"""
Contact area under a hardness
=============================

The hardness limits the pressure. Where most spots flow, the real contact area is the force divided by the
hardness.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid = rc.Grid((128, 128), 1e-6)
surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
forces, hardness = np.geomspace(0.01, 0.1, 5), 2e8
elastic = rc.loading_curve(surface, 110e9, forces=forces)
plastic = rc.loading_curve(surface, 110e9, forces=forces, hardness=hardness)

axes = plt.subplots()[1]
for curve, name in (elastic, "elastic"), (plastic, "with a hardness of 0.2 GPa"):
    axes.loglog(forces, curve.contact_area * 1e12, "o", label=name)
axes.loglog(forces, forces / hardness * 1e12, "k--", label="force / hardness")
axes.set(xlabel="force [N]", ylabel="contact area [µm²]")
axes.legend()

ratio = plastic.contact_area[-1] * hardness / forces[-1]
print(f"area relative to force / hardness: {ratio:.2f}")
assert f"{ratio:.1f}" == "1.0"
