"""
An elastic layer on a rigid base
================================

A ball is pressed into a layer that is bonded to a rigid base. The thinner the layer, the smaller the depth.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid = rc.Grid((64, 64), 1e-6)
ball = rc.shapes.paraboloid(grid, 1e-3)
rubber = rc.Solid(1e7, 0.3)
thicknesses = np.array([5e-6, 10e-6, 20e-6, 40e-6, 80e-6])
layers = [rc.layer(grid, rubber, thickness=each, base="bonded") for each in thicknesses]
depths = [rc.press(ball, rubber, force=1e-6, operator=layer).depth for layer in layers]
half_space = rc.press(ball, rubber, force=1e-6).depth

axes = plt.subplots()[1]
axes.plot(thicknesses * 1e6, np.array(depths) * 1e9, "o", label="layer")
axes.axhline(half_space * 1e9, color="k", linestyle="--", label="half-space")
axes.set(xlabel="thickness [µm]", ylabel="depth [nm]")
axes.legend()

ratio = depths[0] / half_space
print(f"depth on the thinnest layer / depth on the half-space: {ratio:.2f}")
assert f"{ratio:.2f}" == "0.62"
