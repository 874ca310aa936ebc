"""
A friction loop
===============

A ball is pressed on a flat and moved back and forth by a tangential force. Slip starts at the edge of the
contact and spreads inward. Each cycle dissipates energy.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

rubber = rc.Solid(1e7, 0.5)
ball = rc.shapes.paraboloid(rc.Grid((64, 64), 5e-6), radius=1e-3)
pressed = rc.press(ball, rubber, force=1e-3)
up = np.linspace(0.0, 0.4e-3, 9)
forces = np.concatenate([up, up[-2::-1], -up[1:], -up[-2::-1], up[1:]])  # N, up to 0.8 of gross slip
curve = rc.slide_curve(pressed, rubber, friction=0.5, forces=forces)

axes = plt.subplots()[1]
axes.plot(curve.displacement[:, 0] * 1e6, curve.force[:, 0] * 1e3, ".-")
axes.set(xlabel="displacement [µm]", ylabel="tangential force [mN]")

stuck = curve.stick_area[8] / pressed.contact_area
print(f"at the largest force, {stuck:.2f} of the contact sticks; Mindlin: {0.2 ** (2 / 3):.2f}")
assert f"{stuck:.2f}" == "0.36"
