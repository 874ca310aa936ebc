"""
A wave pressed flat
===================

A cosine of amplitude h and wavelength l on a flat. Contact is full at p = pi E* h/l. Below this pressure,
the strips in contact have the width (2 l/pi) asin(sqrt(p / (pi E* h/l))) (Westergaard 1939; Johnson,
*Contact Mechanics*, 1985, section 13.2).
"""

import matplotlib.pyplot as plt
import numpy as np

import roughcontact as rc

modulus, amplitude, wavelength = 1e9, 1e-6, 1e-4  # Pa, m
grid = rc.Grid(1024, wavelength / 1024, periodic=True)
full = np.pi * modulus * amplitude / wavelength
shares = np.linspace(0.05, 0.95, 10)
curve = rc.loading_curve(
    rc.shapes.wave(grid, amplitude, wavelength),
    modulus,
    pressures=shares * full,
    operator=rc.line(grid, modulus),
)

axes = plt.subplots()[1]
axes.plot(shares, curve.contact_fraction, "o", label="computed")
fine = np.linspace(0, 1, 200)
axes.plot(fine, 2 / np.pi * np.arcsin(np.sqrt(fine)), label="Westergaard")
axes.set(xlabel="pressure / that of full contact", ylabel="relative contact width")
axes.legend()

difference = np.abs(curve.contact_fraction - 2 / np.pi * np.arcsin(np.sqrt(shares))).max()
print(f"largest difference {difference * 1024:.1f} cells of 1024")
assert difference < 2 / 1024  # an edge on either side, each found to a cell
