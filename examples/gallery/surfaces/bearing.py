"""
Peaks, core and dales
=====================

The material ratio curve of a plateau-honed surface, with the parameters of ISO 25178-2 that divide it into
peaks, core and dales.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid = rc.Grid((256, 256), 1e-6)
rough = rc.self_affine(grid, hurst=0.8, rms=1e-6, rolloff=64e-6, rng=np.random.default_rng(1))
honed = rc.Surface(np.minimum(rough.heights, 0.3e-6 + 0.1 * rough.heights), grid)
curve, parts = rc.material_ratio(honed), rc.stratified_parameters(honed)

axes = plt.subplots()[1]
axes.plot(100 * curve.ratio, curve.height * 1e6)
axes.axvspan(0, 100 * parts.Smr1, alpha=0.2, color="C1", label=f"peaks, Spk = {parts.Spk * 1e6:.2f} µm")
axes.axvspan(100 * parts.Smr2, 100, alpha=0.2, color="C2", label=f"dales, Svk = {parts.Svk * 1e6:.2f} µm")
axes.set(xlabel="material ratio [%]", ylabel="height [µm]", title=f"core: Sk = {parts.Sk * 1e6:.2f} µm")
axes.legend()

print(f"Svk / Spk: {parts.Svk / parts.Spk:.1f}")
assert f"{parts.Svk / parts.Spk:.0f}" == "11"
