"""
The mean gap between rough surfaces
===================================

The mean gap falls as the logarithm of the pressure. The example compares the computed gap with Persson's
theory and with its law at small loads, p = p_c exp(-u/u0).
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact.theory import persson_separation as separation

modulus, pressures = 110e9, np.geomspace(1e6, 1e9, 10)
grid = rc.Grid((256, 256), 1e-6, periodic=True)
surface = rc.self_affine(
    grid, hurst=0.8, rms=1e-7, rolloff=32e-6, short_cutoff=8e-6, rng=np.random.default_rng(1)
)
curve = rc.loading_curve(surface, modulus, pressures=pressures)
spectrum = rc.power_spectrum(surface)

axes = plt.subplots()[1]
axes.semilogx(pressures / 1e6, curve.mean_gap * 1e9, "o", label="computed")
axes.semilogx(pressures / 1e6, separation.mean_gap(pressures, modulus, spectrum) * 1e9, label="Persson")
decay, reference = separation.decay_length(spectrum), separation.reference_pressure(modulus, spectrum)
axes.semilogx(pressures / 1e6, decay * np.log(reference / pressures) * 1e9, "--", label="small loads")
axes.set(xlabel="pressure [MPa]", ylabel="mean gap [nm]", ylim=(0, None))
axes.legend()

slope = -np.polyfit(np.log(pressures[3:7]), curve.mean_gap[3:7], 1)[0]
print(f"computed u0 {slope * 1e9:.0f} nm, by Persson {decay * 1e9:.0f} nm")
assert f"{slope * 1e9:.0f}" == "55"
