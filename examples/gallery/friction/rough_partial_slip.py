"""
Partial slip of a rough contact
===============================

Under a growing tangential force, small spots slip first, and large spots slip from their edges inward. Blue
cells stick, orange cells slip.
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap

import roughcontact as rc

steel = rc.handbook("steel").solid
grid = rc.Grid((128, 128), 1e-6)
pad = rc.self_affine(grid, hurst=0.8, rms=1e-7, rolloff=64e-6, rng=np.random.default_rng(4))
pressed = rc.press(pad, (steel, steel), force=1.0)
shares = [0.2, 0.5, 0.8]
forces = [(share * 0.3 * pressed.force, 0.0) for share in shares]
panels = plt.subplots(1, 3, figsize=(9, 3.2), layout="constrained")[1]
held = []
for axes, share, slid in zip(
    panels, shares, rc.slide_path(pressed, (steel, steel), friction=0.3, forces=forces), strict=True
):
    state = np.where(slid.sticking, 2, np.where(slid.slipping, 1, 0))
    axes.imshow(state, cmap=ListedColormap(["0.92", "C1", "C0"]), vmin=0, vmax=2)
    held.append(slid.stick_area / pressed.contact_area)
    axes.set(title=f"Q = {share} µ F: {held[-1]:.0%} sticks", xticks=[], yticks=[])

print("part of the contact that sticks:", np.round(held, 2))
assert held[0] > held[1] > held[2] > 0
