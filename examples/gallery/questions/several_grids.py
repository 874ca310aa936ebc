"""
How do I put one surface on several grids?
==========================================

The same seed gives the same waves in the same places on every grid. With `rms_band`, a band of waves that
all grids resolve, the waves also have the same heights, and a finer grid only adds shorter waves. The
example uses profiles; surfaces behave in the same way.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

side, axes, waves = 1e-3, plt.subplots()[1], []
for count in 64, 128, 512:
    grid = rc.Grid(count, side / count, periodic=True)
    rng = np.random.default_rng(1)
    line = rc.self_affine(grid, hurst=0.8, rms=1e-6, rms_band=(side, 2.5 * side / 64), rng=rng)
    axes.plot(grid.coordinates[0] * 1e6, line.heights * 1e6, ".-", label=f"{count} cells")
    first = np.exp(1j * np.pi * 5 / count)  # phase of the fifth wave in the middle of the first cell
    waves.append(np.fft.fft(line.heights)[5] / count / first)
axes.set(xlabel="x [µm]", ylabel="height [µm]", xlim=(0, 250))
axes.legend()

print("the fifth wave on three grids [nm]:", np.round(np.array(waves) * 1e9, 4))
assert np.allclose(waves, waves[0], rtol=1e-9)  # rounding
