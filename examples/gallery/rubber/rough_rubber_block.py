"""
Creep and complex stiffness of a rough rubber contact
=====================================================

A rubber block is pressed by a constant pressure against a rough rigid face. The contact area and the depth grow over
seven decades of time. The stiffness against a small oscillation, on the state after one hour, is complex: its
real part is in phase with the oscillation, and its imaginary part is the loss.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc
from roughcontact import viscoelastic

# E* = 2 MPa + 3 MPa (t / 1 s)^-0.3
rubber = viscoelastic.power_law(3e6, 1.0, 0.3, band=(1e-3, 1e5), equilibrium=2e6)
grid = rc.Grid((96, 96), 4e-6, periodic=True)
face = rc.self_affine(grid, hurst=0.8, rms=2e-6, rolloff=128e-6, short_cutoff=16e-6, rng=1)
pressure, hour = 5e4, 3600.0
history = {"times": [0, 0, hour], "pressures": [0, pressure, pressure], "time_tolerance": 1e-2}

states = list(rc.viscoelastic_path(face, rubber, **history))
last = states[-1]
frequencies = np.geomspace(1e-5, 1e2, 71)  # [rad/s], in the band of the material
stiffness = np.array([last.dynamic_stiffness(omega) for omega in frequencies]) / grid.area

left, right = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")[1]
times = [state.time for state in states[2:]]
left.semilogx(times, [state.contact_fraction for state in states[2:]], label="A/A0")
left.set(xlabel="time [s]", ylabel="relative contact area A/A0", ylim=(0, None))
depth = left.twinx()
depth.semilogx(times, [state.depth * 1e6 for state in states[2:]], "C1--")
depth.set_ylabel("depth [µm]", color="C1")
right.loglog(frequencies, stiffness.real / 1e9, label="in phase")
right.loglog(frequencies, stiffness.imag / 1e9, "--", label="loss")
right.set(xlabel="angular frequency [rad/s]", ylabel="stiffness per area [N/mm³]", ylim=(1, 1e3))
right.legend()

start, end = states[1], last
print(f"A/A0 grows from {start.contact_fraction:.3f} to {end.contact_fraction:.3f} in an hour")
relaxed = rc.press(face, 1 / float(rubber.creep()(hour)), pressure=pressure)
# Under a constant force, the contact is that of an elastic body with the modulus 1/J(t).
print(f"an elastic contact with 1/J(1 h): {relaxed.contact_fraction:.3f}")
assert abs(end.contact_fraction / relaxed.contact_fraction - 1) < 0.02
