"""
What would an ultrasonic probe see of this joint?
=================================================

The reflection of a normal wave gives the stiffness per area of a joint. This example computes the reflection of a
rough steel joint against the pressure at several frequencies. Where nearly everything is reflected, the stiffness is
much less certain than the reflection: such points are drawn open. The other panels show by how much, and the frequency
at which an error of the reflection changes the stiffness least.

The probe must also fit the joint: its wavelength is much longer than the distance of the spots, and its beam is at
least ten times as wide as the longest waves of the roughness.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact.theory import ultrasound

grid = rc.Grid((128, 128), 4e-6, periodic=True)
rng = np.random.default_rng(1)
surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rolloff=128e-6, short_cutoff=32e-6, rng=rng)
curve = rc.loading_curve(surface, ("steel", "steel"), pressures=np.geomspace(3e6, 3e8, 9))

figure, (left, right, choice) = plt.subplots(1, 3, figsize=(12, 4), layout="constrained")
for number, frequency in enumerate((0.2e6, 1e6, 5e6)):
    seen = rc.reflection(curve, ("steel", "steel"), frequency)
    certain = seen["measurable"]
    for axes, values in ((left, seen["reflection"]), (right, seen["error_amplification"])):
        axes.plot(curve.nominal_pressure / 1e6, values, color=f"C{number}", label=f"{frequency / 1e6:g} MHz")
        for chosen, fill in ((certain, f"C{number}"), (~certain, "none")):
            axes.plot(curve.nominal_pressure[chosen] / 1e6, values[chosen], "o", color=f"C{number}", mfc=fill)
left.set(xscale="log", xlabel="pressure [MPa]", ylabel="reflection |r|")
left.legend()
right.set(xscale="log", yscale="log", xlabel="pressure [MPa]", ylabel="error of K over error of |r|")
right.axhline(ultrasound.LARGEST_AMPLIFICATION, color="0.5", linestyle="--")
best = seen["best_frequency"]
choice.loglog(curve.nominal_pressure / 1e6, best / 1e6, "ko-")
choice.set(xlabel="pressure [MPa]", ylabel="frequency to choose [MHz]")

for pressure, frequency in zip(curve.nominal_pressure[::4], best[::4], strict=True):
    print(f"{pressure / 1e6:3.0f} MPa: measure at {frequency / 1e6:.2f} MHz")
assert f"{best[4] / 1e6:.2f}" == "0.18"
