"""
Which spots carry the current?
==============================

The current of a contact is distributed over its spots. This example presses a patch of rough copper and draws the
share of each spot. The right picture shows the resistance of each spot among the other spots, by itself, and of
Holm's round spot of equal area. Codes that add Holm's conductances neglect the other spots: here the sum is 1.55
times the conductance.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

copper = rc.handbook("copper")
grid = rc.Grid((128, 128), 2e-6)
rng = np.random.default_rng(1)
surface = rc.self_affine(grid, hurst=0.8, rms=0.5e-6, rolloff=100e-6, short_cutoff=16e-6, rng=rng)
solution = rc.press(surface, rc.reduced_modulus(copper, copper), pressure=1e8)
flux = rc.contact_flux(solution, resistivities=(1.7e-8, 1.7e-8), drop=1e-3)

left, right = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")[1]
flux.plot(left)
flux.plot(right, field="resistance")

excess = flux.resistance * (1 / flux.resistances_holm).sum()
print(flux)
print(f"sum of Holm's conductances over the conductance: {excess:.2f}")
assert f"{excess:.2f}" == "1.55"
