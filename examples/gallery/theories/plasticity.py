"""
Elastic or plastic? Plasticity indices
======================================

Three plasticity indices of one ground surface, for the metals of the handbook against steel. By the two
indices of asperities, a contact is elastic below 0.6 and plastic above 1.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact.theory import plasticity

grid = rc.Grid((256, 256), 2e-6)
surface = rc.self_affine(
    grid, hurst=0.8, rms=1e-7, rolloff=128e-6, short_cutoff=16e-6, rng=np.random.default_rng(1)
)
moments, summits = rc.surface_moments(surface), rc.find_summits(surface)
names = ["steel", "stainless-steel", "aluminium", "titanium", "copper", "tungsten"]
rows = []
for name in names:
    metal = rc.handbook(name)
    modulus = rc.reduced_modulus(metal, "steel")
    found = plasticity.summit_index(summits.height, summits.mean_curvature, modulus, metal.hardness)
    by_moments = plasticity.asperity_index(moments, modulus, metal.hardness)
    rows.append(
        (found.value, by_moments.value, plasticity.slope_index(moments, modulus, metal.hardness).value)
    )

axes = plt.subplots(layout="constrained")[1]
for k, label in enumerate(["summits found on the map", "summits by moments", "slope"]):
    axes.bar(np.arange(len(names)) + 0.25 * (k - 1), np.array(rows)[:, k], 0.25, label=label)
axes.axhspan(0.6, 1.0, alpha=0.2, color="k")
axes.set_xticks(range(len(names)), names, rotation=20)
axes.set(ylabel="plasticity index")
axes.legend()

print(dict(zip(names, (f"{row[0]:.2f}" for row in rows), strict=True)))
assert f"{rows[0][0]:.1f}" == "0.8"
