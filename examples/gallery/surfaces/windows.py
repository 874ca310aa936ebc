"""
Edges that do not fit
=====================

A free map does not repeat itself. The step across its border is in every wave, and hides the slope of the
spectrum; a window takes it out.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

tile = rc.self_affine(rc.Grid((512, 512), 1e-6), hurst=1.0, rms=1e-6, rng=np.random.default_rng(1))
part = tile.cropped(slice(0, 256), slice(0, 256)).levelled("plane")
tapered = part.tapered("hann")
panels = plt.subplots(1, 2, figsize=(9, 3.4), layout="constrained")[1]
tapered.plot(panels[0])
panels[0].set_title("tapered by a Hann window")
hurst = {}
for window, name in ("none", "no window"), ("hann", "Hann window"):
    spectrum = rc.power_spectrum(part, window=window)
    hurst[name] = rc.fit_spectrum(spectrum).hurst
    panels[1].loglog(spectrum.wavenumber, spectrum.density, label=f"{name}: H = {hurst[name]:.2f}")
panels[1].set(xlabel="wavenumber [rad/m]", ylabel="power [m$^4$]")
panels[1].legend()

print(hurst)
assert abs(hurst["Hann window"] - 1) < 0.05 < 1 - hurst["no window"]
