"""
From heights to stiffness
=========================

The stiffness of a line on springs depends only on the distribution of its heights. Near the highest peak,
this distribution is a power of the depth, and the stiffness is therefore a power of the force. With more
waves of random phase, the curves become steeper and approach that of Gaussian heights.
"""

import matplotlib.pyplot as plt
import numpy as np

from roughcontact.theory import beat_wave, gaussian_heights

forces = np.geomspace(1e-7, 1, 60)  # F/(E* L h), h the rms height
axes, exponents = plt.subplots()[1], []
for modes in 1, 2, 4:
    waves = beat_wave.beat_wave(modes, np.sqrt(2 / modes))
    law = waves.law(1.0, 1.0)
    stiffness = law.predict("stiffness", forces)
    axes.loglog(forces, stiffness, label=f"{modes} waves")
    exponents.append(float(np.log(stiffness[1] / stiffness[0]) / np.log(forces[1] / forces[0])))
axes.loglog(forces, gaussian_heights.stiffness(forces, 1.0, 1.0, 1.0), "k--", label="Gaussian")
axes.set(xlabel="F / (E* h L)", ylabel="k / (E* L)")
axes.legend()

print("exponents at light loads:", np.round(exponents, 3))
assert np.allclose(exponents, [1 / 3, 1 / 2, 2 / 3], atol=1e-3)  # N/(N + 2)
