"""
Approach and retreat of an adhesive ball
========================================

Force against depth of an adhesive ball on a soft flat, for approach and retreat. The ball jumps into contact
and later out of contact (dashed). The area of the loop is the energy that the jumps dissipate. The pull-off
force lies between the limits of Johnson, Kendall and Roberts, 3/2 pi w R, and of a hard ball, 2 pi w R.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact.mdr import adhesion as mdr_adhesion, indenter

radius, modulus = 1e-5, 1e8
attraction = rc.Adhesion(work=10e-3, range=2.5e-9)
rings = rc.RadialGrid.uniform(80, radius=6e-7)
ball = rc.RadialProfile(-(rings.radii**2) / (2 * radius), rings)
loop = rc.adhesive_loop(ball, modulus, attraction, depth=10e-9, points=30)
limit = mdr_adhesion.jkr(indenter.paraboloid(radius), modulus, attraction.work)
radii = np.linspace(1e-8, 6e-7, 200)

axes = plt.subplots()[1]
for part, name in (loop.approach, "approach"), (~loop.approach, "retreat"):
    axes.plot(loop.depth[part] * 1e9, loop.force[part] * 1e6, ".-", label=name)
for jump in loop.jumps:
    axes.plot([jump.depth * 1e9] * 2, [jump.force_before * 1e6, jump.force_after * 1e6], "k--")
axes.plot(limit.depth(radii) * 1e9, limit.force(radii) * 1e6, "k:", label="JKR")
axes.set(xlabel="depth [nm]", ylabel="force [µN]", xlim=(-20, 12))
axes.legend()

pull_off = loop.pull_off_force / (np.pi * attraction.work * radius)
tabor = attraction.tabor(radius, modulus)
print(f"Tabor's number {tabor:.1f}: pull-off force {pull_off:.2f} pi w R, {loop.lost * 1e18:.0f} aJ lost")
assert 1.5 < pull_off < 2
