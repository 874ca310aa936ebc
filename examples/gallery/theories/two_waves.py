"""
A short wave on a long one
==========================

A short cosine wave on a long one, pressed on springs. Until the short wave is flat, the force has a closed
form.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact.theory import two_cosines

modulus, long, short = 1e9, 1e-5, 1e-6  # Pa; amplitudes, m
line = rc.Grid(2**17, 1e-2 / 2**17, periodic=True)
number = 2 * np.pi / 1e-2  # one long wave, a thousand short ones
x = line.coordinates[0]
heights = long * np.cos(number * x) + short * np.cos(1000 * number * x)
depths = 2 * short * np.geomspace(0.01, 1, 9)
springs = rc.foundation(line, modulus)
curve = rc.loading_curve(rc.Surface(heights, line), modulus, depths=depths, operator=springs)
exact = two_cosines.force(depths, (long, number), short, modulus)

axes = plt.subplots()[1]
axes.loglog(depths / short, curve.force, "o", label="computed")
axes.loglog(depths / short, exact, label="closed form")
axes.set(xlabel="depth / amplitude of the short wave", ylabel="force [N]")
axes.legend()

ratio = curve.force[-1] / exact[-1]
print(f"force at which the short wave is flat, relative to the closed form: {ratio:.3f}")
assert abs(ratio - 1) < 1 / 30  # a parabola for the long wave is off by d/(6 h)
