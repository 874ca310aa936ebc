"""
A surface with a lay
====================

The roughness of ground and turned surfaces is longer along one direction. The autocorrelation shows this
lay. The texture aspect ratio of ISO 25178-2 is its shortest decay length divided by its longest.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid = rc.Grid((256, 256), 1e-6, periodic=True)
spectrum = rc.StretchedSpectrum(rc.SelfAffineSpectrum(0.8, rolloff=32e-6), 4.0, angle=np.pi / 6)
surface = rc.synthesise(grid, spectrum, np.random.default_rng(1), rms=1e-7)
lags = rc.autocorrelation(surface)

left, right = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")[1]
surface.plot(left)
y, x = lags.lags
right.contourf(x * 1e6, y * 1e6, lags.value / surface.rms**2, 12)
right.set(
    xlabel="lag along x [µm]", ylabel="lag along y [µm]", xlim=(-40, 40), ylim=(40, -40), aspect="equal"
)

ratio = rc.areal_parameters(surface).Str
print(f"texture aspect ratio Str = {ratio:.2f}")
assert f"{ratio:.2f}" == "0.25"  # stretched four times
