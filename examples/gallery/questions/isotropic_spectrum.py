"""
How wrong is C_iso = pi/q C_1D?
===============================

A profilometer measures the spectrum of profiles. The spectrum of the surface is often estimated from it by
C_iso = (pi/q) C_1D (Jacobs, Junge and Pastewka 2017), which is C1D/(2 q) in the normalisation used here. For
a self-affine surface this is exact only at H = 0.5. For waves longer than the roll-off, the estimate grows
as 1/q relative to the spectrum. `surface_spectrum` uses the factor of the Hurst exponent, or Abel's
integral.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid = rc.Grid((1024, 1024), 1e-6, periodic=True)
left, right = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")[1]
hursts, ratios = [0.2, 0.5, 0.8, 1.0], []
for hurst in hursts:
    surface = rc.self_affine(grid, hurst, 1e-7, np.random.default_rng(1), rolloff=128e-6)
    areal, profile = rc.power_spectrum(surface), rc.power_spectrum(surface, "x")
    common = np.interp(np.log(profile.wavenumber), np.log(areal.wavenumber), np.log(areal.density))
    ratio = profile.density / (2 * profile.wavenumber) / np.exp(common)
    left.semilogx(profile.wavelength * 1e6, ratio, label=f"H = {hurst}")
    middle = (profile.wavelength > 8e-6) & (profile.wavelength < 40e-6)
    ratios.append(ratio[middle].mean())
left.set(xlabel="wavelength [µm]", ylabel="(pi/q) C_1D / C_iso", ylim=(0, 3))
left.legend()
fine = np.linspace(0, 1.2, 50)
right.plot(fine, [rc.cut_factor(h) / 2 for h in fine], label="cut_factor(H) / 2")
right.plot(hursts, ratios, "o", label="computed")
right.set(xlabel="Hurst exponent", ylabel="(pi/q) C_1D / C_iso")
right.legend()

print("the estimate of C_iso is too large by the factors", np.round(ratios, 2))
assert f"{ratios[2]:.2f}" == f"{rc.cut_factor(0.8) / 2:.2f}"
