"""
Contact spots in clusters
=========================

Round spots with the areas and positions of the computed contact spots. By Greenwood's sum over pairs of
spots, their stiffness and conductance are those of the contact. Without interaction between the spots they
would be far larger.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.ndimage import center_of_mass

import roughcontact as rc

grid, modulus = rc.Grid((256, 256), 1e-6), 110e9
surface = rc.self_affine(
    grid, hurst=0.8, rms=1e-7, rolloff=64e-6, short_cutoff=16e-6, rng=np.random.default_rng(1)
)
solution = rc.press(surface, modulus, force=1.0)
spots = solution.spots
radii = np.sqrt(spots.areas / np.pi)
places = np.array(center_of_mass(spots.labels > 0, spots.labels, range(1, spots.count + 1))) * 1e-6
greenwood = modulus * rc.theory.holm.contact_length(radii, places)
alone = 2 * modulus * radii.sum()

axes = solution.plot(field="contact")
for radius, (y, x) in zip(radii, places, strict=True):
    axes.add_patch(plt.Circle((x * 1e6, y * 1e6), radius * 1e6, fill=False, color="C0", linewidth=1.5))

factors = greenwood / solution.stiffness, alone / solution.stiffness
print(f"{spots.count} spots; relative to the computed stiffness: Greenwood {factors[0]:.3f}")
print(f"without interaction {factors[1]:.1f}")
assert f"{factors[0]:.1f}" == "1.0"
