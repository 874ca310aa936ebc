"""
Friction of a rubber against speed
==================================

A rough rigid surface slides over rubber. At low speed the rubber relaxes, at high speed it is stiff, and in
between it dissipates most. Persson's theory is drawn for both values of its factor gamma.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact.theory import persson_friction, waves

rubber = rc.Viscoelastic(2e6, [2e6, 4e6, 8e6, 16e6], [1e-2, 1e-3, 1e-4, 1e-5])
grid = rc.Grid((96, 96), 1e-5, periodic=True)
surface = rc.self_affine(grid, hurst=0.8, rms=6e-6, rng=2, rolloff=2.4e-4, short_cutoff=4e-5)
speeds = np.geomspace(1e-4, 1e2, 13)
curve = rc.friction_curve(surface, rubber, speeds=speeds, pressure=2e5)

spectrum = waves.Waves.of_heights(surface.heights, grid.spacing)
fine = np.geomspace(1e-4, 1e2, 49)
axes = plt.subplots()[1]
axes.semilogx(speeds, curve.friction_coefficient, "o", label="computed")
for gamma, style in ((1.0, "--"), (0.5, ":")):
    theory = [
        persson_friction.friction_coefficient(2e5, rubber, spectrum, speed, gamma=gamma) for speed in fine
    ]
    axes.semilogx(fine, theory, style, color="C0", label=f"Persson, gamma = {gamma:g}")
right = axes.twinx()
right.semilogx(speeds, curve.contact_fraction, "s-", color="C1", markersize=4)
right.set_ylim(0)
right.set_ylabel("relative contact area", color="C1")
axes.set(xlabel="sliding speed [m/s]", ylabel="friction coefficient", ylim=(0, None))
axes.legend()

peak, predicted = speeds[curve.friction_coefficient.argmax()], fine[np.argmax(theory)]
print(f"most friction at {peak:.2g} m/s, by the theory at {predicted:.2g} m/s")
assert 0.1 < peak / predicted < 10
