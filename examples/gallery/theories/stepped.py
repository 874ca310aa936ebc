"""
A pile of discs
===============

A pile of wider and wider discs, whose steps follow h ~ r^H. Between two steps the stiffness is that of a
disc. From step to step it grows as F^(1/(H+1)), the law of fractal surfaces: this part of the law is
geometry.
"""

import matplotlib.pyplot as plt
import numpy as np

from roughcontact.theory import stepped

modulus, axes, slopes = 1e9, plt.subplots()[1], []
for hurst in 0.2, 0.8:
    pile = stepped.SteppedIndenter(radius=1e-7, height=1e-9, ratio=1.5, hurst=hurst)
    force, stiffness = pile.corners(16, modulus)
    axes.loglog(force, stiffness, drawstyle="steps", label=f"H = {hurst}")
    slopes.append(float(np.log(1.5) / np.log(force[-1] / force[-2])))
axes.set(xlabel="force [N]", ylabel="stiffness [N/m]")
axes.legend()

print("exponents:", np.round(slopes, 4))
assert np.allclose(slopes, [1 / 1.2, 1 / 1.8], rtol=1.5**-15)  # part of the first disc in the whole pile
