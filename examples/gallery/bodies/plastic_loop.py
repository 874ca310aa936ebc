"""
Plastic flow: first loading and unloading
=========================================

A rough joint flows when it is first loaded and is elastic afterwards. On unloading, all cells in contact
contribute to the stiffness; on first loading, only the cells that do not flow contribute.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

grid = rc.Grid((128, 128), 1e-6, periodic=True)
surface = rc.self_affine(grid, hurst=0.8, rms=0.5e-6, rng=np.random.default_rng(1), rolloff=32e-6)
loop = rc.loading_loop(surface, 58.6e9, hardness=1.05e9, pressures=np.geomspace(1e6, 1e8, 9))

left, right = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")[1]
loop.plot(left)
loop.plot(right, quantity="stiffness")

flow = loop.loading.flow
share = loop.residual_depth / loop.loading.depth[-1]
stiffer = flow.unloading_stiffness[-1] / loop.loading.stiffness[-1]
print(f"{share:.0%} of the depth remains; unloading is {stiffer:.1f} times as stiff as first loading")
assert f"{share:.2f}" == "0.84"
