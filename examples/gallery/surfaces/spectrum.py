"""
Power spectrum and Hurst exponent
=================================

The fitted spectrum of a generated surface has the prescribed Hurst exponent.
"""

import numpy as np

import roughcontact as rc

grid = rc.Grid((256, 256), 1e-6, periodic=True)
surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
fit = rc.hurst_exponent(surface)
rc.plot.spectrum_curve(rc.power_spectrum(surface), law=fit)

print(f"H = {fit.hurst:.2f}")
assert f"{fit.hurst:.1f}" == "0.8"
