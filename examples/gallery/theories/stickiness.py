"""
Do short waves make a surface stick?
====================================

Two criteria that contradict each other. By Pastewka and Robbins, shorter waves at the same rms height make a
surface stickier for Hurst exponents H above 0.6, and less sticky below. By Ciavarella's bearing area, only
the longest wave decides.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact.theory import bearing_area_model, pastewka_robbins

modulus, work, reach, rms, longest = 1e7, 0.05, 2e-9, 1e-7, 1e-5  # Pa, J/m^2, m, m, m
shortest = np.geomspace(1e-8, 1e-6, 15)
axes = plt.subplots()[1]
for hurst in 0.4, 0.6, 0.8:
    surfaces = [rc.SelfAffineSpectrum(hurst, long_cutoff=longest, short_cutoff=each) for each in shortest]
    ratio = [pastewka_robbins.stickiness(each.scaled(rms), modulus, work, reach) for each in surfaces]
    axes.loglog(shortest * 1e9, ratio, label=f"Pastewka and Robbins, H = {hurst}")
limit = bearing_area_model.BearingAreaModel(rms, 2 * np.pi / longest, modulus, work, reach).sticking_rms
axes.axhline((limit / rms) ** 2, color="k", linestyle="--", label="bearing area")
axes.axhline(1, color="0.7")
axes.set(xlabel="shortest wave [nm]", ylabel="stickiness (above 1: sticks)")
axes.legend(loc="lower right")

slope = np.polyfit(np.log(shortest[:5]), np.log(ratio[:5]), 1)[0]
print(f"stickiness ~ (shortest wave)^{slope:.2f} for H = 0.8; without a longest wave {1 - 5 * 0.8 / 3:.2f}")
# Up to 37 nm, the longest wave changes the squared slope by at most x = 0.11, (shortest/longest)^(2 - 2 H). The
# stickiness falls as its power 7/6, so that the exponent differs by 7/6 0.4 x/(1 - x).
assert abs(slope - (1 - 5 * 0.8 / 3)) < 0.06
