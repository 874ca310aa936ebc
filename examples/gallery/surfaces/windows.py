"""
Spectrum of a free map: windows
===============================

A free map is not periodic. The step across its border contributes to every wave and hides the slope of the
spectrum. A window removes this contribution.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

tile = rc.self_affine(rc.Grid((512, 512), 1e-6), hurst=1.0, rms=1e-6, rng=np.random.default_rng(1))
part = tile.cropped(slice(0, 256), slice(0, 256)).levelled("plane")
panels = plt.subplots(1, 2, figsize=(9, 3.4), layout="constrained")[1]
part.tapered("hann").plot(panels[0])
panels[0].set_title("tapered by a Hann window")
fits = []
for window, name in ("none", "no window"), ("hann", "Hann window"):
    spectrum = rc.power_spectrum(part, window=window)
    fits.append(rc.fit_spectrum(spectrum))
    panels[1].loglog(spectrum.wavenumber, spectrum.density, label=f"{name}: H = {fits[-1].hurst:.2f}")
panels[1].set(xlabel="wavenumber [rad/m]", ylabel="power [m$^4$]")
panels[1].legend()

without, tapered = ((fit.hurst - 1) / fit.standard_error for fit in fits)
print(f"deviation from H = 1, in standard errors: {without:.1f} without a window, {tapered:.2f} with one")
assert abs(tapered) < 3 < abs(without)
