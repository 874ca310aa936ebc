"""
Asperities with and without interaction
=======================================

The summits of a map as Hertzian caps, independent of each other or with the displacement of each under the
force on all others. Interaction removes most of the difference from the full computation. Dotted: the theory
of Ciavarella, Greenwood and Paggi, of statistical summits on a body that is displaced as a whole.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact.theory import asperities

grid, modulus, forces = rc.Grid((256, 256), 1e-6), 110e9, np.geomspace(0.03, 3, 7)
surface = rc.self_affine(
    grid, hurst=0.8, rms=1e-7, rolloff=64e-6, short_cutoff=16e-6, rng=np.random.default_rng(1)
)
curve = rc.loading_curve(surface, modulus, forces=forces)
found = rc.find_summits(surface)
x, y = found.columns * 1e-6, found.rows * 1e-6
caps = asperities.Asperities(x, y, found.height, found.radius, modulus)

axes = plt.subplots()[1]
axes.loglog(forces, curve.stiffness / 1e6, "ko", label="computed")
for interaction, name in (False, "without interaction"), (True, "with interaction"):
    stiffness = [asperities.press(caps, force=f, interaction=interaction).stiffness for f in forces]
    axes.loglog(forces, np.array(stiffness) / 1e6, label=f"asperities {name}")
for law in rc.loading_laws(surface, modulus, ["cgp"]):
    axes.loglog(forces, law.predict("stiffness", forces) / 1e6, ":", label=law.name)
axes.set(xlabel="force [N]", ylabel="stiffness [N/µm]")
axes.legend()

ratio = stiffness[0] / curve.stiffness[0]
print(f"with interaction, at the smallest force: {ratio:.2f} of the computed stiffness")
assert f"{ratio:.1f}" == "1.0"
