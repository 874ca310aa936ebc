"""
Distribution of the pressure
============================

The probability density of the pressure on a rough surface: computed, and by Persson's theory.
"""

import numpy as np

import roughcontact as rc

modulus, pressure = 110e9, 1.5e8
grid = rc.Grid((512, 512), 1e-6, periodic=True)
surface = rc.self_affine(
    grid, hurst=0.8, rms=1e-7, rolloff=128e-6, short_cutoff=16e-6, rng=np.random.default_rng(1)
)
solution = rc.press(surface, modulus, pressure=pressure)
moments = rc.surface_moments(surface)


def persson(stress):
    return rc.theory.persson.pressure_density(stress, pressure, modulus, moments)


rc.plot.pressure_distribution(solution, theories={"Persson": persson})

predicted = float(rc.theory.persson.contact_fraction(pressure, modulus, moments))
print(f"in contact {solution.contact_fraction:.3f}, by Persson {predicted:.3f}")
assert f"{solution.contact_fraction:.2f}" == "0.30"
