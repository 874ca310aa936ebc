"""
A rough face sinks into a viscous body: from elastic to viscous contact
=======================================================================

A rough mould is pressed onto hot glass, which flows: how long until it has filled half of the face? While a contact
grows, it is the elastic contact of the same depth (Lee and Radok; chapter 4 of the thesis). In a viscous body under a
constant pressure, it is the elastic contact with E* = 4 eta/t. One elastic curve therefore answers for each viscosity,
pressure and time: ``viscoelastic.transfer`` reads the history from it.

Surface tension is left out.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact import viscoelastic

grid = rc.Grid((96, 96), 4e-6, periodic=True)
mould = rc.self_affine(grid, hurst=0.8, rms=2e-6, rolloff=128e-6, short_cutoff=16e-6, rng=1)
elastic = rc.loading_curve(mould, 1e9, pressures=np.geomspace(2e5, 3e8, 30))  # with any modulus
pressure = 1e6  # [Pa]

axes = plt.subplots()[1]
for viscosity in 1e7, 1e8, 1e9:  # [Pa s], by the temperature
    longest = 4 * viscosity * 2.5e8 / (1e9 * pressure)  # at the end of the elastic curve
    times = np.concatenate([[0], np.geomspace(longest / 1000, longest, 40)])  # [s]
    flow = viscoelastic.transfer(elastic, viscoelastic.viscous(viscosity), times, forces=pressure * grid.area)
    filled = flow.contact_area / grid.area
    axes.semilogx(times[1:], filled[1:], label=f"{viscosity:.0e} Pa s")
    print(f"{viscosity:.0e} Pa s: half of the face is filled after {np.interp(0.5, filled, times):.0f} s")
time, fraction = times[30], filled[30]
relaxed = rc.press(mould, 4 * viscosity / time, pressure=pressure)
axes.plot(time, relaxed.contact_fraction, "ko", label="elastic, E* = 4 eta/t")
axes.set(xlabel="time [s]", ylabel="relative contact area A/A0", ylim=(0, None))
axes.legend(title="viscosity")

print(f"after {time:.0f} s: A/A0 {fraction:.3f}, of the elastic contact {relaxed.contact_fraction:.3f}")
assert abs(fraction / relaxed.contact_fraction - 1) < 0.01
