"""
Contact on few summits at light loads
=====================================

At light loads, a finite surface is in contact only at its highest summits. It is then stiffer than Persson's
theory of an infinite surface. The law "finite-size" combines both limits. The heights of the highest summits
are random, so that the example shows five surfaces.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

modulus, pressures = 110e9, np.geomspace(1e5, 1e9, 13)
grid = rc.Grid((128, 128), 2e-6, periodic=True)
axes, ratios = plt.subplots()[1], []
for seed in range(5):
    surface = rc.self_affine(
        grid, hurst=0.8, rms=1e-6, rolloff=64e-6, short_cutoff=8e-6, rng=np.random.default_rng(seed)
    )
    curve = rc.loading_curve(surface, modulus, pressures=pressures)
    stiffness = curve.interfacial_stiffness_per_area
    axes.loglog(pressures / 1e6, stiffness / 1e12, "k.", label=None if seed else "computed")
    ratios.append(stiffness[0])
laws = rc.loading_laws(surface, modulus, ["persson", "finite-size"], hurst=0.8, rolloff=64e-6)
for law in laws:
    predicted = law.predict("interfacial_stiffness", curve.force) / grid.area
    axes.loglog(pressures / 1e6, predicted / 1e12, label=law.name)
axes.set(xlabel="pressure [MPa]", ylabel="stiffness per area [N/µm/mm²]")
axes.legend()

persson, cell = (law.predict("interfacial_stiffness", curve.force)[0] / grid.area for law in laws)
first = np.mean(ratios)
print(
    f"stiffness at the smallest pressure: {first / cell:.1f} of finite-size, {first / persson:.0f} of Persson"
)
assert f"{first / cell:.1f}" == "1.4"
