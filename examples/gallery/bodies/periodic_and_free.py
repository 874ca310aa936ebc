"""
The same heights, periodic and free
===================================

A periodic map represents the inside of a large joint. A free map is a single patch between two half-spaces.
The bodies under a free patch deform too, so that its stiffness k is smaller than the stiffness K of the
interface.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

modulus, forces = 110e9, np.geomspace(0.03, 3, 7)
grid = rc.Grid((128, 128), 1e-6, periodic=True)
tile = rc.self_affine(grid, hurst=0.8, rms=1e-7, rolloff=32e-6, rng=np.random.default_rng(1))
periodic = rc.loading_curve(tile, modulus, forces=forces)
patch = rc.Surface(tile.heights, rc.Grid(grid.shape, grid.spacing))
free = rc.loading_curve(patch, modulus, forces=forces)

axes = plt.subplots()[1]
axes.loglog(forces, periodic.stiffness / 1e6, "o-", label="periodic: k = K")
axes.loglog(forces, free.interfacial_stiffness / 1e6, "s--", label="free: K")
axes.loglog(forces, free.stiffness / 1e6, "s-", label="free: k")
axes.set(xlabel="force [N]", ylabel="stiffness [N/µm]")
axes.legend()

under = modulus * free.length * (1 / free.stiffness - 1 / free.interfacial_stiffness)
print("E* L (1/k - 1/K) =", np.round(under, 2))
assert np.all((under > 0.5611) & (under < 1.1222))  # bounds of any contact in a square
