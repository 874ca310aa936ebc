"""
A rough sphere
==============

At light loads, the stiffness of a rough sphere is that of its roughness; at heavy loads, it is that of the
sphere. Between these limits, the forces of sphere and roughness at the same stiffness are added (thesis, eq.
5.9).
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

radius, hurst, rms, modulus = 2e-3, 0.7, 3e-8, 1e9
grid = rc.Grid((256, 256), 1e-6)
length, forces = grid.lengths[0], np.geomspace(1e-5, 3e-2, 9)
computed = []
for seed in range(4):
    rough = rc.self_affine(grid, hurst=hurst, rms=rms, rng=np.random.default_rng(seed))
    body = rough + rc.shapes.paraboloid(grid, radius)
    computed.append(rc.loading_curve(body, modulus, forces=forces).stiffness)
law = rc.theory.rough_sphere.law(radius, hurst, rms, length, modulus)

axes = plt.subplots()[1]
axes.loglog(forces, np.transpose(computed), "k.")
axes.loglog(forces, law.predict("stiffness", forces), label="rough sphere")
hertz = rc.theory.hertz.point(modulus, radius=radius, force=forces).stiffness
axes.loglog(forces, hertz, "--", label="Hertz")
axes.set(xlabel="force [N]", ylabel="stiffness [N/m]")
axes.legend()

ratio = np.mean(computed, axis=0) / law.predict("stiffness", forces)
print("computed stiffness relative to the law:", np.round(ratio, 2))
assert np.all(np.abs(ratio - 1) < 0.3 / np.sqrt(4))  # the standard error of four that scatter by 30 %
