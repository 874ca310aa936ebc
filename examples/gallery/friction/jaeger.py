"""
A friction loop from the loading curve
======================================

Jaeger's rule predicts the displacement under a tangential force Q from the normal loading curve at the
forces F and F - Q/µ. Here it is compared with a full computation for a rough pad. The rule is exact if
Poisson's ratio is zero.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact.theory import jaeger, mindlin

solid, friction, force = rc.Solid(1e9, 0.0), 0.3, 0.02
grid = rc.Grid((96, 96), 1e-6)
pad = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(4))
pulls = np.linspace(0.1, 0.9, 9) * friction * force
loads = np.append(force - pulls[::-1] / friction, force)  # the forces that the rule needs
curve = rc.loading_curve(pad, (solid, solid), forces=loads)
ratio = mindlin.pair_ratio(solid, solid)
by_rule = jaeger.displacement(curve, force, pulls, friction=friction, ratio=ratio)
pressed = rc.press(pad, (solid, solid), force=force)
slid = rc.slide_curve(pressed, (solid, solid), friction=friction, forces=pulls)

axes = plt.subplots()[1]
axes.plot(by_rule * 1e9, pulls * 1e3, label="Jaeger's rule")
axes.plot(slid.displacement[:, 0] * 1e9, pulls * 1e3, "o", label="computed")
axes.set(xlabel="displacement [nm]", ylabel="tangential force [mN]")
axes.legend()

deviation = np.abs(by_rule - slid.displacement[:, 0]).max()
print(f"largest deviation {deviation:.0e} m")
# Two depths and a displacement, each accurate to 1e-8 of the displacement at full slip.
assert deviation < 3e-8 * friction * ratio * pressed.depth
