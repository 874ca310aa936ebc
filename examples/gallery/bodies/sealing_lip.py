"""
A sealing lip: ring-shaped contact of a body of revolution
==========================================================

A rounded lip, such as the seat of a valve or the rim of a cup, is pressed against a flat and touches on a ring. Bodies
of revolution are computed on rings (``rc.RadialProfile`` on ``rc.RadialGrid``), and these may begin away from the
axis. How wide is the contact, how large is the pressure, and how stiff is the joint?

Width and pressure are those of Hertz' line contact under the force per circumference. His depth needs a reference
length, which the line contact does not determine. For a ring of radius r it is 8 r (thesis, eq. A.21).
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

modulus = rc.reduced_modulus("steel", "copper")
ring, tip = 5e-3, 0.5e-3  # radius of the ring and of the lip [m]
rings = rc.RadialGrid(ring + np.linspace(-30e-6, 30e-6, 301))
x = rings.radii - ring
lip = rc.RadialProfile(-(x**2) / (2 * tip), rings)

axes = plt.subplots()[1]
for force in 200.0, 400.0, 800.0:  # [N]
    solution = rc.press(lip, modulus, force=force)
    line = force / (2 * np.pi * ring)  # [N/m]
    hertz = rc.theory.hertz.line(modulus, radius=tip, force=line, reference_length=8 * ring)
    axes.plot(x * 1e6, solution.pressure / 1e6, label=f"{force:g} N")
    axes.plot(x * 1e6, hertz.pressure(np.abs(x)) / 1e6, "k:")
    width = solution.contact_area / (2 * np.pi * ring)
    print(f"{force:g} N: {width * 1e6:.1f} µm wide, by Hertz {2 * hertz.half_width * 1e6:.1f} µm; ", end="")
    print(f"{solution.depth * 1e6:.3f} µm deep, by Hertz {hertz.depth * 1e6:.3f} µm; ", end="")
    print(f"{solution.stiffness / 1e6:.0f} N/µm")
axes.plot([], [], "k:", label="Hertz")
axes.set(xlabel="distance from the crest of the lip [µm]", ylabel="pressure [MPa]", ylim=(0, None))
axes.legend()
assert abs(solution.depth / hertz.depth - 1) < 1e-3
