"""
Roughness reduces the pull-off force
====================================

A soft rough pad is pressed on a flat and pulled off again. With waves of twice the height, the same
attraction gives a smaller pull-off force. With four times the height almost none is left, because the
summits keep the faces apart (Fuller and Tabor 1975).
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid, attraction = rc.Grid((32, 32), 1e-6), rc.Adhesion(work=0.05, range=5e-7)
waves = {"hurst": 0.8, "short_cutoff": 4e-6}
there = np.linspace(-2e-6, 1.5e-6, 15)
depths = np.append(there, there[-2::-1])  # and back
axes, pull_off = plt.subplots()[1], []
for rms in 3e-7, 6e-7, 1.2e-6:
    pad = rc.self_affine(grid, rms=rms, **waves, rng=np.random.default_rng(1))
    curve = rc.adhesive_curve(pad, 1e6, attraction, depths=depths)
    axes.plot(depths * 1e6, curve.force * 1e6, ".-", label=f"{rms * 1e6:.1f} µm rms")
    pull_off.append(curve.pull_off_force)
axes.set(xlabel="depth [µm]", ylabel="force [µN]")
axes.legend()

print("pull-off forces:", ", ".join(f"{force * 1e6:.1f}" for force in pull_off), "µN")
assert np.all(np.diff(pull_off) < 0)
