"""
Does a small patch represent a large joint?
===========================================

Patches of several sizes from random places of one map, at the same pressure. K/A0, the stiffness of the
interface per area, converges as the patches grow. k/A0, which includes the compliance of the bodies, does
not converge.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid = rc.Grid((512, 512), 2e-6, periodic=True)
rng = np.random.default_rng(1)
joint = rc.self_affine(grid, hurst=0.8, rms=1e-6, rolloff=128e-6, short_cutoff=16e-6, rng=rng)
modulus, pressure, sides = 58.6e9, 5e7, np.array([64, 128, 192, 256])
means = []
for side in sides:
    corners = rng.integers(0, 512 - side, (6, 2))
    found = []
    for row, column in corners:
        patch = joint.cropped(slice(row, row + side), slice(column, column + side)).levelled("plane")
        solution = rc.press(patch, modulus, pressure=pressure)
        area = patch.grid.area
        found.append((solution.interfacial_stiffness / area, solution.stiffness / area))
    means.append((np.mean(found, axis=0), np.std(found, axis=0, ddof=1) / np.sqrt(6)))
whole = rc.press(joint, modulus, pressure=pressure).stiffness / grid.area

axes = plt.subplots()[1]
for k, name in enumerate(["K/A0", "k/A0"]):
    values, errors = np.array(means)[:, :, k].T / 1e12
    axes.errorbar(sides * 2e-3, values, errors, fmt="o-", capsize=3, label=f"patches, {name}")
axes.axhline(whole / 1e12, color="k", linestyle="--", label="periodic map")
axes.set(xlabel="side of the patches [mm]", ylabel="stiffness per area [N/µm/mm²]", ylim=(0, None))
axes.legend()

print("K/A0 and k/A0 relative to the periodic map:", np.round(np.array(means)[:, 0] / whole, 2))
deviation = abs(means[-1][0][0] - whole)
assert deviation < 3 * means[-1][1][0]  # standard errors of the mean of six
