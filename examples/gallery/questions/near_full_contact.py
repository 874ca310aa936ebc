"""
How does a hardness change the approach to full contact?
========================================================

An elastic surface closes its last gaps only at pressures above E* g, where g is the rms slope. If a hardness
H limits the pressure, the contact area is at least p/H. The last valleys nevertheless stay open until p
reaches H, and the mean gap becomes negative before: the model removes the material that flows, which fills
no valley. The area and the gap of this model have little meaning for p close to H.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

modulus, grid = 110e9, rc.Grid((128, 128), 1e-6, periodic=True)
waves = {"rolloff": 64e-6, "short_cutoff": 8e-6}
surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1), **waves)
scale = modulus * rc.surface_moments(surface).rms_slope
shares = np.linspace(0.02, 0.98, 13)
left, right = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")[1]
for hardness in None, scale, scale / 2, scale / 4:
    pressures = shares * (1.2 * scale if hardness is None else hardness)
    curve = rc.loading_curve(surface, modulus, pressures=pressures, hardness=hardness)
    name = "elastic" if hardness is None else f"H = {hardness / scale:.2f} E* g"
    line = left.plot(pressures / scale, curve.contact_fraction, label=name)[0]
    right.plot(pressures / scale, curve.mean_gap / surface.rms, label=name)
    if hardness is not None:
        left.plot(pressures / scale, shares, ":", color=line.get_color())
left.set(xlabel="p / (E* g)", ylabel="A/A0; dotted: p/H")
left.legend()
right.set(xlabel="p / (E* g)", ylabel="mean gap / rms height")

gap = curve.mean_gap[-1] / surface.rms
print(f"lowest hardness at p = 0.98 H: A/A0 {curve.contact_fraction[-1]:.2f}, mean gap {gap:.1f} rms heights")
assert np.all(curve.contact_fraction >= shares)
assert gap < 0
