"""
Form, waviness, roughness
=========================

Gaussian filters separate a surface by wavelength (ISO 16610-61). A wave at the cut-off keeps half of its
height.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid = rc.Grid((256, 256), 1e-6, periodic=True)
surface = rc.self_affine(grid, hurst=0.5, rms=1e-7, rng=np.random.default_rng(1))
waviness = surface.filtered(short_cutoff=32e-6)
roughness = surface.filtered(long_cutoff=32e-6)

panels = plt.subplots(1, 3, figsize=(11, 3), layout="constrained")[1]
for axes, part, name in zip(
    panels, (surface, waviness, roughness), ("surface", "above 32 µm", "below 32 µm"), strict=True
):
    part.plot(axes)
    axes.set_title(f"{name}: {part.rms * 1e9:.0f} nm rms")

before, after = (np.fft.rfft2(each.heights)[0, 8] for each in (surface, waviness))  # eight waves of 32 µm
print(f"part of a wave of 32 µm that remains: {abs(after / before):.6f}")
assert abs(after / before - 0.5) < 1e-12  # rounding of the transforms
