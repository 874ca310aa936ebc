"""
From heights to stiffness
=========================

On springs only the distribution of the heights matters: near the highest peak it is a power of the depth, and
so is the stiffness of the force. Sums of more and more waves of random phase grow steeper, towards Gaussian
heights.
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
