"""
Pull-off force against Tabor's number
=====================================

The pull-off force of a ball falls from 2 pi w R (Derjaguin, Muller and Toporov: hard, small, long-ranged
attraction) to 3/2 pi w R (Johnson, Kendall and Roberts). Maugis' equations describe the transition. The
points are balls computed on rings, with Dugdale's attraction and with an exponential one of the same
strength w/range.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact.theory import maugis

shown = np.geomspace(0.03, 10, 60)
theory = [maugis.DugdaleSphere.of_number(number).pull_off_force / np.pi for number in shown]  # w = R = E* = 1
axes = plt.subplots()[1]
axes.semilogx(shown, theory, "k", label="Maugis")
axes.axhline(2, color="0.6", linestyle=":", label="DMT")
axes.axhline(1.5, color="0.6", linestyle="--", label="JKR")

numbers, cells, errors = (0.1, 0.5, 2.0), 60, []
for law, mark in ("dugdale", "o"), ("exponential", "s"):
    pulled = []
    for number in numbers:
        ball = maugis.DugdaleSphere.of_number(number)
        attraction = rc.Adhesion(work=1.0, range=1 / ball.strength, law=law)
        # Up to where the gap is some ranges wide; the contact radius without load is below 1.7.
        reach = np.sqrt(1.7**2 + 2 * (10 if law == "exponential" else 2) * attraction.range)
        rings = rc.RadialGrid.uniform(cells, reach)
        profile = rc.RadialProfile(-(rings.radii**2) / 2, rings)
        *_, off = rc.adhesive_path(profile, 1.0, attraction, forces=[0.0, -2.5 * np.pi])
        pulled.append(-off.jumps[-1].force_before / np.pi)
    axes.plot(numbers, pulled, mark, label=f"rings, {law}")
    if law == "dugdale":
        exact = [maugis.DugdaleSphere.of_number(number).pull_off_force / np.pi for number in numbers]
        errors = np.abs(np.divide(pulled, exact) - 1)
axes.set(xlabel="Maugis' lambda, 1.127 times Tabor's number", ylabel="pull-off force over π w R")
axes.legend()

print(f"largest deviation from Maugis' equations {errors.max():.1e}")
# The edge of the attraction is accurate to one ring: at most 2/cells of the area on which it acts.
assert errors.max() < 2 / cells
